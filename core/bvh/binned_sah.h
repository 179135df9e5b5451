#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Top-down BVH builder with binned surface area cost.
/// Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007, section 3.
/// Differs: all three axes are binned in one pass; where all centres fall into one bin the halves by count
/// are taken.
struct BinnedSah {
    int bin_count = 16;                     ///< bins per axis, 2 to 256
    int max_leaf_size = 8;                  ///< a larger set is always split, 1 to 64
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16

    void describe(ParamVisitor& v) {
        v.on_int("bins", bin_count, 2, 256, "bins per axis");
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
