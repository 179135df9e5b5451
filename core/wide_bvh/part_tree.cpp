#include "core/wide_bvh/part_tree.h"

#include "core/bvh/split_ref.h"

namespace boxwood {

PartTree::PartTree(const PartCosts& costs, uint32_t most_leaves)
    : costs_(costs), nodes_(size_t{2} * most_leaves), choices_(most_leaves) {}

PartTree::Costs PartTree::set_leaf(uint32_t node, const Box4& box, uint32_t pack) {
    store_node(nodes_[node], box, pack, 1);
    return {leaf_costs<16>(half_area(box) * costs_.pack), 1};
}

PartTree::Costs PartTree::set_part(uint32_t node, const Box4& box, uint32_t part, double cost) {
    store_node(nodes_[node], box, part, 1);
    return {leaf_costs<16>(cost), kMany};
}

PartTree::Costs PartTree::set_inner(uint32_t node, const Box4& box, uint32_t left, const Costs& left_costs,
                                    const Costs& right_costs) {
    store_node(nodes_[node], box, left, 0);
    const double area = half_area(box);
    const uint32_t count = std::min(left_costs.pack_count + right_costs.pack_count, kMany);
    const double as_leaf =
        count <= costs_.most_packs ? area * count * costs_.pack : std::numeric_limits<double>::infinity();
    return {
        least_costs<16>(left_costs.costs, right_costs.costs, area * costs_.node, as_leaf, choices_[left / 2]),
        count};
}

WideParts<16> PartTree::children_of(uint32_t node) const {
    WideParts<16> parts;
    add_parts(node, 16, parts);
    return parts;
}

void PartTree::add_parts(uint32_t node, uint32_t most, WideParts<16>& parts) const {
    if (nodes_[node].is_leaf()) return parts.add({node, /*is_leaf=*/true});
    const Choice& choice = choice_of(node);
    while (most > 1 && choice[most - 1] == 0) --most;
    if (most == 1) return parts.add({node, choice[0] != 0});
    const uint32_t left = nodes_[node].first;
    add_parts(left, choice[most - 1], parts);
    add_parts(left + 1, most - choice[most - 1], parts);
}

WideChild PartTree::leaf(uint32_t node) const {
    uint32_t first = node, last = node;
    while (!nodes_[first].is_leaf()) first = nodes_[first].first;
    while (!nodes_[last].is_leaf()) last = nodes_[last].first + 1;
    return WideChild::leaf(nodes_[first].first, nodes_[last].first + 1 - nodes_[first].first);
}

}  // namespace boxwood
