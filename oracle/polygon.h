#pragma once

#include <gmpxx.h>

#include <array>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/scene/mesh.h"

namespace boxwood::oracle {

/// A point with rational coordinates, by axis.
using ExactPoint = std::array<mpq_class, 3>;

ExactPoint exact_point(const Vec3& p);

/// The closed part of a convex polygon with sign * (x - plane) <= 0 on the axis (0 to 2), without error; its
/// corners in order, some perhaps twice; empty if nothing is left.
std::vector<ExactPoint> clip(const std::vector<ExactPoint>& polygon, size_t axis, const mpq_class& plane,
                             int sign);

/// The part of a triangle inside a closed box, without error; empty if they have no point in common.
std::vector<ExactPoint> clip(const Triangle& triangle, const Box& box);

/// Twice the area of a planar polygon, as a vector: linear, so that areas of parts add up without error.
ExactPoint area_vector(const std::vector<ExactPoint>& polygon);

/// Whether a closed triangle and a closed box have a point in common; also for triangles and boxes without
/// area. By separating axes: the three of the box, the triangle's normal, and the nine products of their
/// edges. Akenine-Moeller, "Fast 3D Triangle-Box Overlap Testing", journal of graphics tools 6(1), 2001.
bool touches(const Triangle& triangle, const Box& box);

/// Whether the union of the closed boxes contains the closed triangle: each box is cut out of what is left
/// of it. What a union of closed boxes leaves is open in the triangle, so it is either nothing or has a
/// positive area (for a triangle that is a segment: length).
bool covers(std::span<const Box> boxes, const Triangle& triangle);

}  // namespace boxwood::oracle
