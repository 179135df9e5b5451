#pragma once

#include "core/base/assert.h"
#include "core/bvh/bvh2.h"

namespace boxwood {

/// Visits the leaves of a binary hierarchy front to back as long as visit_leaf(node) is true; both functions
/// get the index of a node. `meets(node, entry)` says whether the ray may meet the node's volume where a hit
/// still counts, and gives a lower bound of the parameter at which it enters. Children are adjacent, the root
/// is node 0, at most Bvh2::kMaxDepth levels lie below it. Lecture (Kerbl), "BVH traversal": the closer child
/// first, the other one on a stack, to be visited if its entry is then still before the nearest hit.
template <class Node, Mode mode, class Counter, class IsLeaf, class Meets, class VisitLeaf>
void visit_front_to_back(std::span<const Node> nodes, const ClosestHit<mode>& ray, Counter& count,
                         const IsLeaf& is_leaf, const Meets& meets, VisitLeaf&& visit_leaf) {
    struct StackEntry {
        uint32_t node;
        double entry;
    };
    StackEntry stack[Bvh2::kMaxDepth];
    uint32_t size = 0;
    double entry;
    count.visit_node(0);
    if (!meets(0u, entry)) return;
    uint32_t node = 0;
    while (true) {
        if (is_leaf(nodes[node])) {
            if (!visit_leaf(node)) return;
        } else {
            const uint32_t left = nodes[node].first, right = left + 1;
            double left_entry, right_entry;
            count.visit_node(left);
            count.visit_node(right);
            const bool meets_left = meets(left, left_entry), meets_right = meets(right, right_entry);
            if (meets_left && meets_right) {
                BOXWOOD_ASSERT(size < Bvh2::kMaxDepth);
                const bool left_first = left_entry <= right_entry;
                stack[size++] = left_first ? StackEntry{right, right_entry} : StackEntry{left, left_entry};
                node = left_first ? left : right;
                continue;
            }
            if (meets_left || meets_right) {
                node = meets_left ? left : right;
                continue;
            }
        }
        do {
            if (size == 0) return;
            --size;
        } while (!ray.is_open(stack[size].entry));
        node = stack[size].node;
    }
}

}  // namespace boxwood
