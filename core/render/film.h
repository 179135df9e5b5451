#pragma once

#include <cstdint>
#include <vector>

#include "core/render/pixel_tracer.h"

namespace boxwood {

/// What the samples of a picture sum up to, pixel by pixel, row-major, row 0 on top. Samples are added in
/// their order, so that the sums have the same bits whoever adds them.
struct Film {
    int width = 0;
    int height = 0;
    std::vector<Vec3> color_sums;     ///< linear RGB; empty for heat
    std::vector<Count> counts;        ///< heat: sums over the samples
    std::vector<Hit> first_hits;      ///< of sample 0
    std::vector<Count> first_counts;  ///< heat: of sample 0

    /// Makes room; what the pixels hold is not defined until their sample 0 is added.
    void resize(const TraceSettings& settings);
    /// Adds a traced batch; sample 0 replaces what was there.
    void add(const PixelBatch& batch, uint32_t sample);
};

/// Of one pixel the value that a heat shading shows: mean count over `samples` samples.
double heat_value(const Film& film, Shading shading, size_t pixel, uint32_t samples);

/// The scale of a picture with these values, of which there is one at least; reorders them.
HeatScale heat_scale_of(std::vector<double>& values, bool logarithmic, double heat_max);

/// The value that `share` of all values are not above. Reorders them; there is one at least.
double percentile(std::vector<double>& values, double share);

/// The map ends at this percentile; the costliest pixels beyond it share the last colour.
inline constexpr double kUpperHeatShare = 0.995;

/// The scale for the pixels whose row and column are multiples of `step`, each with `samples` samples.
HeatScale make_heat_scale(const Film& film, const TraceSettings& settings, int step, uint32_t samples);

/// The pixel's colour after `samples` samples; `scale` is for heat.
void resolve_pixel(const Film& film, const TraceSettings& settings, const ValueScale& scale, size_t pixel,
                   uint32_t samples, uint8_t* rgba);

/// The whole picture from the pixels whose row and column are multiples of `step`: each fills a square.
/// False, with the picture half written, if task.stop was requested.
bool resolve_image(const Film& film, const TraceSettings& settings, const ValueScale& scale, int step,
                   uint32_t samples, Image& image, const Task& task);

/// Copies a pixel into the square of side `step` whose top left corner it is, cut at the picture's border.
void fill_square(Image& image, int x, int y, int step, const uint8_t* rgba);

}  // namespace boxwood
