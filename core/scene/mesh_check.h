#pragma once

#include "core/base/task.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Whether the triangle has exactly zero area: decided exactly, so that tiny valid triangles are kept.
bool has_zero_area(const Triangle& triangle);

/// Makes a freshly read mesh fit for every stage: fills source_prim (0, 1, ...) where it is empty, then drops
/// triangles with an index out of range, a non-finite vertex, or exactly zero area, each counted in
/// task.skipped
/// ("index out of range", "non-finite vertex", "zero area"). Unused positions stay, non-finite ones become 0.
void check_mesh(Mesh& mesh, Task& task);

}  // namespace boxwood
