#pragma once

#include <functional>

#include "core/refs/prim_ref.h"

namespace boxwood {

inline constexpr size_t kFreeReferences = size_t{1} << 18;
inline constexpr size_t kMaxReferences = size_t{1}
                                         << 31;  ///< what 32-bit indices of nodes and references hold

/// Gets the box of one piece; false: no more are wanted.
using EmitBox = std::function<bool(const Box&)>;

/// A way to cut triangles into pieces until a measure of each piece is at most a limit.
struct SubdivisionRule {
    double limit;    ///< as asked for, 0 or more
    double largest;  ///< the measure of the scene's box: with this limit nothing is cut
    double growth;   ///< pieces of a triangle grow about with (measure / limit)^growth; only saves time
    /// The measure of a whole triangle. At most the limit: the triangle is tight and stays one reference.
    std::function<double(const Triangle&)> measure;
    /// Emits the boxes of the pieces, one or more, whose union contains the triangle; the same ones, in the
    /// same order, each time. Returns when emit has returned false.
    std::function<void(const Triangle&, double limit, const EmitBox& emit)> cut;
};

/// What bounds memory and time: of the whole scene at most the larger of both, and of kMaxReferences.
struct ReferenceBudget {
    int per_triangle = 8;               ///< times the triangles of the scene
    size_t at_least = kFreeReferences;  ///< what a small scene may have in any case
};

/// References by a rule: a pass that counts, one allocation, a pass that fills in what was counted. Triangles
/// that stay one reference are not looked at twice: their box comes from their corners.
/// Dammertz, Keller 2008, section 2.3.
///
/// A limit that needs more references than the budget has is doubled as often as it takes. Counted in
/// task.skipped: "tight" triangles, and "over the reference budget" those that are not tight where the limit
/// had to be doubled. The result does not depend on the number of threads.
References subdivide(const Mesh& mesh, const SubdivisionRule& rule, const ReferenceBudget& budget,
                     Task& task);

}  // namespace boxwood
