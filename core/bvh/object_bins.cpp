#include "core/bvh/object_bins.h"

namespace boxwood {

ObjectBins::ObjectBins(const Box4& half_centers) : lower_(half_centers.lower) {
    for (int axis = 0; axis < 3; ++axis) {
        // k1 = bins (1 - epsilon) / extent; an extent without a finite inverse is none. Rounded twice, so the
        // last bin is reached and not exceeded.
        const float extent = half_centers.upper[axis] - lower_[axis];
        const float k1 = static_cast<float>(kBins) * 0.99999f / extent;
        scale_[axis] = std::isfinite(k1) ? k1 : 0.0f;
        std::fill_n(boxes_[axis], kBins, empty_box4());
        std::fill_n(counts_[axis], kBins, 0u);
    }
    lower_ = xyz(lower_);
}

void ObjectBins::add(const ObjectBins& other) {
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < kBins; ++i) {
            boxes_[axis][i].extend(other.boxes_[axis][i].lower, other.boxes_[axis][i].upper);
            counts_[axis][i] += other.counts_[axis][i];
        }
}

SpatialSplit ObjectBins::cheapest_split(uint32_t count) const {
    SpatialSplit best;
    for (int axis = 0; axis < 3; ++axis) {
        if (scale_[axis] == 0.0f) continue;
        Box4 right[kBins];
        Box4 box = empty_box4();
        for (int i = kBins - 1; i > 0; --i) {
            box.extend(boxes_[axis][i].lower, boxes_[axis][i].upper);
            right[i] = box;
        }
        box = empty_box4();
        uint32_t left_count = 0;
        for (int i = 1; i < kBins; ++i) {
            box.extend(boxes_[axis][i - 1].lower, boxes_[axis][i - 1].upper);
            left_count += counts_[axis][i - 1];
            const uint32_t right_count = count - left_count;
            if (left_count == 0 || right_count == 0) continue;
            const double cost = left_count * half_area(box) + right_count * half_area(right[i]);
            if (cost < best.cost) best = {cost, axis, i, 0.0f, left_count, right_count, box, right[i]};
        }
    }
    return best;
}

}  // namespace boxwood
