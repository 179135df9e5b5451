#include "core/render/trace_image.h"

#include <algorithm>
#include <functional>
#include <mutex>

#include "core/base/assert.h"
#include "core/base/parallel.h"
#include "core/base/timer.h"
#include "core/render/film.h"
#include "core/render/trace_schedule.h"

namespace boxwood {

namespace {

constexpr int kTileSize = 16;

/// Calls body(batch) on all threads, with batch.pixels set to the pixels of one tile after the other.
void for_each_tile(int width, int height, const std::function<void(PixelBatch&)>& body) {
    const int columns = (width + kTileSize - 1) / kTileSize, rows = (height + kTileSize - 1) / kTileSize;
    const size_t tile_count = static_cast<size_t>(columns) * static_cast<size_t>(rows);
    parallel_for(tile_count, 8, [&](size_t begin, size_t end) {
        PixelBatch batch;
        for (size_t tile = begin; tile < end; ++tile) {
            const TraceTile corner{static_cast<int>(tile) % columns * kTileSize,
                                   static_cast<int>(tile) / columns * kTileSize};
            batch.pixels.clear();
            for_each_pixel(corner, kTileSize, 1, width, height, [&](int x, int y) {
                batch.pixels.push_back(static_cast<uint32_t>(y) * static_cast<uint32_t>(width) +
                                       static_cast<uint32_t>(x));
            });
            body(batch);
        }
    });
}

/// Sums of several threads.
struct Totals {
    std::mutex mutex;
    uint64_t ray_count = 0;
    Count counters;

    void add(uint64_t rays, const PixelBatch& batch) {
        Count sum;
        for (const Count& count : batch.counts) sum += count;
        const std::scoped_lock lock(mutex);
        ray_count += rays;
        counters += sum;
    }
};

/// Casts the primary rays of the samples again for what the first pass did not do: their time or counters.
void measure_apart(const PixelTracer& tracer, TraceResult& result, Task& task) {
    const TraceSettings& settings = tracer.settings();
    const bool counted = !is_heat(settings.shading);
    const uint32_t samples = counted ? 1 : static_cast<uint32_t>(sample_count(settings));
    Totals totals;
    const Timer timer;
    for_each_tile(settings.width, settings.height, [&](PixelBatch& batch) {
        for (uint32_t sample = 0; sample < samples && tracer.cast(sample, batch, counted, task); ++sample)
            totals.add(batch.ray_count(), batch);
    });
    if (counted) {
        result.counters = totals.counters;
        result.counted_rays = totals.ray_count;
    } else {
        result.ms = timer.milliseconds();
    }
}

}  // namespace

std::optional<Shading> find_shading(const std::string& name) {
    for (size_t i = 0; i < kShadingNames.size(); ++i)
        if (name == kShadingNames[i]) return static_cast<Shading>(i);
    return std::nullopt;
}

int default_spp(Shading shading) {
    if (is_heat(shading)) return 1;
    return shading == Shading::Ao ? 16 : 4;
}

int sample_count(const TraceSettings& settings) {
    return settings.spp > 0 ? settings.spp : default_spp(settings.shading);
}

TraceResult trace_image(const Scene& scene, const Structure& structure, const TraceSettings& settings,
                        Task& task) {
    BOXWOOD_ASSERT(settings.width > 0 && settings.height > 0 && settings.ao_rays > 0);
    const PixelTracer tracer(scene.mesh, scene.mesh.bounds(), structure, settings);
    const bool heat = is_heat(settings.shading);
    const uint32_t samples = static_cast<uint32_t>(sample_count(settings));
    Film film;
    film.resize(settings);
    task.total = film.first_hits.size();
    task.done = 0;

    Totals totals;
    const Timer timer;
    for_each_tile(settings.width, settings.height, [&](PixelBatch& batch) {
        for (uint32_t sample = 0; sample < samples; ++sample) {
            if (!tracer.cast(sample, batch, heat, task) || !tracer.shade(sample, batch, task)) return;
            film.add(batch, sample);
            totals.add(batch.ray_count(), batch);
        }
        task.done += batch.pixels.size();
    });

    TraceResult result;
    if (!heat) result.ms = timer.milliseconds();
    result.ray_count = totals.ray_count;
    result.counters = totals.counters;
    result.counted_rays = heat ? totals.ray_count : 0;
    if (settings.measure) measure_apart(tracer, result, task);
    result.stopped = task.stopped();
    if (result.stopped) return result;
    if (heat) result.heat = make_heat_scale(film, settings, 1, samples);
    resolve_image(film, settings, result.heat.scale, 1, samples, result.image, task);
    return result;
}

}  // namespace boxwood
