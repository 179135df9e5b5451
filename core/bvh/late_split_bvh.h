#pragma once

#include "core/bvh/bvh2.h"

namespace boxwood {

/// A binary BVH whose large leaves go on as small trees of disjoint cells. Ernst, Greiner 2007, section 5.1.
///
/// A node below an original leaf is the smallest box around the parts of its primitives in its cell. An inner
/// one is cut in the middle of its box's longest axis (see late_split_plane) into two closed cells, and every
/// primitive that touches a cell is in it. So the two sides of a cut follow each other along a ray, in the
/// order of the direction's sign, and traversal of such a tree is strictly front to back.
///
/// Once a deep leaf was visited, the rest of its tree is dropped if the original leaf held one primitive,
/// which was tested whole, or if the nearest hit lies before the walls beyond which the cells not yet visited
/// lie: what could be hit as early is in this cell, or was in one before. A hit in a wall is also in the cell
/// before it, as cells are closed, so ties are decided among all that take part in them.
struct LateSplitBvh {
    static constexpr const char* kFamily = "late split BVH";
    using Node = Bvh2::Node;

    Array<Node> nodes;  ///< those of the original tree, at their old places, then those below its leaves
    std::vector<uint32_t> prims;
    uint32_t original_count = 0;  ///< nodes of the original tree
    uint32_t single_end = 0;  ///< nodes [original_count, single_end) are below leaves that held one primitive

    /// Whether traversal of the original tree ends at this node of it.
    bool is_original_leaf(const Node& node) const { return node.is_leaf() || node.first >= original_count; }

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const { return nodes.size() * sizeof(Node) + prims.size() * sizeof(uint32_t); }
};

/// Where a box below an original leaf is cut.
struct LateSplitPlane {
    int axis;
    float position;
};
inline LateSplitPlane late_split_plane(const Box& box) {
    const int axis = box.largest_axis();
    return {axis, 0.5f * box.lower[axis] + 0.5f * box.upper[axis]};
}

}  // namespace boxwood
