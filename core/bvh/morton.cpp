#include "core/bvh/morton.h"

#include "core/bvh/leaf_duplicates.h"
#include "core/bvh/morton_order.h"
#include "core/bvh/top_nodes.h"

namespace boxwood {

namespace {

constexpr uint32_t kPartSize = 4096;  ///< references of a subtree that one thread builds, at most
constexpr uint32_t kHalve = kNoIndex;

/// Where a node is split: its right side begins at `mid`; the boundaries at which both sides are split.
struct Division {
    uint32_t mid, left_split, right_split;
};

/// The splits within a part, found in one pass. A split is a boundary between neighbours, named by the left
/// one; the split of a range is the boundary at which the codes differ first.
class PartSplits {
public:
    PartSplits(const MortonOrder& order, RefRange range) : order_(order), first_(range.begin) {
        for (uint32_t i = range.begin; i + 1 < range.end; ++i) {
            uint32_t last = kHalve;
            while (size_ > 0 && order.levels[stack_[size_ - 1]] > order.levels[i]) last = stack_[--size_];
            left_[i - first_] = last;
            right_[i - first_] = kHalve;
            if (size_ > 0) right_[stack_[size_ - 1] - first_] = i;
            stack_[size_++] = i;
        }
    }
    uint32_t of_all() const { return size_ > 0 ? stack_[0] : kHalve; }

    Division divide(RefRange range, uint32_t depth, uint32_t split) const {
        if (split == kHalve || order_.levels[split] == MortonOrder::kEqual ||
            must_halve(depth, range.count()))
            return {range.begin + range.count() / 2, kHalve, kHalve};
        return {split + 1, left_[split - first_], right_[split - first_]};
    }

private:
    const MortonOrder& order_;
    uint32_t first_;
    uint32_t size_ = 0;  ///< of the stack: boundaries of rising level whose right side is open
    std::array<uint32_t, kPartSize> stack_, left_, right_;
};

class MortonBuild {
public:
    MortonBuild(uint32_t max_leaf_size, std::span<const PrimRef> refs, const Task& task)
        : max_leaf_size_(max_leaf_size),
          refs_(refs),
          task_(task),
          order_(morton_order(refs, max_leaf_size, task)) {}

    Bvh2 build() {
        if (refs_.empty() || task_.stopped()) return {};
        divide_top();
        for_each_part(top_, task_, [&](size_t i) {
            TopNode& part = top_[i];
            const PartSplits splits(order_, part.range);
            part.node_count = 2 * count_leaves(splits, part.range, part.depth, splits.of_all()) - 1;
        });
        place(top_);
        bvh_.nodes.resize(top_[0].node_count);
        bvh_.prims.resize(refs_.size());
        for_each_part(top_, task_, [&](size_t i) {
            const TopNode& part = top_[i];
            const PartSplits splits(order_, part.range);
            uint32_t next = part.below;
            build_node(splits, part.node, part.range, part.depth, splits.of_all(), next);
        });
        if (task_.stopped()) return {};
        write_inner_nodes(top_, bvh_.nodes);
        return std::move(bvh_);
    }

private:
    void divide_top() {
        top_.push_back({{0, static_cast<uint32_t>(refs_.size())}, 0});
        for (size_t i = 0; i < top_.size(); ++i) {
            const RefRange range = top_[i].range;
            if (range.count() > kPartSize) divide(top_, i, middle(range, top_[i].depth));
        }
    }

    /// Where a large range is split.
    uint32_t middle(RefRange range, uint32_t depth) const {
        const uint32_t half = range.begin + range.count() / 2;
        if (must_halve(depth, range.count())) return half;
        const uint32_t difference = order_.leading_code(range.begin) ^ order_.leading_code(range.end - 1);
        if (difference != 0) {
            const uint64_t bit = uint64_t{std::bit_floor(difference)} << 32;
            const auto keys = std::span(order_.keys).subspan(range.begin, range.count());
            const auto mid = std::partition_point(keys.begin(), keys.end(),
                                                  [bit](uint64_t key) { return (key & bit) == 0; });
            return range.begin + static_cast<uint32_t>(mid - keys.begin());
        }
        const auto levels = std::span(order_.levels).subspan(range.begin, range.count() - 1);
        const auto least = std::min_element(levels.begin(), levels.end());
        if (*least == MortonOrder::kEqual) return half;
        return range.begin + static_cast<uint32_t>(least - levels.begin()) + 1;
    }

    uint32_t count_leaves(const PartSplits& splits, RefRange range, uint32_t depth, uint32_t split) const {
        if (range.count() <= max_leaf_size_) return 1;
        const Division at = splits.divide(range, depth, split);
        return count_leaves(splits, {range.begin, at.mid}, depth + 1, at.left_split) +
               count_leaves(splits, {at.mid, range.end}, depth + 1, at.right_split);
    }

    /// Makes a node and all below it, which begin at `next`.
    Box4 build_node(const PartSplits& splits, uint32_t node, RefRange range, uint32_t depth, uint32_t split,
                    uint32_t& next) {
        if (range.count() <= max_leaf_size_) return make_leaf(node, range);
        const Division at = splits.divide(range, depth, split);
        const uint32_t left = next;
        next += 2;
        Box4 box = build_node(splits, left, {range.begin, at.mid}, depth + 1, at.left_split, next);
        const Box4 right = build_node(splits, left + 1, {at.mid, range.end}, depth + 1, at.right_split, next);
        box.extend(right.lower, right.upper);
        store_node(bvh_.nodes[node], box, left, 0);
        return box;
    }

    Box4 make_leaf(uint32_t node, RefRange range) {
        constexpr uint32_t kAhead = 16;
        Box4 box = empty_box4();
        for (uint32_t i = range.begin; i < range.end; ++i) {
            if (i + kAhead < refs_.size()) __builtin_prefetch(&refs_[order_.ref(i + kAhead)]);
            const PrimRef& ref = refs_[order_.ref(i)];
            box.extend(load_lower(ref), load_upper(ref));
            bvh_.prims[i] = ref.prim;
        }
        store_node(bvh_.nodes[node], box, range.begin, range.count());
        return box;
    }

    const uint32_t max_leaf_size_;
    std::span<const PrimRef> refs_;
    const Task& task_;
    MortonOrder order_;
    std::vector<TopNode> top_;
    Bvh2 bvh_;
};

}  // namespace

Bvh2 Morton::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    Bvh2 bvh = MortonBuild(static_cast<uint32_t>(max_leaf_size), refs, task).build();
    merge_duplicates(bvh, refs);
    return bvh;
}

}  // namespace boxwood
