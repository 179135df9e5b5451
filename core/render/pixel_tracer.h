#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/render/trace_image.h"

namespace boxwood {

/// Some pixels of a picture on their way through one sample: entry i of each array belongs to pixels[i].
/// Kept between calls for its memory.
struct PixelBatch {
    std::vector<uint32_t> pixels;  ///< y * width + x
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<Count> counts;  ///< empty unless counted
    std::vector<Vec3> colors;   ///< linear RGB; empty for heat

    std::vector<Ray> ao_rays;
    std::vector<uint32_t> ao_owners;  ///< for each hemisphere ray the index of its pixel in `pixels`
    std::vector<uint8_t> occluded;    ///< for each hemisphere ray

    uint64_t ray_count() const { return rays.size() + ao_rays.size(); }
};

/// Casts and shades the samples of a picture; const, so all threads share one. Refers to the mesh.
class PixelTracer {
public:
    /// `bounds`: mesh.bounds().
    PixelTracer(const Mesh& mesh, const Box& bounds, Structure structure, const TraceSettings& settings);

    const TraceSettings& settings() const { return settings_; }

    /// Casts the primary rays of `sample` through batch.pixels: fills rays, hits, and counts if `counted`.
    /// False if task.stop was requested: the batch is then half filled.
    bool cast(uint32_t sample, PixelBatch& batch, bool counted, const Task& task) const;

    /// The hits alone of the same rays, which are written to `rays`. pixels.size() == hits.size(). False as
    /// above.
    bool find_hits(uint32_t sample, std::span<const uint32_t> pixels, std::vector<Ray>& rays,
                   std::span<Hit> hits, const Task& task) const;

    /// Fills batch.colors after cast; for `ao` casts the hemisphere rays. Does nothing for heat. False as
    /// above.
    bool shade(uint32_t sample, PixelBatch& batch, const Task& task) const;

private:
    void make_rays(uint32_t sample, std::span<const uint32_t> pixels, std::vector<Ray>& rays) const;
    bool shade_ao(uint32_t sample, PixelBatch& batch, const Task& task) const;
    double depth_in_scene(const Ray& ray, float t) const;
    Vec3 surface_color(const Ray& ray, const Hit& hit) const;

    const Mesh& mesh_;
    Structure structure_;
    TraceSettings settings_;
    CameraFrame frame_;
    CameraRaster raster_;
    Box bounds_;
    double diagonal_;  ///< of the box, in world units
};

}  // namespace boxwood
