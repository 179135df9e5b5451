#pragma once

#include <cstdint>

#include "core/render/image.h"

namespace boxwood {

/// How a picture differs from its reference. The difference of two pixels is that of the channel that differs
/// most, 0 to 255.
struct Comparison {
    bool same_size = false;          ///< if not, nothing else is filled in
    uint64_t different_pixels = 0;   ///< pixels whose difference is beyond the threshold
    int largest_difference = 0;      ///< of any pixel
    double largest_tile_mean = 0.0;  ///< largest mean difference of a 16 x 16 tile, 0 to 255
    int worst_tile_x = 0;            ///< top left pixel of that tile
    int worst_tile_y = 0;
    Image difference;  ///< the reference faintly in grey, what differs from dark red to bright yellow
};

/// `threshold`: a pixel that differs by more is counted.
Comparison compare_images(const Image& reference, const Image& result, int threshold = 3);

}  // namespace boxwood
