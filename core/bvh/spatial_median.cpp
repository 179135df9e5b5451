#include "core/bvh/spatial_median.h"

#include <array>

#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

/// Axes by descending extent, ties in axis order.
std::array<int, 3> axes_by_extent(const Box& box) {
    std::array<int, 3> axes{0, 1, 2};
    const DVec3 extent = box.extent();
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] > extent[b]; });
    return axes;
}

/// How many references go left of the middle of `box` on the first of its axes where both sides get some;
/// nothing if no axis does, or none of the `attempts` that are left, which this counts down.
std::optional<uint32_t> split_in_the_middle(std::span<PrimRef> refs, const Box& box, int& attempts) {
    for (const int axis : axes_by_extent(box)) {
        if (attempts-- <= 0) return std::nullopt;
        const double middle = static_cast<double>(box.lower[axis]) + static_cast<double>(box.upper[axis]);
        const auto is_left = [&](const PrimRef& ref) {
            return static_cast<double>(ref.bounds.lower[axis]) + static_cast<double>(ref.bounds.upper[axis]) <
                   middle;
        };
        const uint32_t left_count = partition_refs(refs, is_left);
        if (left_count != 0 && left_count != refs.size()) return left_count;
    }
    return std::nullopt;
}

}  // namespace

Bvh2 SpatialMedian::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    const auto partition = [&](std::span<PrimRef> node_refs, const NodeBounds& bounds,
                               uint32_t depth) -> std::optional<uint32_t> {
        const auto count = static_cast<uint32_t>(node_refs.size());
        if (count <= static_cast<uint32_t>(max_leaf_size)) return std::nullopt;
        if (must_halve(depth, count)) return count / 2;
        int left_attempts = attempts;
        if (!of_centers) {
            if (const auto left_count = split_in_the_middle(node_refs, bounds.box, left_attempts))
                return left_count;
        }
        const Box centers{2.0f * bounds.half_centers.lower, 2.0f * bounds.half_centers.upper};
        if (const auto left_count = split_in_the_middle(node_refs, centers, left_attempts)) return left_count;
        return count / 2;
    };
    return build_top_down(refs, partition, task);
}

}  // namespace boxwood
