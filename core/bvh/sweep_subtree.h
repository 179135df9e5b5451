#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/bvh/optimal_subtree.h"
#include "core/bvh/spatial_bins.h"

namespace boxwood {

/// What was not done, see SpatialSplits.
struct SplitCounts {
    uint64_t without_overlap = 0, over_budget = 0;
};

/// Of the references that the leaves below a node may hold in all, what the left child's may hold: what is
/// beyond those that the children have is shared out in the ratio of count times area. Requires
/// most_refs >= left_count + right_count.
uint64_t left_budget(uint64_t most_refs, uint32_t left_count, const Box4& left, uint32_t right_count,
                     const Box4& right);

/// Slabs per axis for a node of so many references: a small one needs few. Wald 2007, section 3.5.1.
inline int bins_for(const SpatialSplits& params, uint32_t count) {
    return static_cast<int>(std::min(static_cast<uint32_t>(params.bin_count), 4 + count / 4));
}

/// Builds the part of a tree below a node of few references: every object split between two centres is
/// weighed, and spatial splits. The references are sorted once for each axis, then kept in order. The arrays
/// are kept from one subtree to the next.
class SweepSubtree {
public:
    SweepSubtree(const SpatialSplits& params, const Mesh& mesh, double root_half_area)
        : params_(params), mesh_(mesh), least_overlap_(double(params.overlap) * root_half_area) {}

    /// `most_refs`: what the leaves may hold in all. refs.size() is in 1 to most_refs.
    Subtree build(std::span<const SplitRef> refs, uint64_t most_refs, uint32_t depth);
    const SplitCounts& counts() const { return counts_; }

private:
    /// References in three orders: order_[first + axis * stride, + count), as places in refs_.
    struct Set {
        uint32_t first, stride, count;
        Box4 box;
        uint64_t most_refs;
    };
    struct ObjectSplit {
        double cost = std::numeric_limits<double>::infinity();  ///< sum of count * half area of both sides
        int axis = -1;
        uint32_t left_count = 0;
    };
    struct Children {
        Set left, right;
        bool are_cut;  ///< their orders and new references lie on top of the stacks
    };

    double build_optimal(uint32_t node, const Set& set);
    double build_node(uint32_t node, const Set& set, uint32_t depth);
    double make_leaf(uint32_t node, const Set& set);
    uint32_t unique_count(const Set& set);
    std::optional<Children> divide(const Set& set, uint32_t depth);
    ObjectSplit cheapest_object_split(const Set& set);
    void sweep_axis(const Set& set, int axis, ObjectSplit& best);
    Children divide_objects(const Set& set, const ObjectSplit& split);
    std::optional<Children> divide_space(const Set& set, double object_cost);
    void sort_by_center(const Set& set, int axis);
    void merge_side(const Set& set, Set& side, Side which, uint32_t first_new);
    Box4 box_of(const uint32_t* order, uint32_t count) const;

    const SpatialSplits& params_;
    const Mesh& mesh_;
    double least_overlap_;
    SplitCounts counts_;
    Subtree tree_;
    std::vector<SplitRef> refs_;
    std::vector<uint32_t> order_;
    std::vector<uint8_t> sides_;      ///< by place in refs_: Side
    std::vector<double> right_area_;  ///< of the sweep
    std::vector<uint32_t> spare_;
    std::vector<uint32_t> prims_;
    bool may_repeat_ = false;  ///< whether two references may be of one primitive
};

}  // namespace boxwood
