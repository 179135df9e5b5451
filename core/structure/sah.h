#pragma once

#include <cstddef>

namespace boxwood {

/// Cost model shared by all builders and by the measures, in triangle tests.
/// MacDonald, Booth, "Heuristics for ray tracing using space subdivision", The Visual Computer 1990: a random
/// ray that meets a convex box meets a convex part of it with the ratio of their areas as its probability.
inline constexpr float kTraversalCost = 1.0f;     ///< visiting one inner node
inline constexpr double kIntersectionCost = 1.0;  ///< testing one primitive

/// Probability that a ray which meets the root meets the node, from half areas (see Box::half_area). A root
/// without area (a point, a segment, nothing) is met with every one of its nodes: 1. In double no box of
/// floats overflows: a half area is below 2^260.
inline double hit_probability(double node_half_area, double root_half_area) {
    return root_half_area > 0.0 ? node_half_area / root_half_area : 1.0;
}

/// Cost of a leaf that is visited, without its probability.
inline double leaf_cost(size_t prim_count, double intersection_cost = kIntersectionCost) {
    return static_cast<double>(prim_count) * intersection_cost;
}

}  // namespace boxwood
