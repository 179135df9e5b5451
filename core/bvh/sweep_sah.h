#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Top-down BVH builder that weighs every split between two centres, on all three axes, by surface area cost.
/// Sorted once per axis, then kept in order: O(N log N). Wald, Boulos, Shirley, "Ray Tracing Deformable
/// Scenes Using Dynamic Bounding Volume Hierarchies", ACM TOG 26(1), 2007, section 4; lecture (Kerbl), "SAH
/// sweep".
struct SweepSah {
    int max_leaf_size = 8;                  ///< a larger set is always split, 1 to 64
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
