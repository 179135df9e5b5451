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

double geometric_mean(std::span<const double> values) {
    double sum = 0.0;
    for (const double value : values) sum += std::log(value);
    return std::exp(sum / static_cast<double>(values.size()));  // NaN for none
}

RatioSummary summary_of(const std::string& contestant, std::span<const RatioCell> cells) {
    RatioSummary summary;
    summary.contestant = contestant;
    std::vector<double> ratios, over_fast;
    for (const RatioCell& cell : cells) {
        if (cell.contestant != contestant || !(cell.ratio > 0.0)) continue;
        if (ratios.empty() || cell.ratio < summary.worst) {
            summary.worst = cell.ratio;
            summary.worst_cell = cell.cell;
        }
        ratios.push_back(cell.ratio);
        if (cell.over_fast > 0.0) over_fast.push_back(cell.over_fast);
        summary.wrong += cell.wrong;
    }
    summary.cells = ratios.size();
    summary.geometric_mean = geometric_mean(ratios);
    summary.under_09 = static_cast<uint64_t>(std::ranges::count_if(ratios, [](double r) { return r < 0.9; }));
    summary.under_12 = static_cast<uint64_t>(std::ranges::count_if(ratios, [](double r) { return r < 1.2; }));
    summary.over_fast = geometric_mean(over_fast);
    summary.worst_over_fast = over_fast.empty() ? summary.over_fast : std::ranges::max(over_fast);
    return summary;
}

}  // namespace

RatioInterval ratio_of_medians(std::span<const double> above, std::span<const double> below) {
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
        const auto known = std::ranges::find(summaries, cell.contestant, &RatioSummary::contestant);
        if (known == summaries.end()) summaries.push_back(summary_of(cell.contestant, cells));
    }
    return summaries;
}

}  // namespace boxwood::bench
