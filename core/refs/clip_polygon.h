#pragma once

#include "core/base/box.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// The smallest box of floats that contains the part of the triangle inside the closed `box`; empty if they
/// have no point in common. No face lies inside the exact part's box, none lies a whole ulp outside it, and
/// faces of `box` that cut the triangle come back bit for bit. The result does not depend on the order of the
/// corners. Finite floats only; holds for every size and offset, for triangles without area too.
///
/// Sutherland, Hodgman, "Reentrant Polygon Clipping", CACM 1974, for the task. Differs: no polygon is cut
/// plane by plane, whose errors would add up. Each corner of the part is computed from the triangle's own
/// corners and the box's own planes; what rounding leaves open is decided exactly.
///
/// `bound_scale` multiplies the bounds of rounding errors: for the test that shows that half of them is
/// wrong.
Box clip_bounds(const Triangle& triangle, const Box& box, double bound_scale = 1.0);

struct ClippedHalves {
    Box lower, upper;
};
/// clip_bounds on the two closed sides of the plane with this coordinate along `axis`, for a `part` that is
/// itself an answer of clip_bounds or clip_halves: half of the work is saved by what its box says of them.
/// The floats around the lesser of two numbers are the lesser of the floats around them, so a face of the
/// part's box is, bit for bit, that of one half or of both.
ClippedHalves clip_halves(const Triangle& triangle, const Box& part, int axis, float position);

}  // namespace boxwood
