#include "core/measure/tree_stats.h"

#include <algorithm>

namespace boxwood {

namespace {

/// Children of each node: child[begin[n] .. begin[n + 1]).
struct Children {
    std::vector<uint32_t> begin, child;
};

Children list_children(const std::vector<NodeView>& nodes) {
    Children children;
    children.begin.assign(nodes.size() + 1, 0);
    for (const NodeView& node : nodes)
        if (node.parent != kNoIndex) ++children.begin[node.parent + 1];
    for (size_t i = 1; i < children.begin.size(); ++i) children.begin[i] += children.begin[i - 1];
    children.child.resize(children.begin.back());
    std::vector<uint32_t> next(children.begin.begin(), children.begin.end() - 1);
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].parent != kNoIndex) children.child[next[nodes[i].parent]++] = i;
    return children;
}

/// Fills in sibling_overlap of every level.
void measure_overlap(const std::vector<NodeView>& nodes, TreeStats& stats) {
    const Children children = list_children(nodes);
    std::vector<double> common(stats.levels.size(), 0.0), parents(stats.levels.size(), 0.0);
    for (size_t i = 0; i < nodes.size(); ++i) {
        const uint32_t begin = children.begin[i], end = children.begin[i + 1];
        if (begin == end) continue;
        if (end - begin > TreeStats::kMostSiblings) {
            ++stats.crowded_parents;
            continue;
        }
        const size_t level = size_t{nodes[i].level} + 1;
        parents[level] += nodes[i].bounds.half_area();
        for (uint32_t a = begin; a < end; ++a)
            for (uint32_t b = a + 1; b < end; ++b)
                common[level] +=
                    overlap_half_area(nodes[children.child[a]].bounds, nodes[children.child[b]].bounds);
    }
    for (size_t l = 0; l < stats.levels.size(); ++l)
        if (parents[l] > 0.0) stats.levels[l].sibling_overlap = common[l] / parents[l];
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
    measure_overlap(nodes, stats);
    return stats;
}

}  // namespace boxwood
