#pragma once

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood::bench {

/// How far fast mode's t of a triangle that the ray hits may be from the exact one, in units of t; infinite
/// where float arithmetic says nothing about it, as for a triangle seen exactly edge-on.
double fast_t_bound(const Ray& ray, const Triangle& triangle);

}  // namespace boxwood::bench
