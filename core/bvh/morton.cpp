#include "core/bvh/morton.h"

#include "core/bvh/leaf_duplicates.h"
#include "core/bvh/morton_parts.h"

namespace boxwood {

namespace {

class MortonBuild {
public:
    MortonBuild(uint32_t max_leaf_size, std::span<const PrimRef> refs, const Task& task)
        : max_leaf_size_(max_leaf_size),
          refs_(refs),
          task_(task),
          order_(morton_order(refs, max_leaf_size, task)) {}

    Bvh2 build() {
        if (refs_.empty() || task_.stopped()) return {};
        top_ = divide_morton(order_, kMortonPartSize);
        for_each_part(top_, task_, [&](size_t i) {
            TopNode& part = top_[i];
            const MortonPartSplits splits(order_, part.range);
            part.node_count = 2 * count_leaves(splits, part.range, part.depth, splits.of_all()) - 1;
        });
        place(top_);
        bvh_.nodes.resize(top_[0].node_count);
        bvh_.prims.resize(refs_.size());
        for_each_part(top_, task_, [&](size_t i) {
            const TopNode& part = top_[i];
            const MortonPartSplits splits(order_, part.range);
            uint32_t next = part.below;
            build_node(splits, part.node, part.range, part.depth, splits.of_all(), next);
        });
        if (task_.stopped()) return {};
        write_inner_nodes(top_, bvh_.nodes);
        return std::move(bvh_);
    }

private:
    uint32_t count_leaves(const MortonPartSplits& splits, RefRange range, uint32_t depth,
                          uint32_t split) const {
        if (range.count() <= max_leaf_size_) return 1;
        const MortonDivision at = splits.divide(range, depth, split);
        return count_leaves(splits, {range.begin, at.mid}, depth + 1, at.left_split) +
               count_leaves(splits, {at.mid, range.end}, depth + 1, at.right_split);
    }

    /// Makes a node and all below it, which begin at `next`.
    Box4 build_node(const MortonPartSplits& splits, uint32_t node, RefRange range, uint32_t depth,
                    uint32_t split, uint32_t& next) {
        if (range.count() <= max_leaf_size_) return make_leaf(node, range);
        const MortonDivision at = splits.divide(range, depth, split);
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
