#include "core/bvh/morton_parts.h"

namespace boxwood {

namespace {

/// Where a large range is split.
uint32_t middle(const MortonOrder& order, RefRange range, uint32_t depth) {
    const uint32_t half = range.begin + range.count() / 2;
    if (must_halve(depth, range.count())) return half;
    const uint64_t difference = order.leading_code(range.begin) ^ order.leading_code(range.end - 1);
    if (difference != 0) {
        const uint64_t bit = std::bit_floor(difference) << MortonOrder::kRefBits;
        const auto keys = std::span(order.keys).subspan(range.begin, range.count());
        const auto mid =
            std::partition_point(keys.begin(), keys.end(), [bit](uint64_t key) { return (key & bit) == 0; });
        return range.begin + static_cast<uint32_t>(mid - keys.begin());
    }
    const auto levels = std::span(order.levels).subspan(range.begin, range.count() - 1);
    const auto least = std::min_element(levels.begin(), levels.end());
    if (*least == MortonOrder::kEqual) return half;
    return range.begin + static_cast<uint32_t>(least - levels.begin()) + 1;
}

}  // namespace

std::vector<TopNode> divide_morton(const MortonOrder& order, uint32_t part_size) {
    std::vector<TopNode> top{{{0, static_cast<uint32_t>(order.keys.size())}, 0}};
    for (size_t i = 0; i < top.size(); ++i) {
        const RefRange range = top[i].range;
        if (range.count() > part_size) divide(top, i, middle(order, range, top[i].depth));
    }
    return top;
}

MortonPartSplits::MortonPartSplits(std::span<const uint8_t> levels, uint32_t first)
    : levels_(levels), first_(first) {
    for (uint32_t i = 0; i < levels.size(); ++i) {
        uint32_t last = kHalve;
        while (size_ > 0 && levels[stack_[size_ - 1]] > levels[i]) last = first + stack_[--size_];
        left_[i] = last;
        right_[i] = kHalve;
        if (size_ > 0) right_[stack_[size_ - 1]] = first + i;
        stack_[size_++] = i;
    }
}

MortonDivision MortonPartSplits::divide(RefRange range, uint32_t depth, uint32_t split) const {
    if (split == kHalve || levels_[split - first_] == MortonOrder::kEqual || must_halve(depth, range.count()))
        return {range.begin + range.count() / 2, kHalve, kHalve};
    return {split + 1, left_[split - first_], right_[split - first_]};
}

}  // namespace boxwood
