#pragma once

#include "core/base/params.h"
#include "core/kdtree/kd_build.h"
#include "core/structure/sah.h"

namespace boxwood {

/// kd-tree by surface area cost: the cheapest of all planes at the faces of the pieces' boxes, on all axes.
/// Events are sorted once; each node's stay sorted as they are divided among its children, and those of cut
/// pieces are sorted and merged in: O(N log N). Wald, Havran, "On building fast kd-Trees for Ray Tracing, and
/// on doing that in O(N log N)", IEEE Symposium on Interactive Ray Tracing 2006, section 4.3; with `clip`
/// the "perfect splits" of its section 3.4, Ernst, Greiner 2007, algorithm 3. Pieces in the plane go to the
/// side that is cheaper, of equal ones to the left. A leaf is made where no split is cheaper.
/// Differs: boxes of cut pieces are exact, each the smallest of floats, clipped from the triangle itself.
///
/// Ends by depth, and by the budget of references, which bounds memory: below 256 bytes for each reference
/// that the budget allows.
struct KdSah {
    bool clip = true;                       ///< Ernst, Greiner 2007, algorithm 3
    float empty_bonus = 0.2f;               ///< 0 to 0.9; Wald, Havran 2006, section 3.3: 1 - lambda
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16
    int leaf_size = 1;                      ///< 1 to 64
    int max_depth = 0;                      ///< 0 to 64; 0: by the number of references
    int budget = 16;                        ///< 1 to 64

    void describe(ParamVisitor& v) {
        v.on_bool("clip", clip, "triangles are clipped at planes; otherwise their boxes are");
        v.on_float("empty-bonus", empty_bonus, 0.0f, 0.9f,
                   "a split that leaves one child empty is cheaper by this part");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
        v.on_int("leaf-size", leaf_size, 1, 64, "so few references are not divided");
        v.on_int("max-depth", max_depth, 0, 64, "levels below the root; 0: 8 + 1.3 log2 of the references");
        v.on_int("budget", budget, 1, 64, "references in leaves at most, for each one given");
    }
    KdTree build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
