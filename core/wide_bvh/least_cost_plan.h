#pragma once

#include "core/wide_bvh/collapse.h"
#include "core/wide_bvh/least_costs.h"
#include "core/wide_bvh/prim_counts.h"
#include "core/wide_bvh/wide_output.h"

namespace boxwood {

/// The choice of subtrees with the least wide_cost. With C(n, i) the least cost of showing the subtree n as
/// at most i children (nodes or leaves) of one node, A the probability of a visit, P(n) its packs:
///
///     D(n, j) = min over 0 < k < j of C(left, k) + C(right, j - k)
///     C(n, 1) = min(A(n) P(n) pack, if the primitives are few;  A(n) node + D(n, Width))
///     C(n, i) = min(D(n, i), C(n, i - 1))
///
/// Ylitie, Karras, Laine 2017, section 3.1, eq. 1 to 4. Bottom up, in time O(Width^2) and Width bytes for
/// each node of the input.
template <uint32_t Width>
class LeastCostPlan final : public WidePlan<Width> {
public:
    /// `counts`: few are those of the largest leaf that may be made.
    LeastCostPlan(const Bvh2& bvh, const PrimCounts& counts, const WideCosts& costs, const Task& task);
    WideParts<Width> children_of(uint32_t node) const override;

private:
    using Choice = LeastCostChoice<Width>;

    LeastCosts<Width> solve(uint32_t node, uint32_t depth);
    LeastCosts<Width> choose(uint32_t node, const LeastCosts<Width>& left, const LeastCosts<Width>& right);
    double leaf_cost(uint32_t node, uint32_t prim_count) const;
    double probability(uint32_t node) const;
    Choice& choice_of(uint32_t inner) const { return choices_[bvh_.nodes[inner].first / 2]; }
    void add_children(uint32_t node, uint32_t most, WideParts<Width>& children) const;

    const Bvh2& bvh_;
    const PrimCounts& counts_;
    WideCosts costs_;
    const Task& task_;
    double root_area_;
    /// Of the inner nodes of the input, in the order of their children; not initialised.
    std::unique_ptr<Choice[]> choices_;
};

}  // namespace boxwood
