#pragma once

#include <vector>

#include "core/bvh/bvh2.h"

namespace boxwood {

/// A node of a tree that a test writes down: a leaf with primitives, or two children.
struct HandMadeNode {
    Box box;
    std::vector<uint32_t> prims;
    std::vector<HandMadeNode> children;
};

inline void write_node(const HandMadeNode& from, uint32_t node, Bvh2& bvh) {
    bvh.nodes[node] = {from.box.lower, static_cast<uint32_t>(bvh.prims.size()), from.box.upper,
                       static_cast<uint32_t>(from.prims.size())};
    bvh.prims.insert(bvh.prims.end(), from.prims.begin(), from.prims.end());
    if (from.children.empty()) return;
    const auto left = static_cast<uint32_t>(bvh.nodes.size());
    bvh.nodes[node].first = left;
    bvh.nodes.resize(left + 2);
    write_node(from.children[0], left, bvh);
    write_node(from.children[1], left + 1, bvh);
}

inline Bvh2 hand_made_bvh(const HandMadeNode& root) {
    Bvh2 bvh;
    bvh.nodes.resize(1);
    write_node(root, 0, bvh);
    return bvh;
}

}  // namespace boxwood
