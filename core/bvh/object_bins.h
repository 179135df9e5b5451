#pragma once

#include <cmath>

#include "core/bvh/spatial_bins.h"

namespace boxwood {

/// Boxes and counts of references by their centres: so many bins that the planes between them are nearly as
/// good as all those between two centres. Wald 2007, section 3.
class ObjectBins {
public:
    explicit ObjectBins(const Box4& half_centers);
    void add(const SplitRef& ref) {
        const Int4 bins = bins_of(ref);
        for (int axis = 0; axis < 3; ++axis) {
            boxes_[axis][bins[axis]].extend(load_lower(ref), load_upper(ref));
            ++counts_[axis][bins[axis]];
        }
    }
    /// Adds what other ones over the same box of centres hold.
    void add(const ObjectBins& other);
    /// Of all `count` references; the position is not set.
    SpatialSplit cheapest_split(uint32_t count) const;
    bool is_left(const SplitRef& ref, const SpatialSplit& split) const {
        return bins_of(ref)[split.axis] < split.bin;
    }

private:
    static constexpr int kBins = 128;

    Int4 bins_of(const SplitRef& ref) const {
        const Float4 center = half_center4(xyz(load_lower(ref)), load_upper(ref));
        return __builtin_convertvector((center - lower_) * scale_, Int4);
    }

    Float4 lower_, scale_{};
    Box4 boxes_[3][kBins];
    uint32_t counts_[3][kBins];
};

}  // namespace boxwood
