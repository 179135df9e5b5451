#include "core/wide_bvh/least_cost_plan.h"

#include <limits>

#include "core/base/parallel.h"
#include "core/structure/sah.h"

namespace boxwood {

namespace {

constexpr uint32_t kParallelPlanDepth = 9;  ///< nodes above it are solved in parallel

}  // namespace

template <uint32_t Width>
LeastCostPlan<Width>::LeastCostPlan(const Bvh2& bvh, const PrimCounts& counts, const WideCosts& costs,
                                    const Task& task)
    : bvh_(bvh),
      counts_(counts),
      costs_(costs),
      task_(task),
      root_area_(bvh.nodes[0].half_area()),
      choices_(std::make_unique_for_overwrite<Choice[]>(bvh.nodes.size() / 2 + 1)) {
    solve(0, 0);
}

template <uint32_t Width>
LeastCosts<Width> LeastCostPlan<Width>::solve(uint32_t node, uint32_t depth) {
    const Bvh2::Node& source = bvh_.nodes[node];
    if (source.is_leaf()) return leaf_costs<Width>(leaf_cost(node, source.count));
    LeastCosts<Width> left{}, right{};
    if (task_.stopped()) return left;
    const auto solve_left = [&] { left = solve(source.first, depth + 1); };
    const auto solve_right = [&] { right = solve(source.first + 1, depth + 1); };
    if (depth < kParallelPlanDepth) {
        parallel_invoke(solve_left, solve_right);
    } else {
        solve_left();
        solve_right();
    }
    return choose(node, left, right);
}

template <uint32_t Width>
LeastCosts<Width> LeastCostPlan<Width>::choose(uint32_t node, const LeastCosts<Width>& left,
                                               const LeastCosts<Width>& right) {
    const double as_leaf =
        counts_.are_few(node) ? leaf_cost(node, counts_.of(node)) : std::numeric_limits<double>::infinity();
    return least_costs<Width>(left, right, probability(node) * costs_.node, as_leaf, choice_of(node));
}

template <uint32_t Width>
double LeastCostPlan<Width>::leaf_cost(uint32_t node, uint32_t prim_count) const {
    return probability(node) * WideBvh<Width>::Pack::packs_for(prim_count) * costs_.pack;
}

template <uint32_t Width>
double LeastCostPlan<Width>::probability(uint32_t node) const {
    return hit_probability(bvh_.nodes[node].half_area(), root_area_);
}

template <uint32_t Width>
WideParts<Width> LeastCostPlan<Width>::children_of(uint32_t node) const {
    WideParts<Width> children;
    add_children(node, Width, children);
    return children;
}

template <uint32_t Width>
void LeastCostPlan<Width>::add_children(uint32_t node, uint32_t most, WideParts<Width>& children) const {
    if (bvh_.nodes[node].is_leaf()) return children.add({node, /*is_leaf=*/true});
    const Choice& choice = choice_of(node);
    while (most > 1 && choice[most - 1] == 0) --most;
    if (most == 1) return children.add({node, choice[0] != 0});
    const uint32_t left = choice[most - 1];
    add_children(bvh_.nodes[node].first, left, children);
    add_children(bvh_.nodes[node].first + 1, most - left, children);
}

template class LeastCostPlan<4>;
template class LeastCostPlan<8>;
template class LeastCostPlan<16>;

}  // namespace boxwood
