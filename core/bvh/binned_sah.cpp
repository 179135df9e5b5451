#include "core/bvh/binned_sah.h"

#include <array>

#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

constexpr int kMaxBins = 256;

struct Bin {
    Box bounds;
    uint32_t count = 0;
};

/// Maps centres to bins: Wald 2007, section 3.1. Scale 0 on an axis without extent.
struct Binning {
    Vec3 lower;
    Vec3 scale;
    int bin_count;

    Binning(std::span<const PrimRef> refs, int bins) : bin_count(bins) {
        Vec3 upper(-std::numeric_limits<float>::infinity());
        lower = Vec3(std::numeric_limits<float>::infinity());
        for (const PrimRef& ref : refs) {
            const Vec3 center = doubled_center(ref.bounds);
            lower = glm::min(lower, center);
            upper = glm::max(upper, center);
        }
        // k1 = bins (1 - epsilon) / extent; an extent without a finite inverse is none.
        const Vec3 extent = upper - lower;
        for (int axis = 0; axis < 3; ++axis) {
            const float k1 = static_cast<float>(bins) * 0.99999f / extent[axis];
            scale[axis] = std::isfinite(k1) ? k1 : 0.0f;
        }
    }
    int bin(const PrimRef& ref, int axis) const {
        const Vec3 center = doubled_center(ref.bounds);
        return std::min(static_cast<int>((center[axis] - lower[axis]) * scale[axis]), bin_count - 1);
    }
};

struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of count * half area of both sides
    int axis = -1;
    int bin = 0;  ///< first bin of the right side
    uint32_t left_count = 0;
};

/// Cheapest plane between two bins of one axis; the more even one of equally cheap ones.
void sweep_axis(std::span<const Bin> bins, int axis, uint32_t count, Split& best) {
    std::array<double, kMaxBins> right_cost;
    Box box;
    uint32_t right_count = 0;
    for (size_t i = bins.size() - 1; i > 0; --i) {
        box.extend(bins[i].bounds);
        right_count += bins[i].count;
        right_cost[i] = right_count * box.half_area();
    }
    box = Box{};
    uint32_t left_count = 0;
    const auto imbalance = [&](uint32_t left) {
        return left > count - left ? 2 * left - count : count - 2 * left;
    };
    for (size_t i = 1; i < bins.size(); ++i) {
        box.extend(bins[i - 1].bounds);
        left_count += bins[i - 1].count;
        if (left_count == 0 || left_count == count) continue;
        const double cost = left_count * box.half_area() + right_cost[i];
        if (cost < best.cost || (cost == best.cost && imbalance(left_count) < imbalance(best.left_count))) {
            best = {cost, axis, static_cast<int>(i), left_count};
        }
    }
}

Split cheapest_split(std::span<const PrimRef> refs, const Binning& binning) {
    const auto bin_count = static_cast<size_t>(binning.bin_count);
    std::array<std::array<Bin, kMaxBins>, 3> storage;
    for (const PrimRef& ref : refs) {
        for (size_t axis = 0; axis < 3; ++axis) {
            Bin& bin = storage[axis][static_cast<size_t>(binning.bin(ref, static_cast<int>(axis)))];
            bin.bounds.extend(ref.bounds);
            ++bin.count;
        }
    }
    Split best;
    for (size_t axis = 0; axis < 3; ++axis) {
        sweep_axis(std::span(storage[axis]).first(bin_count), static_cast<int>(axis),
                   static_cast<uint32_t>(refs.size()), best);
    }
    return best;
}

}  // namespace

Bvh2 BinnedSah::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    const auto partition = [&](std::span<PrimRef> node_refs, const Box& bounds,
                               uint32_t depth) -> std::optional<uint32_t> {
        const auto count = static_cast<uint32_t>(node_refs.size());
        const bool fits_a_leaf = count <= static_cast<uint32_t>(max_leaf_size);
        if (!must_halve(depth, count)) {
            const Binning binning(node_refs, bin_count);
            const Split split = cheapest_split(node_refs, binning);
            const double area = bounds.half_area();
            const double split_cost =
                static_cast<double>(traversal_cost) * area + kIntersectionCost * split.cost;
            const double leaf_cost = kIntersectionCost * count * area;
            if (fits_a_leaf && leaf_cost <= split_cost) return std::nullopt;
            if (split.axis >= 0) {
                std::partition(node_refs.begin(), node_refs.end(),
                               [&](const PrimRef& ref) { return binning.bin(ref, split.axis) < split.bin; });
                return split.left_count;
            }
        }
        if (fits_a_leaf) return std::nullopt;
        return count / 2;
    };
    return TopDown(refs, partition, task).build();
}

}  // namespace boxwood
