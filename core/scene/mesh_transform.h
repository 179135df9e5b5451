#pragma once

#include "core/scene/camera.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// The affine map p -> center + linear * (p - center) + offset, in double.
struct AffineMap {
    glm::dmat3 linear{1.0};
    DVec3 center{0.0};
    DVec3 offset{0.0};

    DVec3 operator()(const DVec3& p) const { return center + linear * (p - center) + offset; }
};

/// Turns by `degrees` about the axis through `center`; exact for multiples of 90 degrees about a coordinate
/// axis, so that what is axis-aligned stays so. Precondition: a finite axis that is not zero.
AffineMap rotation(double degrees, const DVec3& axis, const DVec3& center);

/// Maps triangles and points, each coordinate rounded once; normals keep length 1. A coordinate too large
/// for a float becomes infinite: see check_mesh.
void transform(Mesh& mesh, const AffineMap& map);
void transform(Camera& camera, const AffineMap& map);

}  // namespace boxwood
