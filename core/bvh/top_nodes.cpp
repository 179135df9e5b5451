#include "core/bvh/top_nodes.h"

namespace boxwood {

void divide(std::vector<TopNode>& top, size_t parent, uint32_t mid) {
    const RefRange range = top[parent].range;
    const uint32_t depth = top[parent].depth + 1;
    top[parent].left = static_cast<uint32_t>(top.size());
    top.push_back({{range.begin, mid}, depth});
    top.push_back({{mid, range.end}, depth});
}

void place(std::span<TopNode> top) {
    for (size_t i = top.size(); i-- > 0;) {
        TopNode& node = top[i];
        if (node.is_part()) continue;
        node.node_count = 1 + top[node.left].node_count + top[node.left + 1].node_count;
        node.prim_count = top[node.left].prim_count + top[node.left + 1].prim_count;
    }
    for (const TopNode& parent : top) {
        if (parent.is_part()) continue;
        TopNode& left = top[parent.left];
        TopNode& right = top[parent.left + 1];
        left.node = parent.below;
        right.node = parent.below + 1;
        left.below = parent.below + 2;
        right.below = left.below + left.node_count - 1;
        left.first_prim = parent.first_prim;
        right.first_prim = left.first_prim + left.prim_count;
    }
}

void write_inner_nodes(std::span<const TopNode> top, std::span<Bvh2::Node> nodes) {
    for (size_t i = top.size(); i-- > 0;) {
        if (top[i].is_part()) continue;
        const uint32_t left = top[top[i].left].node;
        const Bvh2::Node &a = nodes[left], &b = nodes[left + 1];
        nodes[top[i].node] = {glm::min(a.lower, b.lower), left, glm::max(a.upper, b.upper), 0};
    }
}

}  // namespace boxwood
