#include "core/render/trace_schedule.h"

#include <algorithm>
#include <tuple>

namespace boxwood {

std::vector<TracePass> make_trace_passes(const TraceSettings& settings) {
    std::vector<TracePass> passes;
    // Tiles of about 200 rays at most: enough to pay for handing one out, few enough to share evenly.
    for (int step = kCoarsestStep; step >= 1; step /= 2)
        passes.push_back({.step = step, .tile_size = std::min(64, 16 * step)});
    if (settings.measure && !is_heat(settings.shading))
        passes.push_back({.step = kCountingStep, .counting = true, .tile_size = 64});
    for (int sample = 1; sample < sample_count(settings); ++sample)
        passes.push_back({.sample = static_cast<uint32_t>(sample)});
    return passes;
}

std::vector<TraceTile> tiles_from_middle(int width, int height, int tile_size) {
    std::vector<TraceTile> tiles;
    for (int y = 0; y < height; y += tile_size)
        for (int x = 0; x < width; x += tile_size) tiles.push_back({x, y});
    const auto order = [&](const TraceTile& tile) {
        const int64_t dx = 2 * tile.x + tile_size - width, dy = 2 * tile.y + tile_size - height;
        return std::tuple(dx * dx + dy * dy, tile.y, tile.x);
    };
    std::ranges::sort(tiles, {}, order);
    return tiles;
}

void list_pixels(const TracePass& pass, const TraceTile& tile, int width, int height,
                 std::vector<uint32_t>& pixels) {
    pixels.clear();
    const bool refines = !pass.counting && pass.sample == 0 && pass.step < kCoarsestStep;
    const int coarser = 2 * pass.step;
    for_each_pixel(tile, pass.tile_size, pass.step, width, height, [&](int x, int y) {
        if (refines && x % coarser == 0 && y % coarser == 0) return;
        pixels.push_back(static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x));
    });
}

}  // namespace boxwood
