#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/structure/structure.h"

namespace boxwood::bench {

struct RateSettings {
    Mode mode = Mode::Exact;
    int rounds = 5;          ///< that are timed; one before them warms up
    double round_ms = 50.0;  ///< about, of one structure in one round: a slow one casts fewer of the rays
    uint64_t seed = 1;       ///< of the order within rounds
};

/// How fast one structure answers.
struct Rate {
    uint64_t rays = 0;         ///< cast in each round, evenly spread over those given
    std::vector<double> ms{};  ///< of each round

    double mrays_per_s() const;  ///< of the median round; NaN where nothing was timed
};

/// `count` of the rays, evenly spread; count <= rays.size().
std::vector<Ray> evenly_spread(std::span<const Ray> rays, size_t count);

/// Closest hits by every structure of the same mesh, in rounds over all of them in random order, so that what
/// slows the machine down slows all down. One thread, processor time. After a stop not to be used.
std::vector<Rate> time_rates(std::span<const Structure> structures, const Mesh& mesh,
                             std::span<const Ray> rays, const RateSettings& settings, const Task& task);

}  // namespace boxwood::bench
