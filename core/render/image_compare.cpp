#include "core/render/image_compare.h"

#include <algorithm>
#include <cstdlib>

namespace boxwood {

namespace {

constexpr int kComparedTile = 16;

int pixel_difference(const uint8_t* a, const uint8_t* b) {
    int largest = 0;
    for (int channel = 0; channel < 4; ++channel)
        largest = std::max(largest, std::abs(int{a[channel]} - int{b[channel]}));
    return largest;
}

/// Equal pixels: the reference in faint grey. Others: red that rises with the difference, from yellow on
/// where it is counted, so that a difference of 1 is seen too.
void paint_difference(const uint8_t* reference, int difference, bool counted, uint8_t* out) {
    const int grey = (int{reference[0]} * 2 + int{reference[1]} * 5 + int{reference[2]}) / 8;
    const int faint = 16 + grey / 5;
    const int strength = std::min(255, 96 + difference * 8);
    out[0] = static_cast<uint8_t>(difference > 0 ? strength : faint);
    out[1] =
        static_cast<uint8_t>(counted ? std::min(255, 64 + difference * 4) : (difference > 0 ? 0 : faint));
    out[2] = static_cast<uint8_t>(difference > 0 ? 0 : faint);
    out[3] = 255;
}

}  // namespace

Comparison compare_images(const Image& reference, const Image& result, int threshold) {
    Comparison comparison;
    comparison.same_size = reference.width == result.width && reference.height == result.height;
    if (!comparison.same_size) return comparison;
    comparison.difference = Image(reference.width, reference.height);
    for (int tile_y = 0; tile_y < reference.height; tile_y += kComparedTile) {
        for (int tile_x = 0; tile_x < reference.width; tile_x += kComparedTile) {
            const int end_x = std::min(tile_x + kComparedTile, reference.width);
            const int end_y = std::min(tile_y + kComparedTile, reference.height);
            int64_t sum = 0;
            for (int y = tile_y; y < end_y; ++y) {
                for (int x = tile_x; x < end_x; ++x) {
                    const int difference = pixel_difference(reference.pixel(x, y), result.pixel(x, y));
                    sum += difference;
                    comparison.largest_difference = std::max(comparison.largest_difference, difference);
                    comparison.different_pixels += difference > threshold ? 1 : 0;
                    paint_difference(reference.pixel(x, y), difference, difference > threshold,
                                     comparison.difference.pixel(x, y));
                }
            }
            const double mean = static_cast<double>(sum) / ((end_x - tile_x) * (end_y - tile_y));
            if (mean > comparison.largest_tile_mean) {
                comparison.largest_tile_mean = mean;
                comparison.worst_tile_x = tile_x;
                comparison.worst_tile_y = tile_y;
            }
        }
    }
    return comparison;
}

}  // namespace boxwood
