#include "core/bvh/bins.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"

namespace boxwood {

namespace {

/// Half areas of three boxes from their extents, each in its lane.
Float4 half_areas(Float4 a, Float4 b, Float4 c) {
    const Float4 xy = __builtin_shufflevector(a, b, 0, 4, 1, 5);  // ax bx ay by
    const Float4 zw = __builtin_shufflevector(a, b, 2, 6, 3, 7);  // az bz
    const Float4 x = __builtin_shufflevector(xy, c, 0, 1, 4, 5);
    const Float4 y = __builtin_shufflevector(xy, c, 2, 3, 5, 5);
    const Float4 z = __builtin_shufflevector(zw, c, 0, 1, 6, 7);
    return x * y + y * z + z * x;
}

Float4 to_float(Int4 v) { return __builtin_convertvector(v, Float4); }

/// The three boxes of a sweep, one for each axis.
struct Sweep {
    Box4 boxes[3] = {empty_box4(), empty_box4(), empty_box4()};
    Int4 counts{};

    void add(const Box4 (&bin)[3], Int4 count) {
        for (int axis = 0; axis < 3; ++axis) boxes[axis].extend(bin[axis].lower, bin[axis].upper);
        counts += count;
    }
    /// Blocks * half area; NaN where there is no box.
    template <bool is_scaled, int log_block>
    Float4 costs(float scale) const {
        const auto extent = [&](const Box4& box) {
            return is_scaled ? scaled_extent(box, scale) : box.upper - box.lower;
        };
        const Int4 blocks = (counts + ((1 << log_block) - 1)) >> log_block;
        return to_float(blocks) * half_areas(extent(boxes[0]), extent(boxes[1]), extent(boxes[2]));
    }
};

Int4 absolute(Int4 v) { return v < 0 ? -v : v; }

}  // namespace

Binning::Binning(const Box4& half_centers, int bins) : lower(half_centers.lower), bin_count(bins) {
    // k1 = bins (1 - epsilon) / extent; an extent without a finite inverse is none.
    const Float4 extent = half_centers.upper - lower;
    scale = splat(static_cast<float>(bins) * 0.99999f) / extent;
    scale[3] = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        if (!std::isfinite(scale[axis])) scale[axis] = 0.0f;
}

void Bins::fill(std::span<const BinRef> refs, const Binning& binning) {
    for (int i = 0; i < binning.bin_count; ++i) {
        for (Box4& box : boxes[i]) box = empty_box4();
        counts[i] = Int4{};
    }
    const int32_t last = binning.bin_count - 1;
    for (const BinRef& ref : refs) {
        const Int4 bin = __builtin_convertvector(binning.position(ref), Int4);
        for (int axis = 0; axis < 3; ++axis) {
            const int32_t i = std::min(bin[axis], last);
            boxes[i][axis].extend(ref.lower, ref.upper);
            ++counts[i][axis];
        }
    }
}

void Bins::add(const Bins& other, int bin_count) {
    for (int i = 0; i < bin_count; ++i) {
        for (int axis = 0; axis < 3; ++axis)
            boxes[i][axis].extend(other.boxes[i][axis].lower, other.boxes[i][axis].upper);
        counts[i] += other.counts[i];
    }
}

template <bool is_scaled, int log_block>
BinSplit Bins::sweep(int bin_count, uint32_t count, float scale) const {
    Float4 right_costs[kMaxBins];
    Sweep right;
    for (int i = bin_count - 1; i > 0; --i) {
        right.add(boxes[i], counts[i]);
        right_costs[i] = right.costs<is_scaled, log_block>(scale);
    }
    Sweep left;
    Float4 best_cost = splat(std::numeric_limits<float>::infinity());
    Int4 best_bin{}, best_imbalance{};
    const auto all = static_cast<int32_t>(count);
    for (int i = 1; i < bin_count; ++i) {
        left.add(boxes[i - 1], counts[i - 1]);
        const Float4 cost =
            left.costs<is_scaled, log_block>(scale) + right_costs[i];  // NaN where a side is empty
        const Int4 imbalance = absolute(left.counts + left.counts - all);
        const Int4 is_better = (cost < best_cost) | ((cost == best_cost) & (imbalance < best_imbalance));
        best_cost = is_better ? cost : best_cost;
        best_bin = is_better ? Int4{i, i, i, i} : best_bin;
        best_imbalance = is_better ? imbalance : best_imbalance;
    }
    BinSplit best;
    int32_t imbalance = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (best_bin[axis] == 0) continue;
        if (best_cost[axis] < best.cost ||
            (best_cost[axis] == best.cost && best_imbalance[axis] < imbalance)) {
            best = {best_cost[axis], axis, best_bin[axis]};
            imbalance = best_imbalance[axis];
        }
    }
    return best;
}

BinSplit Bins::cheapest_split(int bin_count, uint32_t count, float area_scale, int log_block) const {
    BOXWOOD_ASSERT(log_block == 0 || log_block == 3);
    if (log_block == 0) {
        return area_scale == 1.0f ? sweep<false, 0>(bin_count, count, area_scale)
                                  : sweep<true, 0>(bin_count, count, area_scale);
    }
    return area_scale == 1.0f ? sweep<false, 3>(bin_count, count, area_scale)
                              : sweep<true, 3>(bin_count, count, area_scale);
}

Box4 Bins::box_of(int axis, int begin, int end) const {
    Box4 box = empty_box4();
    for (int i = begin; i < end; ++i) box.extend(boxes[i][axis].lower, boxes[i][axis].upper);
    return box;
}

uint32_t Bins::count_of(int axis, int end) const {
    int32_t count = 0;
    for (int i = 0; i < end; ++i) count += counts[i][axis];
    return static_cast<uint32_t>(count);
}

float unit_scale(const Box4& box) {
    const Float4 extent = scaled_extent(box, 0.5f);
    const float largest = std::max(extent[0], std::max(extent[1], extent[2]));
    // The exponent alone, inverted: 2^(127 - e) for 2^(e - 127); of nothing and of subnormals 2^126.
    const uint32_t exponent = std::bit_cast<uint32_t>(largest) >> 23;
    return std::bit_cast<float>((254 - std::clamp(exponent, 1u, 252u)) << 23);
}

float area_scale(const Box4& box) {
    constexpr float kLarge = 0x1p40f;
    const float scale = unit_scale(box);
    return scale > 1.0f / kLarge && scale < kLarge ? 1.0f : scale;
}

}  // namespace boxwood
