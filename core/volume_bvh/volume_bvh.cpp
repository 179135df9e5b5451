#include "core/volume_bvh/volume_bvh.h"

#include "core/bvh/front_to_back.h"
#include "core/volume_bvh/oriented_box.h"
#include "core/volume_bvh/sphere.h"

namespace boxwood {

namespace {

/// Visits leaves front to back as long as visit_leaf(leaf) is true.
template <class Volume, Mode mode, class Counter, class VisitLeaf>
void traverse(const VolumeBvh<Volume>& bvh, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    using Node = typename VolumeBvh<Volume>::Node;
    if (bvh.nodes.empty()) return;
    ray.enter_scene(bvh.bounds.lower, bvh.bounds.upper);
    const typename Volume::template Test<VolumeBounds> test(ray.ray(), ray.margin());
    const auto meets = [&](uint32_t node, double& entry) {
        double near, far;
        if (!test.meets(bvh.nodes[node].volume, near, far)) return false;
        entry = std::max(near, ray.slabs().t_min());
        return entry <= far && ray.is_open(entry);
    };
    visit_front_to_back(
        std::span<const Node>(bvh.nodes), ray, count, [](const Node& node) { return node.is_leaf(); }, meets,
        [&](uint32_t leaf) { return visit_leaf(bvh.nodes[leaf]); });
}

}  // namespace

template <class Volume>
template <Mode mode, class Counter>
void VolumeBvh<Volume>::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            closest.test(mesh.triangle(prims[i]), prims[i], count);
        return true;
    });
}

template <class Volume>
template <Mode mode, class Counter>
bool VolumeBvh<Volume>::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count && !is_hit; ++i)
            is_hit = ray.occludes(mesh.triangle(prims[i]), count);
        return !is_hit;
    });
    return is_hit;
}

template <class Volume>
NodeList VolumeBvh<Volume>::list_nodes() const {
    NodeList list;
    list.is_nested = false;
    list.nodes.resize(nodes.size());
    list.half_areas.resize(nodes.size());
    list.ref_prims.assign(prims.begin(), prims.end());
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        NodeView& view = list.nodes[i];
        view.bounds = node.volume.bounds();
        list.half_areas[i] = node.volume.half_area();
        node.volume.add_outline(i, nodes[0].volume, list.outlines);
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

template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void VolumeBvh<Sphere>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool VolumeBvh<Sphere>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool VolumeBvh<Sphere>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool VolumeBvh<Sphere>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool VolumeBvh<Sphere>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template NodeList VolumeBvh<Sphere>::list_nodes() const;

template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void VolumeBvh<OrientedBox>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool VolumeBvh<OrientedBox>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool VolumeBvh<OrientedBox>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool VolumeBvh<OrientedBox>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool VolumeBvh<OrientedBox>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template NodeList VolumeBvh<OrientedBox>::list_nodes() const;

}  // namespace boxwood
