#pragma once

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Unit normal of the triangle's plane, on the side that `direction` comes from; -direction (a unit vector)
/// for a triangle without area. In double no float triangle over- or underflows.
DVec3 facing_normal(const Triangle& triangle, const DVec3& direction);

/// Ray in `direction` from the hit point, moved along `normal` (facing_normal of the triangle that was hit)
/// so far that it starts strictly on that side of the plane: a convex surface is not hit again.
///
/// u = 2^-24. t is off by u|t|, so the point by u|step| along each axis, the ray's origin rounds by u|point|
/// for each; along the normal, whose components' magnitudes sum to at most sqrt(3), that is less than
/// 1.74u (|step| + |point|) with the largest components. The origin is moved by 4u times that, which leaves
/// room for what double rounds.
Ray leaving_ray(const Ray& ray, const Hit& hit, const DVec3& normal, const DVec3& direction);

}  // namespace boxwood
