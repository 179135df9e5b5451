#pragma once

#include <span>
#include <vector>

namespace boxwood::bench {

/// Pearson's correlation, -1 to 1. NaN for fewer than three pairs, and where one side does not vary.
/// x.size() == y.size().
double pearson(std::span<const double> x, std::span<const double> y);

/// Ranks from 1 on; equal values share the mean of their ranks.
std::vector<double> ranks(std::span<const double> values);

/// Spearman's rank correlation: Pearson's of the ranks.
double spearman(std::span<const double> x, std::span<const double> y);

}  // namespace boxwood::bench
