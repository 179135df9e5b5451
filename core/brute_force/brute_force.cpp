#include "core/brute_force/brute_force.h"

#include <algorithm>

namespace boxwood {

namespace {

/// Primitives between two looks at a stop: well below a millisecond.
constexpr size_t kBlock = 4096;

std::span<const uint32_t> block_at(std::span<const uint32_t> prims, size_t begin) {
    return prims.subspan(begin, std::min(kBlock, prims.size() - begin));
}

}  // namespace

template <Mode mode, class Counter>
void BruteForce::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    for (size_t begin = 0; begin < prims.size() && !closest.stopped(); begin += kBlock)
        for (const uint32_t prim : block_at(prims, begin)) closest.test(mesh.triangle(prim), prim, count);
}

template <Mode mode, class Counter>
bool BruteForce::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    for (size_t begin = 0; begin < prims.size() && !ray.stopped(); begin += kBlock)
        for (const uint32_t prim : block_at(prims, begin))
            if (ray.occludes(mesh.triangle(prim), count)) return true;
    return false;
}

NodeList BruteForce::list_nodes() const {
    NodeList list;
    if (prims.empty()) return list;
    NodeView root;
    root.bounds = bounds;
    root.ref_count = static_cast<uint32_t>(prims.size());
    list.nodes.push_back(root);
    list.ref_prims = prims;
    return list;
}

BruteForce BruteForceBuilder::build(const Mesh&, std::span<const PrimRef> refs, Task&) const {
    BruteForce result;
    result.prims.reserve(refs.size());
    for (const PrimRef& ref : refs) {
        result.bounds.extend(ref.bounds);
        // The references of one primitive are adjacent, primitives ascend.
        if (result.prims.empty() || result.prims.back() != ref.prim) result.prims.push_back(ref.prim);
    }
    return result;
}

template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
