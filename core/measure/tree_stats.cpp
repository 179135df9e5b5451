#include "core/measure/tree_stats.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/measure/children.h"
#include "core/measure/covered_share.h"

namespace boxwood {

namespace {

/// What the nodes of one level do to their parents.
struct Siblings {
    double common = 0.0;   ///< area of common boxes
    double empty = 0.0;    ///< area of the parents, each times its empty share
    double parents = 0.0;  ///< area of the parents
};

/// Of the parent's box; 0 where only rounding says otherwise.
double empty_share(const Box& parent, std::span<const Box> children) {
    constexpr double kRounding = 1e-12;
    const double share = 1.0 - covered_share(parent, children);
    return share > kRounding ? share : 0.0;
}

/// Fills in overlap and empty volume of every level and of the whole tree.
void measure_siblings(const std::vector<NodeView>& nodes, TreeStats& stats) {
    const Children children = list_children(nodes);
    std::vector<Siblings> levels(stats.levels.size());
    std::vector<Box> boxes;
    for (size_t i = 0; i < nodes.size(); ++i) {
        const std::span<const uint32_t> siblings = children.of(i);
        if (siblings.empty()) continue;
        if (siblings.size() > TreeStats::kMostSiblings) {
            ++stats.crowded_parents;
            continue;
        }
        boxes.clear();
        for (const uint32_t node : siblings) boxes.push_back(nodes[node].bounds);
        Siblings& level = levels[size_t{nodes[i].level} + 1];
        const double area = nodes[i].bounds.half_area();
        level.parents += area;
        level.empty += area * empty_share(nodes[i].bounds, boxes);
        for (size_t a = 0; a < boxes.size(); ++a)
            for (size_t b = a + 1; b < boxes.size(); ++b)
                level.common += overlap_half_area(boxes[a], boxes[b]);
    }
    Siblings all;
    for (size_t l = 0; l < levels.size(); ++l) {
        all.common += levels[l].common;
        all.empty += levels[l].empty;
        all.parents += levels[l].parents;
        if (!(levels[l].parents > 0.0)) continue;
        stats.levels[l].sibling_overlap = levels[l].common / levels[l].parents;
        stats.levels[l].empty_volume = levels[l].empty / levels[l].parents;
    }
    const double root_area = nodes[0].bounds.half_area();
    if (root_area > 0.0) stats.sibling_overlap = all.common / root_area;
    if (all.parents > 0.0) stats.empty_volume = all.empty / all.parents;
}

void measure_leaf_sizes(const std::vector<NodeView>& nodes, TreeStats& stats) {
    const uint64_t filled = stats.leaves - stats.empty_leaves;
    if (filled == 0) return;
    stats.mean_leaf_size = static_cast<double>(stats.references) / static_cast<double>(filled);
    double squares = 0.0;
    for (const NodeView& node : nodes) {
        if (node.kind != NodeKind::Leaf || node.ref_count == 0) continue;
        const double difference = static_cast<double>(node.ref_count) - stats.mean_leaf_size;
        squares += difference * difference;
    }
    stats.leaf_size_variation = std::sqrt(squares / static_cast<double>(filled)) / stats.mean_leaf_size;
}

}  // namespace

double overlap_half_area(const Box& a, const Box& b) {
    const Box common = {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
    if (common.is_empty()) return 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const bool touch = a.upper[axis] == b.lower[axis] || b.upper[axis] == a.lower[axis];
        const bool are_both_flat = a.lower[axis] == a.upper[axis] && b.lower[axis] == b.upper[axis];
        if (touch && !are_both_flat) return 0.0;
    }
    return common.half_area();
}

TreeStats tree_stats(const LevelTable& table, double traversal_cost, double intersection_cost) {
    TreeStats stats;
    const std::vector<NodeView>& nodes = table.list.nodes;
    if (nodes.empty()) return stats;
    const double root_area = table.list.half_area(0);
    stats.levels.resize(table.level_count());
    for (size_t i = 0; i < nodes.size(); ++i) {
        const NodeView& node = nodes[i];
        LevelStats& level = stats.levels[node.level];
        const double probability = hit_probability(table.list.half_area(i), root_area);
        ++level.nodes;
        level.total_area += probability;
        if (node.kind == NodeKind::Inner) {
            level.sah_cost += probability * traversal_cost;
            continue;
        }
        ++level.leaves;
        level.references += node.ref_count;
        level.sah_cost += probability * leaf_cost(node.ref_count, intersection_cost);
        if (node.ref_count == 0) ++stats.empty_leaves;
        const size_t size = std::min(size_t{node.ref_count}, TreeStats::kMostLeafSize);
        if (stats.leaf_sizes.size() <= size) stats.leaf_sizes.resize(size + 1, 0);
        ++stats.leaf_sizes[size];
    }
    for (LevelStats& level : stats.levels) {
        level.mean_area = level.total_area / static_cast<double>(level.nodes);
        stats.nodes += level.nodes;
        stats.leaves += level.leaves;
        stats.references += level.references;
        stats.sah_cost += level.sah_cost;
    }
    measure_siblings(nodes, stats);
    measure_leaf_sizes(nodes, stats);
    return stats;
}

}  // namespace boxwood
