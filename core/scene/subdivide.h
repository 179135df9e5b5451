#pragma once

#include "core/base/task.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Triangles that subdivide makes at most.
inline constexpr uint64_t kMaxSubdividedTriangles = 100'000'000;

/// Cuts each triangle into 4^times at the middles of its edges. A middle depends on the two end points alone,
/// symmetric in them and rounded once, so a closed mesh stays closed; edges that share their vertices share
/// the middle too. The parts follow each other in the order of the triangles; part k of triangle p has
/// source_prim 4^times p + k. Throws Error (WrongUsage) if this would be more than kMaxSubdividedTriangles.
/// After a stop the mesh is left as some earlier step had it.
void subdivide(Mesh& mesh, int times, Task& task);

/// (a + b) / 2 in each coordinate, rounded once.
Vec3 midpoint(const Vec3& a, const Vec3& b);

}  // namespace boxwood
