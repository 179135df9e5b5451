#include "bench/ratios.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/timing.h"
#include "core/base/rng.h"

namespace boxwood::bench {

namespace {
constexpr size_t kResamples = 500;
constexpr double kOutside = 0.025;  ///< share of the resamples on each side of the interval
}  // namespace

Interval ratio_of_medians(std::span<const double> above, std::span<const double> below) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    if (above.empty() || above.size() != below.size()) return {kNan, kNan, kNan};
    const size_t count = above.size();
    std::vector<double> first(above.begin(), above.end()), second(below.begin(), below.end());
    const double value = median_of(first) / median_of(second);
    Rng rng(1);
    std::vector<double> ratios;
    for (size_t k = 0; k < kResamples; ++k) {
        for (size_t i = 0; i < count; ++i) {
            const size_t round = rng.next_index(count);
            first[i] = above[round];
            second[i] = below[round];
        }
        ratios.push_back(median_of(first) / median_of(second));
    }
    std::ranges::sort(ratios);
    const auto outside = static_cast<size_t>(kOutside * kResamples);
    return {value, ratios[outside], ratios[kResamples - 1 - outside]};
}

std::vector<RatioSummary> summarize(std::span<const RatioCell> cells) {
    std::vector<RatioSummary> summaries;
    for (const RatioCell& cell : cells) {
        if (!(cell.ratio > 0.0)) continue;
        auto own = std::ranges::find(summaries, cell.contestant, &RatioSummary::contestant);
        if (own == summaries.end()) {
            RatioSummary summary;
            summary.contestant = cell.contestant;
            summary.worst = std::numeric_limits<double>::infinity();
            own = summaries.insert(summaries.end(), std::move(summary));
        }
        ++own->cells;
        own->geometric_mean += std::log(cell.ratio);  // the sum so far
        own->under_09 += cell.ratio < 0.9 ? 1 : 0;
        own->under_12 += cell.ratio < 1.2 ? 1 : 0;
        if (cell.ratio < own->worst) {
            own->worst = cell.ratio;
            own->worst_cell = cell.cell;
        }
    }
    for (RatioSummary& summary : summaries)
        summary.geometric_mean = std::exp(summary.geometric_mean / static_cast<double>(summary.cells));
    return summaries;
}

}  // namespace boxwood::bench
