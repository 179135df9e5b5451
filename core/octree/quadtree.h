#pragma once

#include "core/octree/cell_tree.h"
#include "core/refs/subdivision.h"
#include "core/structure/method.h"

namespace boxwood {

/// Quadrants of the ground plane of the scene's bounds, again and again where there are more than N_leaf
/// triangles; cells reach through the whole height. Kerbl, lecture, "Quad and Octrees". See subdivide_cells.
struct Quadtree {
    int up = 1;              ///< axis that is never split: 0 is x
    int max_depth = 10;      ///< S_max, 0 to CellTree::kMaxDepth
    int max_leaf_size = 32;  ///< N_leaf, 1 to 1024
    bool split = false;      ///< triangles are split at the borders of cells, not referenced whole
    ReferenceBudget budget{.per_triangle = 64, .at_least = size_t{1} << 20};

    void describe(ParamVisitor& v) {
        static constexpr const char* kAxes[] = {"x", "y", "z"};
        v.on_enum("up", up, kAxes, "axis of the height, along which nothing is split");
        v.on_int("max-depth", max_depth, 0, int{CellTree::kMaxDepth}, "S_max: subdivisions at most");
        v.on_int("max-leaf-size", max_leaf_size, 1, 1024, "N_leaf: a cell with more triangles is subdivided");
        v.on_bool("split", split, "split triangles at the borders of cells");
        v.on_int("budget", budget.per_triangle, 1, 1024,
                 "references at most, for each triangle of the scene");
    }
    CellTree build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
