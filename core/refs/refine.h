#pragma once

#include "core/base/params.h"
#include "core/refs/prim_ref.h"
#include "core/refs/subdivision.h"

namespace boxwood {

/// Geometry refinement as references: a triangle is cut into four by the middles of its edges, its pieces
/// likewise, a number of rounds or until no edge of a piece is longer than a fraction of the diagonal of the
/// scene's box; each piece's box becomes a reference. Ernst, Greiner, "Early Split Clipping for Bounding
/// Volume Hierarchies", IEEE/EG Symposium on Interactive Ray Tracing 2007, section 4. Differs: the pieces are
/// not kept, only their boxes, so that the mesh stays as it is.
///
/// A piece's corners are exact fractions of its triangle's, and its box contains the exact piece, so the
/// union of the boxes contains the triangle.
struct Refinement {
    int rounds = 1;     ///< one-to-four cuts of every triangle, 0 to kMostRounds
    float edge = 0.0f;  ///< above 0: cut where an edge exceeds the scene's diagonal / 2^edge, 0 to 20
    ReferenceBudget budget{};

    static constexpr int kMostRounds = 15;  ///< 4^15 pieces of one triangle

    void describe(ParamVisitor& v) {
        v.on_int("rounds", rounds, 0, kMostRounds,
                 "one-to-four cuts of every triangle, where no edge is given");
        v.on_float("edge", edge, 0.0f, 20.0f,
                   "cut where an edge is longer than the scene's diagonal / 2^edge; 0: by rounds");
        v.on_int("budget", budget.per_triangle, 1, 1024,
                 "references at most, for each triangle of the scene");
    }
    References make(const Mesh& mesh, Task& task) const;
};

}  // namespace boxwood
