#pragma once

#include "core/bvh/late_split_bvh.h"
#include "core/structure/method.h"

namespace boxwood {

/// Below the leaves of a binary BVH, boxes with a surface area above SA_max are cut in the middle of their
/// longest axis, and their primitives clipped, until none is larger. Ernst, Greiner, "Early Split Clipping
/// for Bounding Volume Hierarchies", IEEE/EG Symposium on Interactive Ray Tracing 2007, section 5.1. The
/// parts are always those of the original triangles; a triangle that touches a cut is on both sides of it.
///
/// The references are bounded: each leaf gets a share of what the budget leaves, in the ratio of its
/// primitives times its area, and its largest boxes are cut first. So no leaf waits for another, and the
/// result does not depend on the number of threads. Counted in task.skipped: leaves that are "tight", and
/// boxes that the budget left above SA_max, "over the reference budget".
struct LateSplitClipping {
    using Input = Bvh2;
    using Output = LateSplitBvh;

    AreaLimit limit;  ///< SA_max: `s` as the root box's area / 2^s, or `sa` in square world units
    int budget = 2;   ///< references at most, times those of the original tree, 1 to 1024

    void describe(ParamVisitor& v) {
        v.on_area_limit("s", "sa", limit,
                        "a leaf is cut where its area exceeds the root box's / 2^s (or sa)");
        v.on_int("budget", budget, 1, 1024, "references at most, times those of the tree that is cut");
    }
    LateSplitBvh apply(const Mesh& mesh, std::span<const PrimRef> refs, const Bvh2& input, Task& task) const;
};

}  // namespace boxwood
