#include "bench/rates.h"

#include <algorithm>

#include "bench/timing.h"
#include "core/base/rng.h"

namespace boxwood::bench {
namespace {

class Caster {
public:
    Caster(const Structure& structure, const Mesh& mesh, Mode mode, const Task& task)
        : structure_(structure), mesh_(mesh), mode_(mode), task_(task) {}

    double cast(std::span<const Ray> rays) const {
        std::vector<Hit> hits(rays.size());
        const double begin = process_ms();
        structure_.closest_hits(mesh_, rays, hits, mode_, task_);
        return process_ms() - begin;
    }

    /// The lesser of two casts: the first finds nothing in the cache, and either may be held up.
    double least_cast(std::span<const Ray> rays) const {
        const double once = cast(rays);
        return std::min(once, cast(rays));
    }

    /// As many rays as take about `ms`, found by casting more and more of them.
    size_t fitting_count(std::span<const Ray> rays, double ms) const {
        size_t count = std::min<size_t>(rays.size(), 16);
        double taken = least_cast(evenly_spread(rays, count));
        while (count < rays.size() && taken < 0.25 * ms && !task_.stopped()) {
            count = std::min(rays.size(), 4 * count);
            taken = least_cast(evenly_spread(rays, count));
        }
        const double fitting = static_cast<double>(count) * ms / std::max(taken, 1e-3);
        return static_cast<size_t>(std::clamp(fitting, 1.0, static_cast<double>(rays.size())));
    }

private:
    const Structure& structure_;
    const Mesh& mesh_;
    Mode mode_;
    const Task& task_;
};

}  // namespace

std::vector<Ray> evenly_spread(std::span<const Ray> rays, size_t count) {
    std::vector<Ray> chosen(count);
    for (size_t i = 0; i < count; ++i) chosen[i] = rays[i * rays.size() / count];
    return chosen;
}

double Rate::mrays_per_s() const { return static_cast<double>(rays) / median_of(ms) / 1000.0; }

std::vector<Rate> time_rates(std::span<const Structure> structures, const Mesh& mesh,
                             std::span<const Ray> rays, const RateSettings& settings, const Task& task) {
    std::vector<Rate> rates(structures.size());
    if (rays.empty()) return rates;
    std::vector<Caster> casters;
    std::vector<std::vector<Ray>> chosen;
    std::vector<size_t> order;
    for (const Structure& structure : structures) {
        const Caster caster(structure, mesh, settings.mode, task);
        chosen.push_back(evenly_spread(rays, caster.fitting_count(rays, settings.round_ms)));
        rates[order.size()].rays = chosen.back().size();
        order.push_back(order.size());
        casters.push_back(caster);
    }
    Rng rng(settings.seed);
    for (int round = 0; round <= settings.rounds; ++round) {
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.next_index(i)]);
        for (const size_t i : order) {
            const double ms = casters[i].cast(chosen[i]);
            if (task.stopped()) return rates;
            if (round > 0) rates[i].ms.push_back(ms);
        }
    }
    return rates;
}

}  // namespace boxwood::bench
