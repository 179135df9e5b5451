#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"

namespace boxwood {

/// Top-down BVH, split in the middle of the box along its largest extent, references sorted by their centres.
/// Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; Ernst, Greiner 2007, section 3.2, Algorithm 2.
/// Differs: where all centres lie on one side, the other axes, then the middle of the centres' box, then the
/// halves by count are tried, so that recursion ends for every input.
struct SpatialMedian {
    int max_leaf_size = 4;  ///< a larger set is always split, 1 to 64

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
