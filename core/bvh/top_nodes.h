#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/bvh/top_down.h"

namespace boxwood {

/// A node of the top of a tree under construction, or, where it has no children here, a part: the root of a
/// subtree that one thread builds. Parents before children.
struct TopNode {
    RefRange range;
    uint32_t depth;
    uint32_t left = kNoIndex;  ///< among the top nodes; the right one follows
    uint32_t node_count = 1;   ///< of its subtree, itself included; of a part: set by who builds it
    uint32_t prim_count = 0;   ///< of its leaves, likewise
    uint32_t node = 0;         ///< its place in the tree
    uint32_t below = 1;        ///< where the nodes below it begin
    uint32_t first_prim = 0;   ///< where the primitives of its leaves begin

    bool is_part() const { return left == kNoIndex; }
};

/// Appends the two children of a node that is split at `mid`.
void divide(std::vector<TopNode>& top, size_t parent, uint32_t mid);

/// Sets the counts of inner nodes and where all that is below a node stands: depth-first order, left before
/// right, children adjacent.
void place(std::span<TopNode> top);

/// Writes the inner nodes of the top from their children, which stand where `place` says.
void write_inner_nodes(std::span<const TopNode> top, std::span<Bvh2::Node> nodes);

/// body(index) for each part, in parallel.
template <class Body>
void for_each_part(std::span<const TopNode> top, const Task& task, const Body& body) {
    parallel_for(top.size(), 1, [&](size_t i, size_t) {
        if (top[i].is_part() && !task.stopped()) body(i);
    });
}

}  // namespace boxwood
