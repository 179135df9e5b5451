#include "core/bvh/optimal_subtree.h"

#include <bit>

namespace boxwood {

OptimalSubtree::OptimalSubtree(const SpatialSplits& params, std::span<const SplitRef> refs)
    : refs_(refs), all_((1u << refs.size()) - 1) {
    for (uint32_t i = 0; i < refs.size(); ++i)
        for (uint32_t j = 0; j < i; ++j)
            if (refs[j].prim == refs[i].prim) same_before_[i] |= 1u << j;
    const auto max_leaf_size = static_cast<uint32_t>(params.max_leaf_size);
    boxes_[0] = empty_box4();
    for (uint32_t subset = 1; subset <= all_; ++subset) {
        const SplitRef& ref = refs[static_cast<size_t>(std::countr_zero(subset))];
        const uint32_t others = subset & (subset - 1);
        boxes_[subset] = boxes_[others];
        boxes_[subset].extend(load_lower(ref), load_upper(ref));
        const double area = half_area(boxes_[subset]);
        const uint32_t count = unique_count(subset);
        lefts_[subset] = 0;
        costs_[subset] =
            count <= max_leaf_size ? leaf_cost(count) * area : std::numeric_limits<double>::infinity();
        if (count == 1) continue;
        // Every way to part it in two: `part` is what goes with the lowest one.
        double least = std::numeric_limits<double>::infinity();
        uint32_t left = 0;
        for (uint32_t right = others; right != 0; right = (right - 1) & others) {
            const double cost = costs_[right] + costs_[subset ^ right];
            if (cost < least) {
                least = cost;
                left = subset ^ right;
            }
        }
        const double cost = static_cast<double>(params.traversal_cost) * area + least;
        if (cost < costs_[subset]) {
            costs_[subset] = cost;
            lefts_[subset] = left;
        }
    }
}

uint32_t OptimalSubtree::unique_count(uint32_t subset) const {
    auto count = static_cast<uint32_t>(std::popcount(subset));
    for (uint32_t i = 0; i < refs_.size(); ++i)
        if ((subset >> i & 1) != 0 && (same_before_[i] & subset) != 0) --count;
    return count;
}

double OptimalSubtree::write_subset(uint32_t subset, uint32_t node, Subtree& tree) const {
    const Box box = boxes_[subset].box();
    const uint32_t left = lefts_[subset];
    if (left != 0) {
        const auto child = static_cast<uint32_t>(tree.nodes.size());
        tree.nodes[node] = {box.lower, child, box.upper, 0};
        tree.nodes.resize(tree.nodes.size() + 2);
        write_subset(left, child, tree);
        write_subset(subset ^ left, child + 1, tree);
        return costs_[subset];
    }
    const size_t first = tree.prims.size();
    for (uint32_t i = 0; i < refs_.size(); ++i)
        if ((subset >> i & 1) != 0 && (same_before_[i] & subset) == 0) tree.prims.push_back(refs_[i].prim);
    std::sort(tree.prims.begin() + static_cast<std::ptrdiff_t>(first), tree.prims.end());
    tree.nodes[node] = {box.lower, static_cast<uint32_t>(first), box.upper,
                        static_cast<uint32_t>(tree.prims.size() - first)};
    return costs_[subset];
}

}  // namespace boxwood
