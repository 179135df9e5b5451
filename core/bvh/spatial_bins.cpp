#include "core/bvh/spatial_bins.h"

#include <cmath>

#include "core/base/assert.h"
#include "core/refs/clip_polygon.h"

namespace boxwood {

namespace {

/// Box of the points in which a triangle meets a plane, in float; empty if it does not.
Box4 cross_section(const std::array<Float4, 3>& corners, int axis, float plane) {
    Box4 box = empty_box4();
    for (size_t i = 0; i < 3; ++i) {
        const Float4 a = corners[i], b = corners[i == 2 ? 0 : i + 1];
        const float at_a = a[axis], at_b = b[axis];
        if ((at_a < plane) == (at_b < plane)) continue;
        const float f = (plane - at_a) / (at_b - at_a);
        const Float4 point = a + splat(f) * (b - a);
        box.extend(point, point);
    }
    return box;
}

}  // namespace

SpatialBins::SpatialBins(const Box4& bounds, int bin_count) : bin_count_(bin_count) {
    const double bins = bin_count;
    half_lower_ = splat(0.5f) * bounds.lower;
    for (int axis = 0; axis < 3; ++axis) {
        // Half an extent, so that it does not overflow; one without a finite inverse is none.
        const float half_extent = 0.5f * bounds.upper[axis] - half_lower_[axis];
        const float scale = static_cast<float>(bins) / half_extent;
        scale_[axis] = std::isfinite(scale) ? scale : 0.0f;
        const double lower = static_cast<double>(bounds.lower[axis]);
        const double width = (static_cast<double>(bounds.upper[axis]) - lower) / bins;
        auto& planes = planes_[static_cast<size_t>(axis)];
        for (int i = 0; i <= bin_count; ++i)
            planes[static_cast<size_t>(i)] = static_cast<float>(lower + width * i);
    }
    scale_[3] = 0.0f;
    for (size_t axis = 0; axis < 3; ++axis) {
        std::fill_n(boxes_[axis].begin(), bin_count, empty_box4());
        std::fill_n(begins_[axis].begin(), bin_count, 0u);
        std::fill_n(ends_[axis].begin(), bin_count, 0u);
    }
}

Int4 SpatialBins::bins_of(Float4 point) const {
    const Int4 bins = __builtin_convertvector((splat(0.5f) * point - half_lower_) * scale_, Int4);
    const Int4 last = {bin_count_ - 1, bin_count_ - 1, bin_count_ - 1, bin_count_ - 1};
    return bins < last ? bins : last;
}

SpatialBins::Range SpatialBins::without_touched(Range range, const SplitRef& ref, int axis) const {
    const auto& planes = planes_[static_cast<size_t>(axis)];
    const float lower = ref.lower[axis], upper = ref.upper[axis];
    while (range.first < range.last && lower >= planes[static_cast<size_t>(range.first) + 1]) ++range.first;
    while (range.first < range.last && upper <= planes[static_cast<size_t>(range.last)]) --range.last;
    return range;
}

SpatialBins::Range SpatialBins::range_of(const SplitRef& ref, int axis) const {
    const Range range = {bins_of(xyz(load_lower(ref)))[axis], bins_of(load_upper(ref))[axis]};
    return without_touched(range, ref, axis);
}

void SpatialBins::add(const SplitRef& ref, const Mesh& mesh) {
    const Box4 whole = {xyz(load_lower(ref)), load_upper(ref)};
    const Int4 first = bins_of(whole.lower), last = bins_of(whole.upper);
    for (int axis = 0; axis < 3; ++axis) {
        Range range = {first[axis], last[axis]};
        if (range.first != range.last) range = without_touched(range, ref, axis);
        const auto a = static_cast<size_t>(axis);
        const auto begin = static_cast<size_t>(range.first), end = static_cast<size_t>(range.last);
        ++begins_[a][begin];
        ++ends_[a][end];
        if (begin == end) {
            boxes_[a][begin].extend(whole.lower, whole.upper);
        } else if (end == begin + 1) {
            // Small in comparison with the node: its box is cut, not the triangle.
            const float plane = planes_[a][end];
            boxes_[a][begin].extend(whole.lower, with_lane(whole.upper, axis, plane));
            boxes_[a][end].extend(with_lane(whole.lower, axis, plane), whole.upper);
        } else {
            add_parts(ref, mesh, axis, range);
        }
    }
}

void SpatialBins::add_parts(const SplitRef& ref, const Mesh& mesh, int axis, Range range) {
    const Triangle triangle = mesh.triangle(ref.prim);
    const std::array<Float4, 3> corners = {make4(triangle.a), make4(triangle.b), make4(triangle.c)};
    const auto& planes = planes_[static_cast<size_t>(axis)];
    const Box4 whole = {load_lower(ref), load_upper(ref)};
    Box4 entry = empty_box4();
    for (int i = range.first; i <= range.last; ++i) {
        const float begin = planes[static_cast<size_t>(i)], end = planes[static_cast<size_t>(i) + 1];
        const bool is_first = i == range.first, is_last = i == range.last;
        const Box4 exit = is_last ? empty_box4() : cross_section(corners, axis, end);
        Box4 part = {min4(entry.lower, exit.lower), max4(entry.upper, exit.upper)};
        for (const Float4& corner : corners)
            if ((is_first || corner[axis] >= begin) && (is_last || corner[axis] <= end))
                part.extend(corner, corner);
        // Inside the reference's box and the slab. Where float overflowed, NaN gives way to them; a part that
        // rounding left empty becomes all of the slab.
        const Float4 slab_lower = is_first ? whole.lower : with_lane(whole.lower, axis, begin);
        const Float4 slab_upper = is_last ? whole.upper : with_lane(whole.upper, axis, end);
        const Float4 a = min4(max4(part.lower, slab_lower), slab_upper);
        const Float4 b = max4(min4(part.upper, slab_upper), slab_lower);
        boxes_[static_cast<size_t>(axis)][static_cast<size_t>(i)].extend(min4(a, b), max4(a, b));
        entry = exit;
    }
}

void SpatialBins::add(const SpatialBins& other) {
    for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < static_cast<size_t>(bin_count_); ++i) {
            boxes_[axis][i].extend(other.boxes_[axis][i].lower, other.boxes_[axis][i].upper);
            begins_[axis][i] += other.begins_[axis][i];
            ends_[axis][i] += other.ends_[axis][i];
        }
}

void SpatialBins::sweep(int axis, SpatialSplit& best) const {
    const auto& boxes = boxes_[static_cast<size_t>(axis)];
    const auto& begins = begins_[static_cast<size_t>(axis)];
    const auto& ends = ends_[static_cast<size_t>(axis)];
    std::array<Box4, kMostBins> right_boxes;
    std::array<uint32_t, kMostBins> right_counts;
    Box4 box = empty_box4();
    uint32_t count = 0;
    for (auto i = static_cast<size_t>(bin_count_) - 1; i > 0; --i) {
        box.extend(boxes[i].lower, boxes[i].upper);
        count += ends[i];
        right_boxes[i] = box;
        right_counts[i] = count;
    }
    box = empty_box4();
    count = 0;
    for (size_t i = 1; i < static_cast<size_t>(bin_count_); ++i) {
        box.extend(boxes[i - 1].lower, boxes[i - 1].upper);
        count += begins[i - 1];
        if (count == 0 || right_counts[i] == 0) continue;
        const double cost = count * half_area(box) + right_counts[i] * half_area(right_boxes[i]);
        if (cost < best.cost)
            best = {cost,
                    axis,
                    static_cast<int>(i),
                    planes_[static_cast<size_t>(axis)][i],
                    count,
                    right_counts[i],
                    box,
                    right_boxes[i]};
    }
}

SpatialSplit SpatialBins::cheapest_split() const {
    SpatialSplit best;
    for (int axis = 0; axis < 3; ++axis)
        if (scale_[axis] > 0.0f) sweep(axis, best);
    return best;
}

SpatialCutter::SpatialCutter(const Mesh& mesh, const SpatialSplit& split)
    : mesh_(mesh),
      split_(split),
      left_area_(half_area(split.left_box)),
      right_area_(half_area(split.right_box)) {}

SpatialCutter::Parts SpatialCutter::cut(const SplitRef& ref) {
    Box4 all_left = split_.left_box, all_right = split_.right_box;
    all_left.extend(load_lower(ref), load_upper(ref));
    all_right.extend(load_lower(ref), load_upper(ref));
    // Stich et al. 2009, C_split, C_1 and C_2.
    const double left_count = split_.left_count, right_count = split_.right_count;
    const double cut_cost = left_area_ * left_count + right_area_ * right_count;
    const double left_cost = half_area(all_left) * left_count + right_area_ * (right_count - 1.0);
    const double right_cost = left_area_ * (left_count - 1.0) + half_area(all_right) * right_count;
    Parts parts;
    if (left_cost <= right_cost && left_cost < cut_cost && split_.right_count > 1) {
        parts.has_left = true;
        parts.left = ref;
    } else if (right_cost < cut_cost && split_.left_count > 1) {
        parts.has_right = true;
        parts.right = ref;
    } else {
        const Triangle triangle = mesh_.triangle(ref.prim);
        Box left = ref.bounds(), right = ref.bounds();
        left.upper[split_.axis] = split_.position;
        right.lower[split_.axis] = split_.position;
        left = clip_bounds(triangle, left);
        right = clip_bounds(triangle, right);
        parts.has_left = !left.is_empty();
        parts.has_right = !right.is_empty();
        parts.left = {left.lower, ref.prim, left.upper};
        parts.right = {right.lower, ref.prim, right.upper};
        if (!parts.has_left && split_.left_count > 1) --split_.left_count;
        if (!parts.has_right && split_.right_count > 1) --split_.right_count;
        return parts;
    }
    if (parts.has_left) {
        --split_.right_count;
        split_.left_box = all_left;
        left_area_ = half_area(all_left);
    } else {
        --split_.left_count;
        split_.right_box = all_right;
        right_area_ = half_area(all_right);
    }
    return parts;
}

}  // namespace boxwood
