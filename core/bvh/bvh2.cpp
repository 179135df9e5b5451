#include "core/bvh/bvh2.h"

#include "core/base/assert.h"

namespace boxwood {

namespace {

struct StackEntry {
    uint32_t node;
    double entry;
};

/// Visits leaves front to back as long as visit_leaf(leaf) is true.
template <Mode mode, class Counter, class VisitLeaf>
void traverse(const Bvh2& bvh, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    if (bvh.nodes.empty()) return;
    StackEntry stack[Bvh2::kMaxDepth];
    uint32_t size = 0;
    double entry;
    count.visit_node(0);
    ray.enter_scene(bvh.nodes[0].lower, bvh.nodes[0].upper);
    if (!ray.meets(bvh.nodes[0].lower, bvh.nodes[0].upper, entry)) return;
    uint32_t node = 0;
    while (true) {
        const Bvh2::Node& current = bvh.nodes[node];
        if (current.is_leaf()) {
            if (!visit_leaf(current)) return;
        } else {
            const uint32_t left = current.first, right = current.first + 1;
            double left_entry, right_entry;
            count.visit_node(left);
            count.visit_node(right);
            const bool meets_left = ray.meets(bvh.nodes[left].lower, bvh.nodes[left].upper, left_entry);
            const bool meets_right = ray.meets(bvh.nodes[right].lower, bvh.nodes[right].upper, right_entry);
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

}  // namespace

template <Mode mode, class Counter>
void Bvh2::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            closest.test(mesh.triangle(prims[i]), prims[i], count);
        }
        return true;
    });
}

template <Mode mode, class Counter>
bool Bvh2::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count && !is_hit; ++i) {
            is_hit = ray.occludes(mesh.triangle(prims[i]), count);
        }
        return !is_hit;
    });
    return is_hit;
}

NodeList Bvh2::list_nodes() const {
    NodeList list;
    list.nodes.resize(nodes.size());
    list.ref_prims = prims;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        NodeView& view = list.nodes[i];
        view.bounds = {node.lower, node.upper};
        view.kind = node.is_leaf() ? NodeKind::Leaf : NodeKind::Inner;
        if (node.is_leaf()) {
            view.first_ref = node.first;
            view.ref_count = node.count;
            continue;
        }
        for (const uint32_t child : {node.first, node.first + 1}) {
            list.nodes[child].parent = i;
            list.nodes[child].level = view.level + 1;
        }
    }
    return list;
}

template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void Bvh2::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool Bvh2::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool Bvh2::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool Bvh2::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool Bvh2::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
