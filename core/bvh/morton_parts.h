#pragma once

#include <array>

#include "core/bvh/morton_order.h"
#include "core/bvh/top_nodes.h"

namespace boxwood {

/// References of a part at most: of a subtree of the Morton order that one thread builds.
constexpr uint32_t kMortonPartSize = 4096;

/// The top of the hierarchy that the Morton order stands for, down to sets of up to `part_size` references,
/// the parts. A node is split where the first bit of its codes changes; equal codes, and nodes so deep that
/// kMaxDepth could not be kept, are halved by count.
std::vector<TopNode> divide_morton(const MortonOrder& order, uint32_t part_size);

/// Where a node is split: its right side begins at `mid`; the boundaries at which both sides are split.
struct MortonDivision {
    uint32_t mid, left_split, right_split;
};

/// The splits within a part, found in one pass. A split is a boundary between neighbours, named by the left
/// one; the split of a range is the boundary at which the codes differ first.
class MortonPartSplits {
public:
    static constexpr uint32_t kHalve = kNoIndex;

    /// `levels`: of the boundaries (see MortonOrder), fewer than kMortonPartSize; the first one is named
    /// `first`.
    MortonPartSplits(std::span<const uint8_t> levels, uint32_t first);
    MortonPartSplits(const MortonOrder& order, RefRange range)
        : MortonPartSplits(std::span(order.levels).subspan(range.begin, range.count() - 1), range.begin) {}
    uint32_t of_all() const { return size_ > 0 ? stack_[0] + first_ : kHalve; }
    MortonDivision divide(RefRange range, uint32_t depth, uint32_t split) const;

private:
    std::span<const uint8_t> levels_;
    uint32_t first_;
    uint32_t size_ = 0;  ///< of the stack: boundaries of rising level whose right side is open
    std::array<uint32_t, kMortonPartSize> stack_, left_, right_;
};

}  // namespace boxwood
