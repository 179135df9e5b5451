#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"

namespace boxwood {

/// References in the order of the Morton curve; a node is split where the first bit changes in which its
/// codes differ. Lauterbach, Garland, Sengupta, Luebke, Manocha, "Fast BVH Construction on GPUs", Computer
/// Graphics Forum 28(2) (Eurographics 2009), section 3 (LBVH). Differs: a set of up to max_leaf_size is a
/// leaf; codes of 63 bits where 30 are equal; equal codes, and the nodes so deep that kMaxDepth could not be
/// kept, are halved by count.
struct Morton {
    int max_leaf_size = 4;  ///< a larger set is always split, 1 to 64

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
