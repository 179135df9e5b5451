#include "core/bsp/bsp_plane.h"

#include <algorithm>

#include "core/base/exact_sum.h"

namespace boxwood {

namespace {

/// (b - a) x (c - a) . (p - a), without error.
int exact_side(const Triangle& t, const Vec3& p) {
    ExactSum volume;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        ExactSum area;
        area.add_product(ExactDifference(t.b[u], t.a[u]), ExactDifference(t.c[v], t.a[v]));
        area.add_product(ExactDifference(t.b[v], t.a[v]), ExactDifference(t.a[u], t.c[u]));
        volume.add_product(area, ExactDifference(p[axis], t.a[axis]));
    }
    return volume.sign();
}

}  // namespace

PlaneValue::PlaneValue(const BspPlane& plane) {
    if (plane.axis >= 0) {
        origin_ = normal_ = DVec3(0.0);
        origin_[plane.axis] = double(plane.position);
        normal_[plane.axis] = 1.0;
        normal_abs_ = normal_;
    } else {
        origin_ = DVec3(plane.points.a);
        const DVec3 e = DVec3(plane.points.b) - origin_, f = DVec3(plane.points.c) - origin_;
        normal_ = glm::cross(e, f);
        normal_abs_ =
            DVec3(std::abs(e.y * f.z) + std::abs(e.z * f.y), std::abs(e.z * f.x) + std::abs(e.x * f.z),
                  std::abs(e.x * f.y) + std::abs(e.y * f.x));
    }
    const DVec3 size = glm::abs(normal_) + kUnit * normal_abs_;
    slope_ = (size.x + size.y + size.z) * (1.0 + kUnit);
}

int side_of(const BspPlane& plane, const PlaneValue& value, const Vec3& point) {
    if (plane.axis >= 0) {
        const float x = point[plane.axis];
        return x < plane.position ? -1 : x > plane.position ? 1 : 0;
    }
    const double h = value.at(DVec3(point)), error = value.error_at(DVec3(point));
    if (std::abs(h) > error) return h > 0.0 ? 1 : -1;
    // Without an error every monomial is 0: none is so small that it vanishes, as factors are at least
    // 2^-149.
    return error == 0.0 ? 0 : exact_side(plane.points, point);
}

std::optional<BspPlane> plane_on_edge(const Vec3& from, const Vec3& to, const Vec3& opposite) {
    const DVec3 edge = DVec3(to) - DVec3(from), other = DVec3(opposite) - DVec3(from);
    const DVec3 normal = glm::cross(edge, other);
    const DVec3 size = glm::abs(normal);
    const double largest = std::max({size.x, size.y, size.z});
    if (!(largest > 0.0)) return std::nullopt;
    // As far from the edge as that is long.
    const DVec3 edge_size = glm::abs(edge);
    const double length = std::max({edge_size.x, edge_size.y, edge_size.z});
    const Vec3 third(DVec3(from) + normal * (length / largest));
    if (!(std::isfinite(third.x) && std::isfinite(third.y) && std::isfinite(third.z))) return std::nullopt;
    const BspPlane plane = BspPlane::through({from, to, third});
    const PlaneValue value(plane);
    const DVec3 n = glm::abs(value.normal());
    // Also far from one line: what is divided by such a plane is divided in a place that means something.
    if (!(std::max({n.x, n.y, n.z}) > 0.5 * length * length)) return std::nullopt;
    return plane;
}

}  // namespace boxwood
