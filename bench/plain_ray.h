#pragma once

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood::bench {

/// Whether float arithmetic has to give the right answer for this ray: no |U|, |V|, |W| of any triangle that
/// its line meets is within 1e-6 M^2 of zero, M the distance of the triangle's farthest vertex, and its hit
/// at `t` (infinity for a miss) is not at an end of the range. Otherwise the ray is called sensitive. Takes
/// time for every triangle of the mesh.
bool is_plain(const Mesh& mesh, const Ray& ray, float t);

}  // namespace boxwood::bench
