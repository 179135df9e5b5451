#include "core/wide_bvh/morton_part.h"

#include <algorithm>

namespace boxwood {

std::vector<uint32_t> morton_packs(const MortonOrder& order, RefRange range) {
    constexpr uint32_t kMeanSize = 6;  // about; smaller ones need more memory for a moment
    std::vector<uint32_t> first;
    first.reserve(range.count() / kMeanSize + 2);
    uint32_t at = range.begin;
    while (range.end - at > Pack8::kSize) {
        first.push_back(at);
        const uint8_t* const levels = &order.levels[at];
        uint32_t best = Pack8::kSize;
        int best_cost = levels[best - 1] - static_cast<int>(best);
        for (uint32_t count = Pack8::kSize - 1; count > 0; --count) {
            const int cost = levels[count - 1] - static_cast<int>(count);
            if (cost < best_cost) {
                best_cost = cost;
                best = count;
            }
        }
        at += best;
    }
    first.push_back(at);
    first.push_back(range.end);
    return first;
}

PartRoot MortonPartBuild::build(const MortonOrder& order, std::span<const uint32_t> first, uint32_t depth,
                                const PackFiller& filler, std::span<Pack8> packs, PartTree& tree) {
    fill_packs(order, first, filler, packs);
    const auto count = static_cast<uint32_t>(packs.size());
    for (uint32_t i = 0; i + 1 < count; ++i) levels_[i] = order.levels[first[i + 1] - 1];
    const MortonPartSplits splits({levels_.data(), count - 1}, 0);
    tree.clear();
    return build_node(splits, 0, {0, count}, depth, splits.of_all(), tree);
}

void MortonPartBuild::fill_packs(const MortonOrder& order, std::span<const uint32_t> first,
                                 const PackFiller& filler, std::span<Pack8> packs) {
    constexpr size_t kAhead = 64, kCornersAhead = 32;
    const size_t end = order.keys.size();
    for (size_t i = 0; i < packs.size(); ++i) {
        PackPrims prims;
        for (uint32_t lane = 0; lane < Pack8::kSize; ++lane)
            prims[lane] = order.ref(std::min(first[i] + lane, first[i + 1] - 1));
        for (size_t at = first[i]; at < first[i + 1]; ++at) {
            if (at + kAhead < end) filler.prefetch(order.ref(at + kAhead));
            if (at + kCornersAhead < end) filler.prefetch_corners(order.ref(at + kCornersAhead));
        }
        boxes_[i] = filler.fill(prims, packs[i]);
    }
}

PartRoot MortonPartBuild::build_node(const MortonPartSplits& splits, uint32_t node, RefRange packs,
                                     uint32_t depth, uint32_t split, PartTree& tree) const {
    if (packs.count() == 1) {
        const Box4& box = boxes_[packs.begin];
        return {box, tree.set_leaf(node, box, packs.begin)};
    }
    const MortonDivision at = splits.divide(packs, depth, split);
    const uint32_t left = tree.add_children();
    PartRoot result = build_node(splits, left, {packs.begin, at.mid}, depth + 1, at.left_split, tree);
    const PartRoot right = build_node(splits, left + 1, {at.mid, packs.end}, depth + 1, at.right_split, tree);
    result.box.extend(right.box.lower, right.box.upper);
    result.costs = tree.set_inner(node, result.box, left, result.costs, right.costs);
    return result;
}

}  // namespace boxwood
