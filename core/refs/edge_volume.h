#pragma once

#include "core/base/params.h"
#include "core/refs/prim_ref.h"
#include "core/refs/subdivision.h"

namespace boxwood {

/// Robust edge subdivision as references: a triangle with an edge whose box has a volume above V / 2^t, V the
/// volume of the scene's box, is cut in the middle of the edge with the largest one, again and again. The
/// pieces are not kept, only their boxes. Dammertz, Keller, "The Edge Volume Heuristic - Robust Triangle
/// Subdivision for Improved BVH Performance", IEEE/EG Symposium on Interactive Ray Tracing 2008, section 2.
/// A flat scene (V = 0) is not cut; nor is, by the paper's rule, a triangle whose edges all lie in axis
/// planes, although its own box may have a volume.
struct EdgeVolume {
    int t = 14;  ///< threshold V / 2^t, 0 to 40
    ReferenceBudget budget{};

    void describe(ParamVisitor& v) {
        v.on_int("t", t, 0, 40, "an edge is cut where its box exceeds the scene's volume / 2^t");
        v.on_int("budget", budget.per_triangle, 1, 1024,
                 "references at most, for each triangle of the scene");
    }
    References make(const Mesh& mesh, Task& task) const;
};

/// The threshold V / 2^t in cubic world units; 0 for a flat or empty box.
double edge_volume_threshold(const Box& scene_bounds, int t);

/// Volume of the largest of the boxes of the triangle's three edges, |dx dy dz| in double. The triangle is
/// cut where this is above the threshold and the scene is not flat.
double edge_volume(const Triangle& triangle);

}  // namespace boxwood
