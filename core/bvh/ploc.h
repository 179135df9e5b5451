#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Clusters along the Morton curve merge bottom-up: in each round every two that are each other's nearest,
/// where the distance of two is the area of their common box and only neighbours along the curve are looked
/// at. Meister, Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction",
/// IEEE Transactions on Visualization and Computer Graphics 24(3), 2018, section 3; leaves by section 3.4.
/// Differs: of equally near neighbours i and j the one with the least i xor j is taken, so that equal
/// clusters merge in pairs; a round in which few merge pairs all neighbours, and so does one in which no two
/// could merge within kMaxDepth.
struct Ploc {
    int radius = 16;                        ///< neighbours looked at on each side, 1 to 128
    int max_leaf_size = 8;                  ///< a larger set is always split, 1 to 64
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16

    void describe(ParamVisitor& v) {
        v.on_int("radius", radius, 1, 128, "neighbours along the curve that are looked at on each side");
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
        return build_within(Bvh2::kMaxDepth, mesh, refs, task);
    }
    /// With at most so many levels below the root: no fewer than ceil(log2 of the references).
    Bvh2 build_within(uint32_t max_depth, const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
