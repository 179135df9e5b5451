#include "core/bvh/late_split_bvh.h"

#include "core/bvh/front_to_back.h"

namespace boxwood {

namespace {

/// Visits the deep leaves below an original leaf until the rest is dropped; false if visit_leaf was.
template <Mode mode, class Counter, class VisitLeaf>
bool visit_below(const LateSplitBvh& bvh, uint32_t original_leaf, ClosestHit<mode>& ray, Counter& count,
                 const VisitLeaf& visit_leaf) {
    struct StackEntry {
        uint32_t node;
        double entry;
        double beyond;
    };
    StackEntry stack[Bvh2::kMaxDepth];
    uint32_t size = 0;
    const std::span<const Bvh2::Node> nodes = bvh.nodes;
    const bool held_one = nodes[original_leaf].first < bvh.single_end;
    uint32_t node = original_leaf;
    // Lower bound of the parameters in all the cells on the stack. A wall that the ray runs in (NaN) is none:
    // what lies in it is in the nearer cell too.
    double beyond = std::numeric_limits<double>::infinity();
    while (true) {
        const Bvh2::Node& current = nodes[node];
        if (current.is_leaf()) {
            if (!visit_leaf(current)) return false;
            if (held_one || !ray.is_open(beyond)) return true;
        } else {
            const LateSplitPlane plane = late_split_plane({current.lower, current.upper});
            const uint32_t is_upper_near = ray.is_negative(plane.axis) ? 1 : 0;
            const uint32_t near = current.first + is_upper_near, far = current.first + 1 - is_upper_near;
            double near_entry, far_entry;
            count.visit_node(near);
            count.visit_node(far);
            const bool meets_near = ray.meets(nodes[near].lower, nodes[near].upper, near_entry);
            const bool meets_far = ray.meets(nodes[far].lower, nodes[far].upper, far_entry);
            if (meets_near && meets_far) {
                BOXWOOD_ASSERT(size < Bvh2::kMaxDepth);
                stack[size++] = {far, far_entry, beyond};
                const double wall = ray.slabs().near(plane.axis, static_cast<double>(plane.position));
                beyond = wall < beyond ? wall : beyond;
            }
            if (meets_near || meets_far) {
                node = meets_near ? near : far;
                continue;
            }
        }
        do {
            if (size == 0) return true;
            --size;
        } while (!ray.is_open(stack[size].entry));
        node = stack[size].node;
        beyond = stack[size].beyond;
    }
}

/// Visits leaves, original and deep ones, as long as visit_leaf(leaf) is true.
template <Mode mode, class Counter, class VisitLeaf>
void traverse(const LateSplitBvh& bvh, ClosestHit<mode>& ray, Counter& count, const VisitLeaf& visit_leaf) {
    const std::span<const Bvh2::Node> nodes = bvh.nodes;
    if (nodes.empty()) return;
    ray.enter_scene(nodes[0].lower, nodes[0].upper);
    visit_front_to_back(
        nodes, ray, count, [&](const Bvh2::Node& node) { return bvh.is_original_leaf(node); },
        [&](uint32_t node, double& entry) { return ray.meets(nodes[node].lower, nodes[node].upper, entry); },
        [&](uint32_t node) { return visit_below(bvh, node, ray, count, visit_leaf); });
}

}  // namespace

template <Mode mode, class Counter>
void LateSplitBvh::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            closest.test(mesh.triangle(prims[i]), prims[i], count);
        return true;
    });
}

template <Mode mode, class Counter>
bool LateSplitBvh::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count && !is_hit; ++i)
            is_hit = ray.occludes(mesh.triangle(prims[i]), count);
        return !is_hit;
    });
    return is_hit;
}

NodeList LateSplitBvh::list_nodes() const { return list_bvh_nodes(nodes, prims); }

template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void LateSplitBvh::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool LateSplitBvh::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool LateSplitBvh::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool LateSplitBvh::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool LateSplitBvh::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
