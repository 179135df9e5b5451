#include "core/kdtree/kd_median.h"

#include <algorithm>
#include <array>

namespace boxwood {

namespace {

/// Axes by descending extent, ties in axis order.
std::array<int, 3> axes_by_extent(const Box& box) {
    std::array<int, 3> axes{0, 1, 2};
    const DVec3 extent = box.extent();
    std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] > extent[b]; });
    return axes;
}

/// Halved first: no finite box overflows.
float middle_of(const Box& box, int axis) { return 0.5f * box.lower[axis] + 0.5f * box.upper[axis]; }

/// The middle piece's middle.
float median_of(std::span<const PrimRef> pieces, int axis) {
    std::vector<float> middles;
    middles.reserve(pieces.size());
    for (const PrimRef& piece : pieces) middles.push_back(middle_of(piece.bounds, axis));
    const auto median = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
    std::nth_element(middles.begin(), median, middles.end());
    return *median;
}

bool divides(const Box& cell, const KdSplit& split) {
    return cell.lower[split.axis] < split.plane && split.plane < cell.upper[split.axis];
}

/// Whether some reference is in one child alone.
bool separates(std::span<const PrimRef> pieces, const KdSplit& split) {
    return std::any_of(pieces.begin(), pieces.end(),
                       [&](const PrimRef& piece) { return side_of(piece.bounds, split) != KdSide::Both; });
}

}  // namespace

KdTree KdMedian::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    const bool of_references = middle == 1;
    const auto choose = [&](std::span<const PrimRef> pieces, const Box& cell) -> std::optional<KdSplit> {
        for (const int axis : axes_by_extent(cell)) {
            KdSplit split{axis, of_references ? median_of(pieces, axis) : middle_of(cell, axis)};
            if (!divides(cell, split)) split.plane = middle_of(cell, axis);
            if (divides(cell, split) && separates(pieces, split)) return split;
        }
        return std::nullopt;
    };
    const KdLimits limits{.clip = clip,
                          .leaf_size = static_cast<uint32_t>(leaf_size),
                          .max_depth = static_cast<uint32_t>(max_depth),
                          .budget = static_cast<uint32_t>(budget)};
    return build_kd_tree(mesh, refs, limits, choose, task);
}

}  // namespace boxwood
