#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"

namespace boxwood {

/// Top-down BVH, split in the middle of the box along its largest extent, references sorted by their centres.
/// Kay, Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986; Ernst, Greiner 2007, section 3.2, Algorithm 2;
/// lecture (Kerbl), "Splitting at spatial median".
///
/// All centres can lie on one side. The lecture's guards against endless recursion, in this order: the other
/// axes of the box, by descending extent; the box of the centres in place of the references' box, likewise;
/// and a limit on the number of such attempts, beyond which the halves by count are taken. So recursion ends
/// for every input.
struct SpatialMedian {
    int max_leaf_size = 4;    ///< a larger set is always split, 1 to 64
    int attempts = 6;         ///< middles that are tried, 1 to 6: three of the box, three of the centres' box
    bool of_centers = false;  ///< the centres' box is split from the start: three attempts are all there are

    void describe(ParamVisitor& v) {
        v.on_int("max-leaf-size", max_leaf_size, 1, 64, "a larger set is always split");
        v.on_int("attempts", attempts, 1, 6,
                 "middles tried before a node is halved by count: the box's axes, then the centres'");
        v.on_bool("of-centers", of_centers, "split the box of the centres from the start");
    }
    Bvh2 build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
