#pragma once

#include <cstddef>

namespace boxwood {

/// Cost model shared by all builders and by the measures, in triangle tests.
/// MacDonald, Booth, "Heuristics for ray tracing using space subdivision", The Visual Computer 1990: a random
/// ray that meets a convex box meets a convex part of it with the ratio of their areas as its probability.
inline constexpr float kTraversalCost = 1.0f;     ///< visiting one inner node
inline constexpr float kIntersectionCost = 1.0f;  ///< testing one primitive

/// Probability that a ray which meets the root meets the node, from half areas (see Box::half_area). A root
/// without area (a point, a segment, nothing) is met with every one of its nodes: 1. In double no box of
/// floats overflows: a half area is below 2^260.
inline double hit_probability(double node_half_area, double root_half_area) {
    return root_half_area > 0.0 ? node_half_area / root_half_area : 1.0;
}

/// Cost of a leaf that is visited, without its probability.
inline double leaf_cost(size_t prim_count, double intersection_cost = double{kIntersectionCost}) {
    return static_cast<double>(prim_count) * intersection_cost;
}

/// Cost of splitting a set into two children, relative to a visit of the parent; half areas as above.
/// Ernst, Greiner 2007, section 3.3: C = |P_l| SA(B_l) / SA(B) + |P_r| SA(B_r) / SA(B), and the visit itself.
inline double split_cost(double left_half_area, size_t left_count, double right_half_area, size_t right_count,
                         double parent_half_area, double traversal_cost = double{kTraversalCost},
                         double intersection_cost = double{kIntersectionCost}) {
    return traversal_cost +
           hit_probability(left_half_area, parent_half_area) * leaf_cost(left_count, intersection_cost) +
           hit_probability(right_half_area, parent_half_area) * leaf_cost(right_count, intersection_cost);
}

}  // namespace boxwood
