#include "core/wide_bvh/binned_part.h"

namespace boxwood {

namespace {

constexpr int kMostBins = 16, kLogPack = 3;
static_assert(Pack8::kSize == 1 << kLogPack);

Box4 half_centers_of(std::span<const BinRef> refs) {
    Box4 box = empty_box4();
    for (const BinRef& ref : refs) {
        const Float4 center = ref.half_center();
        box.extend(center, center);
    }
    return box;
}

Box4 box_of(std::span<const BinRef> refs) {
    Box4 box = empty_box4();
    for (const BinRef& ref : refs) box.extend(ref.lower, ref.upper);
    return box;
}

}  // namespace

PartRoot BinnedPartBuild::build(std::span<const PrimRef> refs, const MortonOrder& order, RefRange range,
                                uint32_t depth, PartTree& tree) {
    constexpr uint32_t kAhead = 16;
    for (uint32_t i = range.begin; i < range.end; ++i) {
        if (i + kAhead < refs.size()) __builtin_prefetch(&refs[order.ref(i + kAhead)]);
        arrays_[0][i - range.begin] = BinRef::of(refs[order.ref(i)]);
    }
    tree.clear();
    tree_ = &tree;
    pack_count_ = 0;
    const Box4 box = box_of(std::span(arrays_[0]).first(range.count()));
    return {box, build_node(0, {0, range.count()}, depth, 0, box)};
}

PartTree::Costs BinnedPartBuild::build_node(uint32_t node, RefRange range, uint32_t depth, int array,
                                            const Box4& box) {
    if (range.count() <= Pack8::kSize)
        return make_leaf(node, std::span(arrays_[array]).subspan(range.begin, range.count()), box);
    const Division at = divide(range, depth, array, box);
    const uint32_t left = tree_->add_children(), mid = range.begin + at.left_count;
    const PartTree::Costs left_costs = build_node(left, {range.begin, mid}, depth + 1, at.next, at.left);
    const PartTree::Costs right_costs = build_node(left + 1, {mid, range.end}, depth + 1, at.next, at.right);
    return tree_->set_inner(node, box, left, left_costs, right_costs);
}

PartTree::Costs BinnedPartBuild::make_leaf(uint32_t node, std::span<const BinRef> refs, const Box4& box) {
    PackPrims& pack = packs_[pack_count_];
    for (size_t i = 0; i < Pack8::kSize; ++i) pack[i] = refs[std::min(i, refs.size() - 1)].prim();
    return tree_->set_leaf(node, box, pack_count_++);
}

BinnedPartBuild::Division BinnedPartBuild::divide(RefRange range, uint32_t depth, int array,
                                                  const Box4& box) {
    const std::span<const BinRef> refs = std::span(arrays_[array]).subspan(range.begin, range.count());
    BinSplit split;
    // Wald 2007, section 3.5.1: a small node needs few bins.
    const Binning binning(half_centers_of(refs), std::min(kMostBins, 4 + static_cast<int>(range.count())));
    if (!must_halve(depth, range.count())) {
        bins_.fill(refs, binning);
        split = bins_.cheapest_split(binning.bin_count, range.count(), area_scale(box), kLogPack);
    }
    if (split.axis < 0) {
        const size_t half = refs.size() / 2;
        return {static_cast<uint32_t>(half), array, box_of(refs.first(half)), box_of(refs.subspan(half))};
    }
    const uint32_t left_count = bins_.count_of(split.axis, split.bin);
    BinRef* left = &arrays_[1 - array][range.begin];
    BinRef* right = left + left_count;
    const auto plane = static_cast<float>(split.bin);
    for (const BinRef& ref : refs) {
        const bool is_left = binning.position(ref)[split.axis] < plane;
        *(is_left ? left : right) = ref;  // no branch: no processor could predict it
        left += is_left;
        right += !is_left;
    }
    return {left_count, 1 - array, bins_.box_of(split.axis, 0, split.bin),
            bins_.box_of(split.axis, split.bin, binning.bin_count)};
}

}  // namespace boxwood
