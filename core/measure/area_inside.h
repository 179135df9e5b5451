#pragma once

#include "core/base/box.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Area of the triangle in square world units; no overflow for floats of any size.
double area_of(const Triangle& triangle);

/// Area of the part of the triangle inside the closed box: the whole of a triangle in a wall of the box, or
/// in a flat box, counts. In double, within some units in the last place of the triangle's area; 0 where they
/// do no more than touch.
///
/// Sutherland, Hodgman, "Reentrant Polygon Clipping", CACM 1974.
double area_inside(const Triangle& triangle, const Box& box);

}  // namespace boxwood
