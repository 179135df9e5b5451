#pragma once

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Whether a ray can hit anything: finite origin, finite direction that is not zero, 0 <= t_min <= t_max.
bool is_valid(const Ray& ray);

/// The search for the nearest hit of one ray: box tests, triangle tests and the best hit so far.
template <Mode mode>
class ClosestHit;

}  // namespace boxwood
