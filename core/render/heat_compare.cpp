#include "core/render/heat_compare.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"
#include "core/render/film.h"

namespace boxwood {

namespace {

/// Calls visit(x, y) for each pixel whose row and column are multiples of `step`.
template <class Visit>
void for_each_pixel(const HeatCounts& picture, int step, const Visit& visit) {
    for (int y = 0; y < picture.height; y += step)
        for (int x = 0; x < picture.width; x += step) visit(x, y);
}

/// A picture whose squares of side `step` have the colours of color(x, y), sRGB.
template <class Color>
Image squares(const HeatCounts& picture, int step, const Color& color) {
    Image image(picture.width, picture.height);
    for_each_pixel(picture, step, [&](int x, int y) {
        uint8_t rgba[4];
        store_srgb(color(x, y), rgba);
        fill_square(image, x, y, step, rgba);
    });
    return image;
}

SignedScale signed_scale(std::vector<double>& sizes, const HeatCompareSettings& settings) {
    SignedScale scale;
    scale.logarithmic = settings.log_heat;
    scale.largest = *std::max_element(sizes.begin(), sizes.end());
    scale.most =
        settings.heat_max > 0.0 ? settings.heat_max : std::max(percentile(sizes, kUpperHeatShare), 1.0);
    return scale;
}

}  // namespace

int64_t heat_difference(const Count& a, const Count& b, Shading shading) {
    return static_cast<int64_t>(heat_count(a, shading)) - static_cast<int64_t>(heat_count(b, shading));
}

float SignedScale::position(double value) const {
    const double size = std::abs(value);
    const double share = logarithmic ? std::log1p(size) / std::log1p(most) : size / most;
    return static_cast<float>(std::copysign(std::min(share, 1.0), value));
}

double SignedScale::value(double position) const {
    const double share = std::min(std::abs(position), 1.0);
    return std::copysign(logarithmic ? std::expm1(share * std::log1p(most)) : share * most, position);
}

HeatComparison compare_heat(const HeatCounts& a, const HeatCounts& b, const HeatCompareSettings& settings) {
    BOXWOOD_ASSERT(a.step > 0 && b.step > 0 && a.width == b.width && a.height == b.height);
    const int step = std::max(a.step, b.step);
    HeatComparison result;
    result.settings = settings;
    std::vector<double> values, sizes;
    for_each_pixel(a, step, [&](int x, int y) {
        const Count &count_a = a.at(x, y), &count_b = b.at(x, y);
        const int64_t difference = heat_difference(count_a, count_b, settings.shading);
        for (const Count* count : {&count_a, &count_b})
            values.push_back(static_cast<double>(heat_count(*count, settings.shading)));
        sizes.push_back(std::abs(static_cast<double>(difference)));
        ++result.known;
        result.more_in_a += difference > 0 ? 1 : 0;
        result.more_in_b += difference < 0 ? 1 : 0;
    });
    result.scale = heat_scale_of(values, settings.log_heat, settings.heat_max);
    result.difference_scale = signed_scale(sizes, settings);
    for (size_t side = 0; side < 2; ++side) {
        const HeatCounts& picture = side == 0 ? a : b;
        result.images[side] = squares(picture, picture.step, [&](int x, int y) {
            const auto value = static_cast<double>(heat_count(picture.at(x, y), settings.shading));
            return map_srgb(settings.color_map, result.scale.scale.position(value));
        });
    }
    result.difference = squares(a, step, [&](int x, int y) {
        const auto value = static_cast<double>(heat_difference(a.at(x, y), b.at(x, y), settings.shading));
        return diverging_srgb(result.difference_scale.position(value), settings.dark_middle);
    });
    return result;
}

}  // namespace boxwood
