#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace boxwood::bench {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A value with the interval that holds it in 95 of 100 repetitions.
struct RatioInterval {
    double value = 0.0, lower = 0.0, upper = 0.0;
};

/// median(above) / median(below), above[i] and below[i] being the times of round i. The interval: rounds
/// drawn again with repetition, 500 times, both sides the same ones. Efron, "Bootstrap Methods: Another Look
/// at the Jackknife", Annals of Statistics 7, 1979; percentiles. NaN where a side is empty or their lengths
/// differ.
RatioInterval ratio_of_medians(std::span<const double> above, std::span<const double> below);

/// One contestant in one cell: how its rate stands to the best peer's.
struct RatioCell {
    std::string contestant;
    std::string cell;  ///< "dragon.glb diffuse"
    double ratio = 0.0;
    double over_fast = 0.0;  ///< exact mode: its time over fast mode's; NaN where not known
    uint64_t wrong = 0;      ///< answers
};

/// All cells of one contestant.
struct RatioSummary {
    std::string contestant;
    uint64_t cells = 0;
    double geometric_mean = 0.0;
    double worst = 0.0;
    std::string worst_cell;
    uint64_t under_09 = 0, under_12 = 0;  ///< cells with a ratio below 0.9, below 1.2
    double over_fast = 0.0;               ///< geometric mean; NaN where no cell has it
    double worst_over_fast = 0.0;
    uint64_t wrong = 0;
};

/// In the order in which contestants first occur; cells whose ratio is NaN are left out.
std::vector<RatioSummary> summarize(std::span<const RatioCell> cells);

}  // namespace boxwood::bench
