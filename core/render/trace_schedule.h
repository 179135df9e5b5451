#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/render/trace_image.h"

namespace boxwood {

/// One pass of a progressive picture over all its tiles.
struct TracePass {
    int step = 1;           ///< every step-th pixel of row and column, but those of a coarser pass
    uint32_t sample = 0;    ///< sample of each pixel
    bool counting = false;  ///< counts nodes and tests of some pixels' rays; adds nothing to the picture
    int tile_size = 16;     ///< in pixels, a multiple of step
};

/// The coarsest pass: at once even for a structure that takes milliseconds for a ray.
inline constexpr int kCoarsestStep = 64;
/// A coarser picture is not worth showing if this one comes in time.
inline constexpr int kGoodStep = 8;
/// Step of the counting pass.
inline constexpr int kCountingStep = 8;

/// Sample 0 from coarse to fine, then the counting pass if asked for, then the other samples. Every sample of
/// every pixel is in exactly one pass.
std::vector<TracePass> make_trace_passes(const TraceSettings& settings);

/// Top left pixel of a tile.
struct TraceTile {
    int x, y;
};

/// Tiles that cover the picture, from its middle outwards.
std::vector<TraceTile> tiles_from_middle(int width, int height, int tile_size);

/// Neighbours that are cast together stand in blocks of so many traced pixels along a side.
inline constexpr int kBlock = 4;

/// Calls visit(x, y) for every step-th pixel of a tile, block by block, in each row by row. The tile may
/// stick out of the picture.
template <class Visit>
void for_each_pixel(const TraceTile& tile, int tile_size, int step, int width, int height, Visit&& visit) {
    const int side = kBlock * step;
    const int right = std::min(tile.x + tile_size, width), bottom = std::min(tile.y + tile_size, height);
    for (int top = tile.y; top < bottom; top += side)
        for (int left = tile.x; left < right; left += side)
            for (int y = top; y < std::min(top + side, bottom); y += step)
                for (int x = left; x < std::min(left + side, right); x += step) visit(x, y);
}

/// The pass's pixels in that tile, y * width + x, in the order of for_each_pixel; replaces what is in
/// `pixels`.
void list_pixels(const TracePass& pass, const TraceTile& tile, int width, int height,
                 std::vector<uint32_t>& pixels);

}  // namespace boxwood
