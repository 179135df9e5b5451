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

/// Pixels from (left, top) to before (right, bottom) in steps.
struct PixelArea {
    int left, top, right, bottom, step;

    /// Calls visit(area) for its squares of `side` traced pixels along a side, row by row; those at the right
    /// and at the bottom may be smaller.
    template <class Visit>
    void for_each_square(int side, Visit&& visit) const {
        const int size = side * step;
        for (int y = top; y < bottom; y += size)
            for (int x = left; x < right; x += size)
                visit(PixelArea{x, y, std::min(x + size, right), std::min(y + size, bottom), step});
    }
};

/// Calls visit(x, y) for every step-th pixel of a tile, which may stick out of the picture. Neighbours, which
/// are cast together, follow each other: blocks of 4 x 4 traced pixels, row by row, in blocks of 8 x 8.
template <class Visit>
void for_each_pixel(const TraceTile& tile, int tile_size, int step, int width, int height, Visit&& visit) {
    const PixelArea area{tile.x, tile.y, std::min(tile.x + tile_size, width),
                         std::min(tile.y + tile_size, height), step};
    area.for_each_square(8, [&](const PixelArea& eight) {
        eight.for_each_square(4, [&](const PixelArea& four) {
            four.for_each_square(1, [&](const PixelArea& pixel) { visit(pixel.left, pixel.top); });
        });
    });
}

/// The pass's pixels in that tile, y * width + x, in the order of for_each_pixel; replaces what is in
/// `pixels`.
void list_pixels(const TracePass& pass, const TraceTile& tile, int width, int height,
                 std::vector<uint32_t>& pixels);

}  // namespace boxwood
