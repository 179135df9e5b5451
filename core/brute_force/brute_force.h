#pragma once

#include "core/structure/method.h"

namespace boxwood {

/// No structure: every ray tests every primitive. Lecture (Kerbl), "Structure: none".
struct BruteForce {
    static constexpr const char* kFamily = "list";

    Box bounds;
    std::vector<uint32_t> prims;  ///< each referenced primitive once, ascending

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const { return prims.size() * sizeof(uint32_t); }
};

struct BruteForceBuilder {
    void describe(ParamVisitor&) {}
    BruteForce build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
