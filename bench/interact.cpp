#include "bench/interact.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/base/timer.h"
#include "core/render/progressive_tracer.h"

namespace boxwood::bench {

double Times::percentile(double p) const {
    if (ms.empty()) return 0.0;
    std::vector<double> sorted = ms;
    std::ranges::sort(sorted);
    const double rank = std::ceil(p * static_cast<double>(sorted.size()));
    return sorted[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

Times time_slider_steps(std::shared_ptr<const Scene> scene, const std::string& builder, int first_t,
                        int step_count, Memory memory, const ShowBoxes& show, Task& task) {
    Times times;
    StageCache cache;
    for (int step = 0; step < step_count; ++step) {
        if (memory == Memory::None) cache.clear();
        const Timer timer;
        const Recipe recipe = parse_recipe("evh(t=" + std::to_string(first_t + step) + ") > " + builder);
        const std::optional<Built> built = run_recipe(recipe, scene, cache, task, /*with_levels=*/true);
        if (!built) break;
        show(*built);
        times.ms.push_back(timer.milliseconds());
    }
    return times;
}

Times time_tracer_stops(std::shared_ptr<const Scene> scene, const Structure& structure,
                        const TraceSettings& settings, int stop_count, Task& task) {
    constexpr int kSpreadMs = 50;
    constexpr int kStride = 17;  // prime to kSpreadMs: every moment comes
    Times times;
    ProgressiveTracer tracer;
    task.done = 0;
    task.total = static_cast<uint64_t>(stop_count);
    for (int i = 0; i < stop_count && !task.stopped(); ++i) {
        tracer.start(scene, structure, settings);
        std::this_thread::sleep_for(std::chrono::milliseconds(1 + (kStride * i) % kSpreadMs));
        const Timer timer;
        tracer.stop();
        times.ms.push_back(timer.milliseconds());
        ++task.done;
    }
    return times;
}

}  // namespace boxwood::bench
