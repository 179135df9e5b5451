#include "core/structure/node_list.h"

#include <algorithm>
#include <utility>

namespace boxwood {

namespace {

struct SortKey {
    double half_area;
    uint32_t node;
};

/// What is wrong with the link from node `i` to its parent; empty if nothing.
std::string check_parent(const NodeList& list, size_t i) {
    const std::vector<NodeView>& nodes = list.nodes;
    const NodeView& node = nodes[i];
    const std::string name = "node " + std::to_string(i);
    if (i == 0) {
        if (node.parent != kNoIndex) return name + " is the first and has a parent";
        return node.level == 0 ? std::string() : name + " is the root and not at level 0";
    }
    if (node.parent == kNoIndex) return name + " is a second root";
    if (node.parent >= i) return name + " comes before its parent";
    const NodeView& parent = nodes[node.parent];
    if (parent.kind != NodeKind::Inner) return name + " is the child of a leaf";
    if (node.level != parent.level + 1) return name + " is not one level below its parent";
    if (list.is_nested && !parent.bounds.contains(node.bounds)) return name + " sticks out of its parent";
    return {};
}

/// What is wrong with the primitives of leaf `i`. last_leaf[prim]: the leaf that held it last.
std::string check_leaf(const NodeList& list, size_t i, std::vector<uint32_t>& last_leaf) {
    const NodeView& leaf = list.nodes[i];
    const std::string name = "leaf " + std::to_string(i);
    if (size_t{leaf.first_ref} + leaf.ref_count > list.ref_prims.size())
        return name + " has references beyond the list";
    if (leaf.ref_count > 0 && leaf.bounds.is_empty()) return name + " has primitives in an empty box";
    for (uint32_t r = leaf.first_ref; r < leaf.first_ref + leaf.ref_count; ++r) {
        const uint32_t prim = list.ref_prims[r];
        if (prim >= last_leaf.size())
            return name + " has primitive " + std::to_string(prim) + ", which does not exist";
        if (last_leaf[prim] == i) return name + " holds primitive " + std::to_string(prim) + " twice";
        last_leaf[prim] = static_cast<uint32_t>(i);
    }
    return {};
}

/// Sorts the outlines by node, those of one node in their order; where each node's begin, if there are any.
std::vector<uint32_t> sort_outlines(NodeList& list) {
    if (list.outlines.empty()) return {};
    if (!std::ranges::is_sorted(list.outlines, {}, &OutlineSegment::node))
        std::ranges::stable_sort(list.outlines, {}, &OutlineSegment::node);
    std::vector<uint32_t> begin(list.nodes.size() + 1, 0);
    for (const OutlineSegment& segment : list.outlines) ++begin[segment.node + 1];
    for (size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
    return begin;
}

}  // namespace

size_t LevelTable::byte_count() const {
    return list.nodes.size() * sizeof(NodeView) + list.ref_prims.size() * sizeof(uint32_t) +
           list.outlines.size() * sizeof(OutlineSegment) + list.half_areas.size() * sizeof(double) +
           (order.size() + level_begin.size() + leaf_count.size() + outline_begin.size()) * sizeof(uint32_t);
}

std::vector<uint32_t> LevelTable::cut(size_t level_wanted) const {
    std::vector<uint32_t> nodes;
    for (size_t l = 0; l < std::min(level_wanted, level_count()); ++l)
        nodes.insert(nodes.end(), leaves(l).begin(), leaves(l).end());
    if (level_wanted < level_count())
        nodes.insert(nodes.end(), level(level_wanted).begin(), level(level_wanted).end());
    return nodes;
}

LevelTable make_level_table(NodeList list) {
    LevelTable table;
    // Counting sort: group 2l holds the leaves at level l, group 2l + 1 its inner nodes.
    uint32_t level_count = 0;
    for (const NodeView& node : list.nodes) level_count = std::max(level_count, node.level + 1);
    std::vector<uint32_t> group_begin(2 * size_t{level_count} + 1, 0);
    const auto group = [](const NodeView& node) {
        return 2 * size_t{node.level} + (node.kind == NodeKind::Leaf ? 0 : 1);
    };
    for (const NodeView& node : list.nodes) ++group_begin[group(node) + 1];
    for (size_t g = 1; g < group_begin.size(); ++g) group_begin[g] += group_begin[g - 1];

    std::vector<SortKey> keys(list.nodes.size());
    std::vector<uint32_t> next(group_begin.begin(), group_begin.end() - 1);
    for (uint32_t i = 0; i < list.nodes.size(); ++i)
        keys[next[group(list.nodes[i])]++] = {list.half_area(i), i};
    for (size_t g = 0; g + 1 < group_begin.size(); ++g)
        std::sort(keys.begin() + group_begin[g], keys.begin() + group_begin[g + 1],
                  [](const SortKey& a, const SortKey& b) {
                      return a.half_area > b.half_area || (a.half_area == b.half_area && a.node < b.node);
                  });

    table.order.reserve(keys.size());
    for (const SortKey& key : keys) table.order.push_back(key.node);
    table.level_begin.push_back(0);
    for (size_t l = 0; l < level_count; ++l) {
        table.leaf_count.push_back(group_begin[2 * l + 1] - group_begin[2 * l]);
        table.level_begin.push_back(group_begin[2 * l + 2]);
    }
    table.outline_begin = sort_outlines(list);
    table.list = std::move(list);
    return table;
}

std::string check_nodes(const NodeList& list, size_t triangle_count) {
    const std::vector<NodeView>& nodes = list.nodes;
    if (nodes.empty() && triangle_count > 0) return "there are primitives and no nodes";
    if (!list.half_areas.empty() && list.half_areas.size() != nodes.size())
        return "there are " + std::to_string(nodes.size()) + " nodes and " +
               std::to_string(list.half_areas.size()) + " areas";
    std::vector<uint32_t> last_leaf(triangle_count, kNoIndex);
    std::vector<uint8_t> has_child(nodes.size(), 0);
    for (size_t i = 0; i < nodes.size(); ++i) {
        std::string wrong = check_parent(list, i);
        if (wrong.empty() && nodes[i].kind == NodeKind::Leaf) wrong = check_leaf(list, i, last_leaf);
        if (!wrong.empty()) return wrong;
        if (nodes[i].parent != kNoIndex) has_child[nodes[i].parent] = 1;
    }
    for (size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].kind == NodeKind::Inner && has_child[i] == 0)
            return "inner node " + std::to_string(i) + " has no child";
    for (const OutlineSegment& segment : list.outlines)
        if (segment.node >= nodes.size())
            return "an outline belongs to node " + std::to_string(segment.node) + ", which does not exist";
    const auto missing = std::find(last_leaf.begin(), last_leaf.end(), kNoIndex);
    if (missing != last_leaf.end())
        return "primitive " + std::to_string(missing - last_leaf.begin()) + " is in no leaf";
    return {};
}

}  // namespace boxwood
