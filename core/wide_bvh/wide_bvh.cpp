#include "core/wide_bvh/wide_bvh.h"

#include "core/base/assert.h"

namespace boxwood {

namespace {

struct StackEntry {
    uint32_t child;  ///< the bits of a WideChild
    double entry;    ///< lower bound of the parameter at which the ray enters its box
};

/// What of a hierarchy is still to be visited. A node takes one entry off and puts at most Width on.
template <uint32_t Width>
class Stack {
public:
    void push(WideChild child, double entry) {
        BOXWOOD_ASSERT(size_ < kMostEntries);
        entries_[size_++] = {child.bits, entry};
    }
    /// The next child that may hold a hit which still counts; an empty one if there is none.
    template <Mode mode>
    WideChild pop(const ClosestHit<mode>& ray) {
        while (size_ > 0)
            if (ray.is_open(entries_[--size_].entry)) return {entries_[size_].child};
        return {};
    }

private:
    static constexpr uint32_t kMostEntries = (Width - 1) * (WideBvh<Width>::kMaxDepth + 1) + 1;
    StackEntry entries_[kMostEntries];
    uint32_t size_ = 0;
};

/// Counts a visit of every child: the box of each is tested.
template <uint32_t Width, class Counter>
void count_children(const WideBvh<Width>& bvh, const typename WideBvh<Width>::Node& node, Counter& count) {
    if constexpr (Counter::kCounts) {
        uint32_t leaf = static_cast<uint32_t>(bvh.nodes.size()) + node.first_leaf;
        for (const WideChild child : node.children)
            if (!child.is_empty()) count.visit_node(child.is_leaf() ? leaf++ : child.node());
    }
}

/// Visits leaves front to back as long as visit_leaf(packs) is true.
template <uint32_t Width, Mode mode, class Counter, class VisitLeaf>
void traverse(const WideBvh<Width>& bvh, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    if (bvh.nodes.empty()) return;
    const Box scene = bvh.nodes[0].bounds();
    ray.enter_scene(scene.lower, scene.upper);
    const uint32_t octant =
        (ray.is_negative(0) ? 1u : 0u) | (ray.is_negative(1) ? 2u : 0u) | (ray.is_negative(2) ? 4u : 0u);
    Stack<Width> stack;
    count.visit_node(0);
    for (WideChild next = WideChild::inner(0); !next.is_empty(); next = stack.pop(ray)) {
        if (next.is_leaf()) {
            if (!visit_leaf(std::span(bvh.packs).subspan(next.first_pack(), next.pack_count()))) return;
            continue;
        }
        const typename WideBvh<Width>::Node& node = bvh.nodes[next.node()];
        count_children(bvh, node, count);
        for (uint32_t rank = Width; rank-- > 0;) {
            const uint32_t lane = node.lane_at(octant, rank);
            if (node.children[lane].is_empty()) continue;
            const Box box = node.bounds(lane);
            double entry;
            if (ray.meets(box.lower, box.upper, entry)) stack.push(node.children[lane], entry);
        }
    }
}

}  // namespace

template <uint32_t Width>
template <Mode mode, class Counter>
void WideBvh<Width>::closest_hit(const Mesh&, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](std::span<const Pack> leaf) {
        for (const Pack& pack : leaf)
            for (uint32_t lane = 0; lane < pack.count(); ++lane)
                closest.test(pack.triangle(lane), pack.prims[lane], count);
        return true;
    });
}

template <uint32_t Width>
template <Mode mode, class Counter>
bool WideBvh<Width>::any_hit(const Mesh&, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](std::span<const Pack> leaf) {
        for (const Pack& pack : leaf)
            for (uint32_t lane = 0; lane < pack.count() && !is_hit; ++lane)
                is_hit = ray.occludes(pack.triangle(lane), count);
        return !is_hit;
    });
    return is_hit;
}

template <uint32_t Width>
NodeList WideBvh<Width>::list_nodes() const {
    NodeList list;
    if (nodes.empty()) return list;
    list.nodes.resize(nodes.size() + leaf_count);
    list.nodes[0].bounds = nodes[0].bounds();
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        list.nodes[i].kind = NodeKind::Inner;
        uint32_t leaf = static_cast<uint32_t>(nodes.size()) + nodes[i].first_leaf;
        for (uint32_t lane = 0; lane < Width; ++lane) {
            const WideChild child = nodes[i].children[lane];
            if (child.is_empty()) continue;
            NodeView& view = list.nodes[child.is_leaf() ? leaf++ : child.node()];
            view.bounds = nodes[i].bounds(lane);
            view.parent = i;
            view.level = list.nodes[i].level + 1;
            if (!child.is_leaf()) continue;
            view.first_ref = static_cast<uint32_t>(list.ref_prims.size());
            for (uint32_t p = 0; p < child.pack_count(); ++p) {
                const Pack& pack = packs[child.first_pack() + p];
                list.ref_prims.insert(list.ref_prims.end(), pack.prims, pack.prims + pack.count());
            }
            view.ref_count = static_cast<uint32_t>(list.ref_prims.size()) - view.first_ref;
        }
    }
    return list;
}

template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void WideBvh<4>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool WideBvh<4>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool WideBvh<4>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool WideBvh<4>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool WideBvh<4>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template NodeList WideBvh<4>::list_nodes() const;

template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void WideBvh<8>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool WideBvh<8>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool WideBvh<8>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool WideBvh<8>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool WideBvh<8>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template NodeList WideBvh<8>::list_nodes() const;

template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void WideBvh<16>::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool WideBvh<16>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool WideBvh<16>::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool WideBvh<16>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool WideBvh<16>::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template NodeList WideBvh<16>::list_nodes() const;

}  // namespace boxwood
