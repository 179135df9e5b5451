#pragma once

#include "core/bvh/box4.h"
#include "core/wide_bvh/least_costs.h"
#include "core/wide_bvh/wide_output.h"

namespace boxwood {

/// What a sixteen-wide hierarchy costs (see WideCosts), and how large a leaf may be that is made of several.
struct PartCosts {
    double node, pack;
    uint32_t most_packs;
};

/// A binary tree under construction whose least-cost collapse to sixteen children is found as it grows,
/// bottom up. A leaf is one pack. The costs are those of LeastCostPlan, but for the factor of the root's
/// area.
class PartTree {
public:
    /// Of a subtree.
    struct Costs {
        LeastCosts<16> costs;
        uint32_t pack_count;
    };

    /// Room for so many leaves.
    PartTree(const PartCosts& costs, uint32_t most_leaves);

    /// Back to a root alone, which is node 0.
    void clear() { node_count_ = 1; }
    /// Room for two children; returns the left one.
    uint32_t add_children() { return std::exchange(node_count_, node_count_ + 2); }
    /// Makes a node a leaf of the given pack; leaves in the order of their packs.
    Costs set_leaf(uint32_t node, const Box4& box, uint32_t pack);
    /// Makes a node a leaf of the given cost that stands for a part, and must not be merged with others.
    Costs set_part(uint32_t node, const Box4& box, uint32_t part, double cost);
    Costs set_inner(uint32_t node, const Box4& box, uint32_t left, const Costs& left_costs,
                    const Costs& right_costs);

    const Bvh2::Node& node(uint32_t index) const { return nodes_[index]; }
    /// Whether all below the node is best one leaf.
    bool is_leaf(uint32_t node) const { return nodes_[node].is_leaf() || choice_of(node)[0] != 0; }
    /// See WidePlan; in the order of their packs.
    WideParts<16> children_of(uint32_t node) const;
    /// Of a node that is one leaf.
    WideChild leaf(uint32_t node) const;

private:
    using Choice = LeastCostChoice<16>;
    static constexpr uint32_t kMany = 1u << 30;  ///< packs of a part, as if there were so many

    void add_parts(uint32_t node, uint32_t most, WideParts<16>& parts) const;
    const Choice& choice_of(uint32_t inner) const { return choices_[nodes_[inner].first / 2]; }

    PartCosts costs_;
    Array<Bvh2::Node> nodes_;
    Array<Choice> choices_;  ///< of the inner nodes, in the order of their children
    uint32_t node_count_ = 1;
};

/// A subtree with what it costs.
struct PartRoot {
    Box4 box;
    PartTree::Costs costs;
};

}  // namespace boxwood
