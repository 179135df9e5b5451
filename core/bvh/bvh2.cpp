#include "core/bvh/bvh2.h"

#include "core/bvh/front_to_back.h"

namespace boxwood {

namespace {

/// Visits leaves front to back as long as visit_leaf(leaf) is true.
template <Mode mode, class Counter, class VisitLeaf>
void traverse(const Bvh2& bvh, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    const std::span<const Bvh2::Node> nodes = bvh.nodes;
    if (nodes.empty()) return;
    ray.enter_scene(nodes[0].lower, nodes[0].upper);
    visit_front_to_back(
        nodes, ray, count, [](const Bvh2::Node& node) { return node.is_leaf(); },
        [&ray, nodes](uint32_t node, double& entry) {
            return ray.meets(nodes[node].lower, nodes[node].upper, entry);
        },
        [&](uint32_t leaf) { return visit_leaf(nodes[leaf]); });
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

NodeList list_bvh_nodes(std::span<const Bvh2::Node> nodes, std::span<const uint32_t> prims) {
    NodeList list;
    list.nodes.resize(nodes.size());
    list.ref_prims.assign(prims.begin(), prims.end());
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const Bvh2::Node& node = nodes[i];
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

NodeList Bvh2::list_nodes() const { return list_bvh_nodes(nodes, prims); }

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
