#include "core/octree/octree.h"

#include "core/octree/subdivide_cells.h"

namespace boxwood {

CellTree Octree::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    const CellTreeRule rule = {.axes = 7,
                               .max_depth = static_cast<uint32_t>(max_depth),
                               .max_leaf_size = static_cast<uint32_t>(max_leaf_size),
                               .split = split,
                               .budget = budget};
    return subdivide_cells(mesh, refs, rule, task);
}

}  // namespace boxwood
