#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/box.h"

namespace boxwood {

enum class NodeKind : uint8_t { Inner, Leaf };

/// One node of any structure, as viewer, measures and checks see it.
struct NodeView {
    Box bounds;
    uint32_t parent = kNoIndex;  ///< index into NodeList::nodes; kNoIndex for the root
    uint32_t level = 0;          ///< edges from the root
    NodeKind kind = NodeKind::Leaf;
    uint32_t first_ref = 0;  ///< leaf: its primitives are ref_prims[first_ref, first_ref + ref_count)
    uint32_t ref_count = 0;
};

/// Line segment of the outline of a node that is no box: an edge of a convex cell, a part of a circle.
struct OutlineSegment {
    uint32_t node;
    Vec3 from, to;
};

/// Nodes of a structure, parents before children, and the primitives of its leaves.
struct NodeList {
    std::vector<NodeView> nodes;
    std::vector<uint32_t> ref_prims;
    std::vector<OutlineSegment> outlines;  ///< in any order; a node that has none is drawn as its box
    /// Half the surface area of each node's volume where the volumes are no boxes; empty: that of the boxes.
    std::vector<double> half_areas;
    /// Whether every child's box lies in its parent's. False for volumes other than boxes: each contains what
    /// the leaves below it hold, but may stick out of its parent's.
    bool is_nested = true;

    double half_area(size_t node) const {
        return half_areas.empty() ? nodes[node].bounds.half_area() : half_areas[node];
    }
};

/// Nodes grouped by level. order[level_begin[l] .. level_begin[l + 1]) are the nodes at level l: leaves
/// first, then inner nodes, each by descending half area of the volume, ties by index. list.outlines
/// are sorted by node.
struct LevelTable {
    NodeList list;
    std::vector<uint32_t> order;
    std::vector<uint32_t> level_begin;  ///< level_count() + 1 entries
    std::vector<uint32_t> leaf_count;   ///< leaves at each level
    /// Outline of node n: list.outlines[outline_begin[n] .. outline_begin[n + 1]). Empty without outlines.
    std::vector<uint32_t> outline_begin;

    size_t level_count() const { return leaf_count.size(); }
    size_t byte_count() const;
    std::span<const uint32_t> level(size_t l) const {
        return std::span(order).subspan(level_begin[l], level_begin[l + 1] - level_begin[l]);
    }
    std::span<const uint32_t> leaves(size_t l) const { return level(l).first(leaf_count[l]); }
    /// Empty where the node is drawn as its box.
    std::span<const OutlineSegment> outline(uint32_t node) const {
        if (outline_begin.empty()) return {};
        return std::span(list.outlines)
            .subspan(outline_begin[node], outline_begin[node + 1] - outline_begin[node]);
    }
    /// The cut at `level`: its nodes and the leaves above it. With the level's own leaves they cover all
    /// references.
    std::vector<uint32_t> cut(size_t level) const;
};

LevelTable make_level_table(NodeList list);

/// First violation found, as a sentence; empty if the nodes form a valid hierarchy over `triangle_count`
/// primitives in which every primitive occurs and no leaf holds one twice.
std::string check_nodes(const NodeList& list, size_t triangle_count);

}  // namespace boxwood
