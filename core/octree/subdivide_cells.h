#pragma once

#include "core/octree/cell_tree.h"
#include "core/refs/prim_ref.h"
#include "core/refs/subdivision.h"

namespace boxwood {

/// What octree and quadtree have in common.
struct CellTreeRule {
    uint32_t axes;           ///< halved in every subdivision, bit 0 for x
    uint32_t max_depth;      ///< S_max, at most CellTree::kMaxDepth
    uint32_t max_leaf_size;  ///< N_leaf
    bool split;              ///< keep the box of each primitive's part in its leaf's cell
    ReferenceBudget budget;
};

/// Kerbl, lecture, "Quad and Octrees": starts with the scene's bounds; a cell with more than N_leaf triangles
/// is subdivided, up to S_max times. Level by level, in parallel.
///
/// A triangle belongs to a cell where its closed triangle touches the closed cell, decided exactly; so the
/// boxes of references change nothing. A cell stays a leaf too where no float lies between its walls, or
/// where its subdivision parts nothing: each child would have all of its triangles or none, two or more all.
/// Bounded: a level whose references, with those of the leaves above, or whose nodes would exceed the budget,
/// is not made. In task.skipped: "octree cells left whole: reference budget".
CellTree subdivide_cells(const Mesh& mesh, std::span<const PrimRef> refs, const CellTreeRule& rule,
                         Task& task);

}  // namespace boxwood
