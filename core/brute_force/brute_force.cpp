#include "core/brute_force/brute_force.h"

namespace boxwood {

template <Mode mode, class Counter>
void BruteForce::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    for (const uint32_t prim : prims) closest.test(mesh.triangle(prim), prim, count);
}

template <Mode mode, class Counter>
bool BruteForce::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    for (const uint32_t prim : prims) {
        if (ray.occludes(mesh.triangle(prim), count)) return true;
    }
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
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void BruteForce::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool BruteForce::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
