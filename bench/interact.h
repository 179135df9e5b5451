#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/catalog/pipeline.h"
#include "core/render/trace_image.h"

namespace boxwood::bench {

/// Wall-clock times of the same thing done again and again, in milliseconds.
struct Times {
    std::vector<double> ms;

    /// The time that the share `p` of all does not exceed, 0 < p <= 1: 0.5 the median, 1 the worst. 0 for
    /// none.
    double percentile(double p) const;
};

/// What happens to a finished build before its boxes can be drawn, such as the upload.
using ShowBoxes = std::function<void(const Built&)>;

/// What a step of the slider finds ready.
enum class Memory : uint8_t {
    Shared,  ///< one cache: a step whose references an earlier one had too finds its structure there
    None,    ///< an empty cache: each step runs every stage
};

/// Steps of the slider of t: `evh(t=T) > BUILDER` for T = first_t, first_t + 1, ... From each step to the end
/// of `show`. Throws Error (WrongUsage) for a builder that is none.
Times time_slider_steps(std::shared_ptr<const Scene> scene, const std::string& builder, int first_t,
                        int step_count, Memory memory, const ShowBoxes& show, Task& task);

/// Stops of the progressive tracer at moments spread over its first 50 ms: from the call of stop() until the
/// last worker is idle.
Times time_tracer_stops(std::shared_ptr<const Scene> scene, const Structure& structure,
                        const TraceSettings& settings, int stop_count, Task& task);

}  // namespace boxwood::bench
