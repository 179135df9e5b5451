#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Top-down BVH builder that may divide a node's space instead of its references: those that lie on both
/// sides of a plane are cut, and each side gets the box of its part. Of the cheapest object split and the
/// cheapest spatial one the cheaper is taken, by surface area cost. Stich, Friedrich, Dietrich, "Spatial
/// Splits in Bounding Volume Hierarchies", HPG 2009, section 4: chopped binning, reference unsplitting, and
/// no spatial split where the children of the object split do not overlap by `overlap` of the root's area.
///
/// Each part is the smallest box of floats around the triangle inside the reference's box and the side, so
/// the boxes of a primitive's references together contain what the references given contained of it.
///
/// Differs: nodes with at most kSweepCount references weigh every object split (a sweep), larger ones those
/// between bins; nodes are split down to single primitives, and then a subtree becomes a leaf where that
/// costs no more; references are bounded by a budget, which children share in the ratio of count times area.
/// Memory: below 160 bytes for each reference that the budget allows. Counted in task.skipped: nodes in which
/// no spatial split was tried since the "children do not overlap", and spatial splits "over the reference
/// budget".
struct SpatialSplits {
    int max_leaf_size = 8;                  ///< a larger set is always split, 1 to 64
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16
    float overlap = 1e-5f;  ///< alpha: least common area of the children, as a share of the root's, 0 to 1
    float budget = 2.0f;    ///< references at most, for each one given, 1 to 16
    int bin_count = 16;     ///< of a spatial split, per axis, 4 to 64

    static constexpr uint32_t kSweepCount = 1024;

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
        v.on_float("overlap", overlap, 0.0f, 1.0f,
                   "spatial splits where the children share this much of the root's area");
        v.on_float("budget", budget, 1.0f, 16.0f, "references in leaves at most, for each one given");
        v.on_int("bins", bin_count, 4, 64, "slabs per axis between which space may be split");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
