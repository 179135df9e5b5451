#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/render/trace_image.h"

namespace boxwood {

/// What the rays through the pixel centres of a heat picture did: entries of pixels whose row and column are
/// multiples of `step` count, at y * width + x.
struct HeatCounts {
    int width = 0;
    int height = 0;
    int step = 0;  ///< 0: nothing is known
    std::vector<Count> counts;

    /// Of the pixel, or of the one that stands for it. x, y inside the picture, which is known.
    const Count& at(int x, int y) const {
        const int row = y - y % step, column = x - x % step;
        return counts[static_cast<size_t>(row) * static_cast<size_t>(width) + static_cast<size_t>(column)];
    }
};

/// Where signed values go on a diverging colour map: 0 in its middle.
struct SignedScale {
    double most = 1.0;         ///< value of the last colour, above 0; -most of the first one
    bool logarithmic = false;  ///< by log(1 + |value|)
    double largest = 0.0;      ///< largest size of a value in the picture, which may be beyond the scale

    /// In [-1, 1]; 0 of 0 alone.
    float position(double value) const;
    /// The inverse; position in [-1, 1].
    double value(double position) const;
    bool operator==(const SignedScale&) const = default;
};

/// How two heat pictures of one size are coloured.
struct HeatCompareSettings {
    Shading shading = Shading::Heat;
    ColorMap color_map = ColorMap::Viridis;
    bool log_heat = false;
    double heat_max = 0.0;    ///< upper end of both scales; 0: from the pictures
    bool dark_middle = true;  ///< of the difference's colours

    bool operator==(const HeatCompareSettings&) const = default;
};

/// Two heat pictures on one scale, and where they differ. A pixel's difference is A's count - B's.
struct HeatComparison {
    HeatCompareSettings settings;
    std::array<Image, 2> images;
    HeatScale scale;
    Image difference;
    SignedScale difference_scale;
    uint64_t more_in_a = 0, more_in_b = 0;  ///< pixels, of those known in both
    uint64_t known = 0;
};

/// a and b are known and of the same size. The coarser of both decides which pixels count. One scale from
/// the values of both: its upper end, and that of the difference, is the 99.5th percentile where heat_max
/// is 0.
HeatComparison compare_heat(const HeatCounts& a, const HeatCounts& b, const HeatCompareSettings& settings);

/// count of A - count of B.
int64_t heat_difference(const Count& a, const Count& b, Shading shading);

}  // namespace boxwood
