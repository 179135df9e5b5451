#include "core/bsp/bsp_piece.h"

#include <algorithm>

namespace boxwood {

namespace {

/// What widening the hull by e adds to h.
double widening(const PlaneValue& value, const Triangle& triangle) {
    const Vec3 size = glm::max(glm::max(glm::abs(triangle.a), glm::abs(triangle.b)), glm::abs(triangle.c));
    return value.slope() * kPieceError * double(std::max({size.x, size.y, size.z}));
}

}  // namespace

BspSides sides_of(const BspPlane& plane, const PlaneValue& value, const Triangle& triangle,
                  std::span<const DVec3> polygon) {
    BspSides sides;
    for (const Vec3& vertex : {triangle.a, triangle.b, triangle.c}) {
        const int side = side_of(plane, value, vertex);
        sides.left = sides.left || side < 0;
        sides.right = sides.right || side > 0;
    }
    if (polygon.empty() || !sides.left || !sides.right) return sides;
    const double wider = widening(value, triangle);
    bool may_be_left = false, may_be_right = false;
    for (const DVec3& corner : polygon) {
        const double h = value.at(corner), tolerance = wider + value.error_at(corner);
        may_be_left = may_be_left || h <= tolerance;
        may_be_right = may_be_right || h >= -tolerance;
    }
    return {may_be_left, may_be_right};
}

void cut_piece(const PlaneValue& value, const Triangle& triangle, std::span<const DVec3> polygon, int side,
               std::vector<DVec3>& part) {
    const double sign = static_cast<double>(side);
    double error = 0.0;
    for (const DVec3& corner : polygon) error = std::max(error, value.error_at(corner));
    const double limit = 2.0 * (widening(value, triangle) + 2.0 * error);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const DVec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double h_p = sign * value.at(p), h_q = sign * value.at(q);
        if (h_p >= -limit) part.push_back(p);
        if ((h_p >= -limit) != (h_q >= -limit)) part.push_back(p + (-limit - h_p) / (h_q - h_p) * (q - p));
    }
}

}  // namespace boxwood
