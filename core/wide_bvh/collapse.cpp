#include "core/wide_bvh/collapse.h"

#include <algorithm>
#include <optional>

#include "core/structure/sah.h"
#include "core/wide_bvh/least_cost_plan.h"

namespace boxwood {

namespace {

/// Opens the child with the largest area, unless what is below it fits into one pack.
template <uint32_t Width>
class GreedyPlan final : public WidePlan<Width> {
public:
    GreedyPlan(const Bvh2& bvh, const PrimCounts& counts) : bvh_(bvh), counts_(counts) {}

    WideParts<Width> children_of(uint32_t node) const override {
        WideParts<Width> children;
        children.add(part(node));
        while (children.count < Width) {
            uint32_t largest = Width;
            for (uint32_t i = 0; i < children.count; ++i) {
                if (children.parts[i].is_leaf) continue;
                if (largest == Width || area(children.parts[i]) > area(children.parts[largest])) largest = i;
            }
            if (largest == Width) break;
            const uint32_t left = bvh_.nodes[children.parts[largest].node].first;
            children.parts[largest] = part(left);
            children.add(part(left + 1));
        }
        return children;
    }

private:
    WidePart part(uint32_t node) const {
        const bool fits = counts_.are_few(node) && WideBvh<Width>::Pack::packs_for(counts_.of(node)) == 1;
        return {node, fits || bvh_.nodes[node].is_leaf()};
    }
    double area(WidePart part) const { return bvh_.nodes[part.node].half_area(); }

    const Bvh2& bvh_;
    const PrimCounts& counts_;
};

template <uint32_t Width>
constexpr uint32_t kMostPrims = WideChild::kMostPacks* WideBvh<Width>::Pack::kSize;  ///< of one leaf

template <uint32_t Width>
bool has_large_leaf(const Bvh2& bvh) {
    return std::ranges::any_of(bvh.nodes,
                               [](const Bvh2::Node& node) { return node.count > kMostPrims<Width>; });
}

/// The same with leaves of at most WideChild::kMostPacks packs: halves of larger ones, with the same box.
template <uint32_t Width>
Bvh2 with_small_leaves(const Bvh2& bvh) {
    Bvh2 result = bvh;
    for (size_t i = 0; i < result.nodes.size(); ++i) {
        const Bvh2::Node leaf = result.nodes[i];
        if (leaf.count <= kMostPrims<Width>) continue;
        const uint32_t left = leaf.count / 2;
        result.nodes[i].first = static_cast<uint32_t>(result.nodes.size());
        result.nodes[i].count = 0;
        result.nodes.push_back({leaf.lower, leaf.first, leaf.upper, left});
        result.nodes.push_back({leaf.lower, leaf.first + left, leaf.upper, leaf.count - left});
    }
    return result;
}

}  // namespace

template <uint32_t Width>
double wide_cost(const WideBvh<Width>& bvh, const WideCosts& costs) {
    if (bvh.nodes.empty()) return 0.0;
    const double root_area = bvh.nodes[0].bounds().half_area();
    double sum = costs.node;
    for (const typename WideBvh<Width>::Node& node : bvh.nodes) {
        for (uint32_t lane = 0; lane < Width; ++lane) {
            const WideChild child = node.children[lane];
            if (child.is_empty()) continue;
            const double probability = hit_probability(node.bounds(lane).half_area(), root_area);
            sum += probability * (child.is_leaf() ? child.pack_count() * costs.pack : costs.node);
        }
    }
    return sum;
}

template <uint32_t Width>
WideBvh<Width> Collapse<Width>::apply(const Mesh& mesh, std::span<const PrimRef>, const Bvh2& input,
                                      Task& task) const {
    if (input.nodes.empty()) return {};
    std::optional<Bvh2> halved;
    if (has_large_leaf<Width>(input)) halved = with_small_leaves<Width>(input);
    const Bvh2& bvh = halved ? *halved : input;
    const PrimCounts counts(mesh, bvh, static_cast<uint32_t>(leaf_size), task);
    if (way == Greedy) return make_wide<Width>(mesh, bvh, counts, GreedyPlan<Width>(bvh, counts), task);
    const WideCosts costs{static_cast<double>(node_cost), static_cast<double>(pack_cost)};
    return make_wide<Width>(mesh, bvh, counts, LeastCostPlan<Width>(bvh, counts, costs, task), task);
}

template struct Collapse<4>;
template struct Collapse<8>;
template struct Collapse<16>;
template double wide_cost(const WideBvh<4>&, const WideCosts&);
template double wide_cost(const WideBvh<8>&, const WideCosts&);
template double wide_cost(const WideBvh<16>&, const WideCosts&);

}  // namespace boxwood
