#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/render/trace_image.h"

namespace boxwood {

/// What a ProgressiveTracer has done since its last start.
struct TraceState {
    bool running = false;    ///< worker threads have work
    bool converged = false;  ///< the picture is final; no work is left
    int step = 0;            ///< every step-th pixel of row and column is traced; 1: all; 0: no picture
    int samples = 0;         ///< whole samples per pixel; 0 while step > 1
    int sample_count = 0;    ///< samples per pixel in the end
    double progress = 0.0;   ///< share of the final picture's samples that are traced, 0 to 1
    uint64_t ray_count = 0;  ///< rays traced for the picture: no ray is traced twice
    double ms = 0.0;         ///< working time since the start
    double rays_per_second = 0.0;
    Count counters;             ///< sums over `counted_rays` primary rays: heat, or with settings.measure
    uint64_t counted_rays = 0;  ///< 0: not counted (yet)
    HeatScale heat;             ///< scale of the picture as it is shown
};

/// What the ray through a pixel's centre found.
struct PixelValue {
    Hit hit;
    Count count;  ///< heat: what that ray did; otherwise zero
};

/// Traces a picture in the background: a coarse one at once, then finer, then more samples, until it equals
/// trace_image's, bit for bit; then its threads sleep. Called from one thread.
class ProgressiveTracer {
public:
    /// `thread_count` workers; 0: one for each core.
    explicit ProgressiveTracer(int thread_count = 0);
    ~ProgressiveTracer();
    ProgressiveTracer(const ProgressiveTracer&) = delete;
    ProgressiveTracer& operator=(const ProgressiveTracer&) = delete;

    /// Stops what is under way and begins the picture that `settings` ask for. The old picture stays in
    /// snapshot() until the coarse one is whole.
    void start(std::shared_ptr<const Scene> scene, Structure structure, const TraceSettings& settings);

    /// Returns when the last worker is idle: each looks for a stop several times in a millisecond, also
    /// within a ray of brute force. What was traced stays.
    void stop();

    /// Returns when the picture has converged (true), or after `milliseconds` (false). Without a start: true.
    bool wait(double milliseconds) const;

    /// Copies the latest picture if it is newer than `version`, and sets `version` to its number. False, with
    /// nothing touched, if there is nothing newer. Numbers rise through restarts; begin with 0.
    bool snapshot(Image& image, uint64_t& version) const;

    /// Copies of a heat picture the counts of the rays through the pixel centres, of the pixels whose row and
    /// column are multiples of the state's `step`, at y * width + x; what stands between is not defined.
    /// Returns that step; 0, with nothing touched, if there is no picture or it is no heat.
    int snapshot_counts(std::vector<Count>& counts) const;

    TraceState state() const;

    /// What was found at pixel (x, y), or at the traced pixel that fills it; nothing if it is outside the
    /// picture or no coarse picture is there yet.
    std::optional<PixelValue> picked(int x, int y) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood
