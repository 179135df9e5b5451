#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/bvh/spatial_splits.h"
#include "core/bvh/split_ref.h"

namespace boxwood {

/// A finished part of a tree: nodes in depth-first order as in Bvh2, the first one its root.
struct Subtree {
    std::vector<Bvh2::Node> nodes;
    std::vector<uint32_t> prims;
};

/// The cheapest of all binary trees over a handful of references, leaves of every size included: dynamic
/// programming over their subsets. Karras, Aila, "Fast Parallel Construction of High-Quality Bounding Volume
/// Hierarchies", HPG 2013, section 3.2. Differs: for what is built anew, not for treelets of a finished tree.
class OptimalSubtree {
public:
    static constexpr uint32_t kMostRefs = 6;

    /// 2 to kMostRefs references.
    OptimalSubtree(const SpatialSplits& params, std::span<const SplitRef> refs);
    /// Puts the tree below a node that is there, and into it; returns its cost times half areas.
    double write(uint32_t node, Subtree& tree) const { return write_subset(all_, node, tree); }

private:
    static constexpr uint32_t kSubsets = 1u << kMostRefs;

    uint32_t unique_count(uint32_t subset) const;
    double write_subset(uint32_t subset, uint32_t node, Subtree& tree) const;

    std::span<const SplitRef> refs_;
    uint32_t all_;
    std::array<uint32_t, kMostRefs> same_before_{};  ///< for each reference: those before it of its primitive
    std::array<Box4, kSubsets> boxes_;
    std::array<double, kSubsets> costs_;
    std::array<uint32_t, kSubsets> lefts_;  ///< the part of a subset that goes left; 0: a leaf
};

}  // namespace boxwood
