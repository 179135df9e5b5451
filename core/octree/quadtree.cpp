#include "core/octree/quadtree.h"

#include "core/octree/subdivide_cells.h"

namespace boxwood {

CellTree Quadtree::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    const CellTreeRule rule = {.axes = 7u & ~(1u << up),
                               .max_depth = static_cast<uint32_t>(max_depth),
                               .max_leaf_size = static_cast<uint32_t>(max_leaf_size),
                               .split = split,
                               .budget = budget};
    return subdivide_cells(mesh, refs, rule, task);
}

}  // namespace boxwood
