#include "core/bvh/binned_sah.h"

#include <array>

#include "core/bvh/box4.h"
#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

constexpr int kMaxBins = 256;

/// Maps centres to bins: Wald 2007, section 3.1. Scale 0 on an axis without extent.
struct Binning {
    Vec3 lower;
    Vec3 scale;
    int bin_count;

    Binning(const Box& half_centers, int bins) : lower(half_centers.lower), bin_count(bins) {
        // k1 = bins (1 - epsilon) / extent; an extent without a finite inverse is none.
        const Vec3 extent = half_centers.upper - lower;
        for (int axis = 0; axis < 3; ++axis) {
            const float k1 = static_cast<float>(bins) * 0.99999f / extent[axis];
            scale[axis] = std::isfinite(k1) ? k1 : 0.0f;
        }
    }
    int bin(const PrimRef& ref, int axis) const {
        const float center = half_center(ref.bounds)[axis];
        return std::min(static_cast<int>((center - lower[axis]) * scale[axis]), bin_count - 1);
    }
};

/// Boxes and counts of the bins of the three axes; only what is used is initialised.
struct Bins {
    Box4 boxes[3][kMaxBins];
    uint32_t counts[3][kMaxBins];

    /// The same arithmetic as Binning::bin, three axes at once.
    void fill(std::span<const PrimRef> refs, const Binning& binning) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(boxes[axis], binning.bin_count, empty_box4());
            std::fill_n(counts[axis], binning.bin_count, 0u);
        }
        const Float4 lower{binning.lower.x, binning.lower.y, binning.lower.z, 0.0f};
        const Float4 scale{binning.scale.x, binning.scale.y, binning.scale.z, 0.0f};
        const int32_t last = binning.bin_count - 1;
        for (const PrimRef& ref : refs) {
            const Float4 ref_lower = load_lower(ref), ref_upper = load_upper(ref);
            const Float4 position = (half_center4(ref_lower, ref_upper) - lower) * scale;
            const Int4 bin = __builtin_convertvector(position, Int4);
            for (int axis = 0; axis < 3; ++axis) {
                const int32_t i = std::min(bin[axis], last);
                boxes[axis][i].extend(ref_lower, ref_upper);
                ++counts[axis][i];
            }
        }
    }
};

struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of count * half area of both sides
    int axis = -1;
    int bin = 0;  ///< first bin of the right side
    uint32_t left_count = 0;
};

/// Of a box that is not empty, in double.
double half_area(const Box4& box) {
    const double x = static_cast<double>(box.upper[0]) - static_cast<double>(box.lower[0]);
    const double y = static_cast<double>(box.upper[1]) - static_cast<double>(box.lower[1]);
    const double z = static_cast<double>(box.upper[2]) - static_cast<double>(box.lower[2]);
    return x * y + y * z + z * x;
}

/// Cheapest plane between two bins of one axis; the more even one of equally cheap ones.
void sweep_axis(const Bins& bins, int bin_count, int axis, uint32_t count, Split& best) {
    const Box4* boxes = bins.boxes[axis];
    const uint32_t* counts = bins.counts[axis];
    std::array<double, kMaxBins> right_cost;
    Box4 box = empty_box4();
    uint32_t right_count = 0;
    for (int i = bin_count - 1; i > 0; --i) {
        box.extend(boxes[i].lower, boxes[i].upper);
        right_count += counts[i];
        right_cost[static_cast<size_t>(i)] = right_count == 0 ? 0.0 : right_count * half_area(box);
    }
    box = empty_box4();
    uint32_t left_count = 0;
    const auto imbalance = [&](uint32_t left) {
        return left > count - left ? 2 * left - count : count - 2 * left;
    };
    for (int i = 1; i < bin_count; ++i) {
        box.extend(boxes[i - 1].lower, boxes[i - 1].upper);
        left_count += counts[i - 1];
        if (left_count == 0 || left_count == count) continue;
        const double cost = left_count * half_area(box) + right_cost[static_cast<size_t>(i)];
        if (cost < best.cost || (cost == best.cost && imbalance(left_count) < imbalance(best.left_count))) {
            best = {cost, axis, i, left_count};
        }
    }
}

Split cheapest_split(std::span<const PrimRef> refs, const Binning& binning) {
    Bins bins;
    bins.fill(refs, binning);
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (binning.scale[axis] == 0.0f) continue;
        sweep_axis(bins, binning.bin_count, axis, static_cast<uint32_t>(refs.size()), best);
    }
    return best;
}

}  // namespace

Bvh2 BinnedSah::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    // Wald 2007, section 3.5.1: a small node needs few bins.
    const auto bins_for = [&](uint32_t count) { return std::min(bin_count, static_cast<int>(4 + count)); };
    const auto partition = [&](std::span<PrimRef> node_refs, const NodeBounds& bounds,
                               uint32_t depth) -> std::optional<uint32_t> {
        const auto count = static_cast<uint32_t>(node_refs.size());
        const bool fits_a_leaf = count <= static_cast<uint32_t>(max_leaf_size);
        if (!must_halve(depth, count)) {
            const Binning binning(bounds.half_centers, bins_for(count));
            const Split split = cheapest_split(node_refs, binning);
            const double area = bounds.box.half_area();
            const double split_cost =
                static_cast<double>(traversal_cost) * area + kIntersectionCost * split.cost;
            const double leaf_cost = kIntersectionCost * count * area;
            if (fits_a_leaf && leaf_cost <= split_cost) return std::nullopt;
            if (split.axis >= 0) {
                return partition_refs(
                    node_refs, [&](const PrimRef& ref) { return binning.bin(ref, split.axis) < split.bin; });
            }
        }
        if (fits_a_leaf) return std::nullopt;
        return count / 2;
    };
    return build_top_down(refs, partition, task);
}

}  // namespace boxwood
