#include "core/render/film.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace boxwood {

namespace {

/// A logarithmic scale begins here.
constexpr double kLowerShare = 0.005;

}  // namespace

double percentile(std::vector<double>& values, double share) {
    const size_t last = values.size() - 1;
    const size_t rank = static_cast<size_t>(share * static_cast<double>(last));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

void Film::resize(const TraceSettings& settings) {
    width = settings.width;
    height = settings.height;
    const size_t count = static_cast<size_t>(width) * static_cast<size_t>(height);
    color_sums.resize(is_heat(settings.shading) ? 0 : count);
    counts.resize(is_heat(settings.shading) ? count : 0);
    first_hits.resize(count);
    first_counts.resize(counts.size());
}

void Film::add(const PixelBatch& batch, uint32_t sample) {
    for (size_t i = 0; i < batch.pixels.size(); ++i) {
        const uint32_t pixel = batch.pixels[i];
        if (sample == 0) first_hits[pixel] = batch.hits[i];
        if (!color_sums.empty()) {
            color_sums[pixel] = sample == 0 ? batch.colors[i] : color_sums[pixel] + batch.colors[i];
        } else {
            if (sample == 0) {
                first_counts[pixel] = counts[pixel] = batch.counts[i];
            } else {
                counts[pixel] += batch.counts[i];
            }
        }
    }
}

double heat_value(const Film& film, Shading shading, size_t pixel, uint32_t samples) {
    return static_cast<double>(heat_count(film.counts[pixel], shading)) / samples;
}

HeatScale heat_scale_of(std::vector<double>& values, bool logarithmic, double heat_max) {
    HeatScale heat;
    heat.largest = *std::max_element(values.begin(), values.end());
    heat.scale.logarithmic = logarithmic;
    heat.scale.lower = logarithmic ? 1.0 : 0.0;
    heat.scale.upper = heat_max;
    if (heat_max <= 0.0) {
        heat.scale.upper = std::max(percentile(values, kUpperHeatShare), heat.scale.lower + 1.0);
        if (logarithmic)
            heat.scale.lower = std::clamp(percentile(values, kLowerShare), 1.0, heat.scale.upper * 0.5);
    }
    return heat;
}

HeatScale make_heat_scale(const Film& film, const TraceSettings& settings, int step, uint32_t samples) {
    std::vector<double> values;
    for (int y = 0; y < film.height; y += step) {
        for (int x = 0; x < film.width; x += step) {
            const size_t pixel =
                static_cast<size_t>(y) * static_cast<size_t>(film.width) + static_cast<size_t>(x);
            values.push_back(heat_value(film, settings.shading, pixel, samples));
        }
    }
    return heat_scale_of(values, settings.log_heat, settings.heat_max);
}

void resolve_pixel(const Film& film, const TraceSettings& settings, const ValueScale& scale, size_t pixel,
                   uint32_t samples, uint8_t* rgba) {
    if (!is_heat(settings.shading)) {
        store_linear(film.color_sums[pixel] / static_cast<float>(samples), rgba);
        return;
    }
    const double value = heat_value(film, settings.shading, pixel, samples);
    store_srgb(map_srgb(settings.color_map, scale.position(value)), rgba);
}

bool resolve_image(const Film& film, const TraceSettings& settings, const ValueScale& scale, int step,
                   uint32_t samples, Image& image, const Task& task) {
    if (image.width != film.width || image.height != film.height) image = Image(film.width, film.height);
    for (int y = 0; y < film.height; y += step) {
        if (task.stopped()) return false;
        for (int x = 0; x < film.width; x += step) {
            const size_t pixel =
                static_cast<size_t>(y) * static_cast<size_t>(film.width) + static_cast<size_t>(x);
            uint8_t rgba[4];
            resolve_pixel(film, settings, scale, pixel, samples, rgba);
            fill_square(image, x, y, step, rgba);
        }
    }
    return true;
}

void fill_square(Image& image, int x, int y, int step, const uint8_t* rgba) {
    const int end_x = std::min(x + step, image.width), end_y = std::min(y + step, image.height);
    for (int row = y; row < end_y; ++row)
        for (int column = x; column < end_x; ++column) std::memcpy(image.pixel(column, row), rgba, 4);
}

}  // namespace boxwood
