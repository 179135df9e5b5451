#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"

namespace boxwood {

/// Top-down BVH, split into halves by count: the references whose centres come first on one axis go left.
/// The axes take turns from level to level. Lecture (Kerbl), "Splitting at object median"; the halves are
/// found by std::nth_element, as its notes on implementation advise. Equal centres are ordered by primitive,
/// then by box, so the halves are the same for every input order. The depth is at most ceil(log2 references).
struct ObjectMedian {
    int max_leaf_size = 4;  ///< a larger set is always split, 1 to 64

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
