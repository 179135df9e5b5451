#pragma once

#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/base/vec.h"

namespace boxwood {

/// Cuts a polygon into corners.size() - 2 triangles (none for fewer than three corners) and appends them. A
/// convex polygon becomes a fan from its first corner whose fan has no triangle of zero area; a concave one
/// is cut by ears, so that the triangles cover what the outline encloses. Corners index `positions` and must
/// be in range; a polygon that is not planar is judged in its projection along the normal's largest axis.
/// Meisters, "Polygons Have Ears", American Mathematical Monthly 1975. Differs: the search for ears is
/// bounded; what is left after the bound (a polygon of many thousand dents, or one that crosses itself)
/// becomes a fan.
void cut_polygon(std::span<const Vec3> positions, std::span<const uint32_t> corners, Array<UVec3>& triangles);

}  // namespace boxwood
