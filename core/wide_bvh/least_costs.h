#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace boxwood {

/// What showing a subtree as children of a wide node costs at least: see LeastCostPlan.
template <uint32_t Width>
struct LeastCosts {
    std::array<double, Width> least;  ///< C(n, i) at [i - 1] for i up to `most`; what comes after is not set
    uint32_t most;                    ///< more children than so many cost no less
};

/// What the minima are taken at. At [0] whether one child is a leaf; at [i - 1] the children that the left
/// subtree has of i, 0 where i - 1 children cost no more.
template <uint32_t Width>
using LeastCostChoice = std::array<uint8_t, Width>;

/// Of a subtree that is a leaf.
template <uint32_t Width>
LeastCosts<Width> leaf_costs(double as_leaf) {
    LeastCosts<Width> costs;
    costs.least[0] = as_leaf;
    costs.most = 1;
    return costs;
}

/// Of a subtree with two others below it: `visit` is what visiting it costs as a node, children not included,
/// `as_leaf` what it costs as one leaf, infinity where that must not be.
template <uint32_t Width>
LeastCosts<Width> least_costs(const LeastCosts<Width>& left, const LeastCosts<Width>& right, double visit,
                              double as_leaf, LeastCostChoice<Width>& choice) {
    // D(n, j) at [j - 1] first; where j is more than both subtrees have a use for, that of the largest such.
    LeastCosts<Width> costs;
    std::array<double, Width>& best = costs.least;
    choice.fill(0);
    const uint32_t useful = std::min(left.most + right.most, Width);
    for (uint32_t j = 2; j <= useful; ++j) {
        const uint32_t first = j > right.most ? j - right.most : 1, last = std::min(left.most, j - 1);
        double least = std::numeric_limits<double>::infinity();
        uint32_t at = 0;
        for (uint32_t k = first; k <= last; ++k) {
            const double cost = left.least[k - 1] + right.least[j - k - 1];
            at = cost < least ? k : at;
            least = cost < least ? cost : least;
        }
        best[j - 1] = least;
        choice[j - 1] = static_cast<uint8_t>(at);
    }
    const double as_node = visit + best[useful - 1];
    const bool is_leaf = as_leaf <= as_node;
    choice[0] = is_leaf ? 1 : 0;
    best[0] = is_leaf ? as_leaf : as_node;
    costs.most = 1;
    for (uint32_t i = 2; i <= useful; ++i) {
        // Where it costs the same: one leaf rather than many, but many nodes on one level rather than two.
        if (best[i - 1] < best[i - 2] || (best[i - 1] == best[i - 2] && !is_leaf)) {
            costs.most = i;
        } else {
            best[i - 1] = best[i - 2];
            choice[i - 1] = 0;
        }
    }
    return costs;
}

}  // namespace boxwood
