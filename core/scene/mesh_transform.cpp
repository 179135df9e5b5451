#include "core/scene/mesh_transform.h"

#include <cmath>
#include <numbers>

#include "core/base/assert.h"
#include "core/base/parallel.h"

namespace boxwood {
namespace {

constexpr size_t kPositionGrain = 1 << 16;

}  // namespace

AffineMap rotation(double degrees, const DVec3& axis, const DVec3& center) {
    const double length = glm::length(axis);
    BOXWOOD_ASSERT(std::isfinite(length) && length > 0.0);
    const DVec3 a = axis / length;
    const double turn = std::remainder(degrees, 360.0);
    double c = std::cos(turn * (std::numbers::pi / 180.0));
    double s = std::sin(turn * (std::numbers::pi / 180.0));
    if (std::remainder(turn, 90.0) == 0.0) {
        c = std::round(c);
        s = std::round(s);
    }
    // Rodrigues: v c + (a x v) s + a (a . v) (1 - c); glm's matrices are columns.
    const double d = 1.0 - c;
    AffineMap map;
    map.center = center;
    map.linear = glm::dmat3(DVec3(c + a.x * a.x * d, a.y * a.x * d + a.z * s, a.z * a.x * d - a.y * s),
                            DVec3(a.x * a.y * d - a.z * s, c + a.y * a.y * d, a.z * a.y * d + a.x * s),
                            DVec3(a.x * a.z * d + a.y * s, a.y * a.z * d - a.x * s, c + a.z * a.z * d));
    return map;
}

void transform(Mesh& mesh, const AffineMap& map) {
    const auto move_all = [&](std::span<Vec3> positions) {
        parallel_for(positions.size(), kPositionGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) positions[i] = Vec3(map(DVec3(positions[i])));
        });
    };
    move_all(mesh.positions);
    move_all(mesh.points.positions);
    // A normal goes with the inverse transpose: the matrix of cofactors but for its length and sign.
    const glm::dmat3& m = map.linear;
    const DVec3 cofactors[] = {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
    const double sign = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    for (Vec3& normal : mesh.points.normals) {
        const DVec3 n = sign * (cofactors[0] * static_cast<double>(normal.x) +
                                cofactors[1] * static_cast<double>(normal.y) +
                                cofactors[2] * static_cast<double>(normal.z));
        const double length = glm::length(n);
        if (length > 0.0) normal = Vec3(n / length);
    }
}

void transform(Camera& camera, const AffineMap& map) {
    camera.eye = Vec3(map(DVec3(camera.eye)));
    camera.target = Vec3(map(DVec3(camera.target)));
    const DVec3 up = map.linear * DVec3(camera.up);
    if (glm::length(up) > 0.0) camera.up = Vec3(glm::normalize(up));
}

}  // namespace boxwood
