#pragma once

#include <cmath>
#include <optional>

#include "core/scene/mesh.h"

namespace boxwood {

/// Plane perpendicular to an axis, or through three points; the points are floats, so that the side of a
/// vertex is decided without error.
struct BspPlane {
    int axis = -1;          ///< 0 to 2; -1: through `points`
    float position = 0.0f;  ///< on the axis
    Triangle points{};      ///< not on one line

    static BspPlane across(int axis, float position) { return {axis, position, {}}; }
    static BspPlane through(const Triangle& points) { return {-1, 0.0f, points}; }
};

/// The plane through edge `from`-`to` of a triangle that is perpendicular to it, but for the rounding of its
/// third point; it holds both ends exactly. Nothing if the points are on one line.
std::optional<BspPlane> plane_on_edge(const Vec3& from, const Vec3& to, const Vec3& opposite);

/// h(x) = n.(x - a) of a plane in double, and what it may be off by. Its sign is the side.
///
/// n = (b - a) x (c - a). With u = 2^-53, each monomial of h carries 3 roundings of differences, 2 of
/// products, 1 of the difference in n and 2 of the sum: 8u times the sum of absolute monomials; for a
/// direction, which is no difference, 7u. kUnit has room for what is of second order, and for the rounding of
/// one sum or difference of the value with its error. An axis plane has n = 1 along it and no products.
class PlaneValue {
public:
    static constexpr double kUnit = 9.0 * 0x1p-53 * (1.0 + 0x1p-30);

    explicit PlaneValue(const BspPlane& plane);

    double at(const DVec3& point) const { return glm::dot(point - origin_, normal_); }
    double along(const DVec3& direction) const { return glm::dot(direction, normal_); }
    double error_at(const DVec3& point) const {
        return kUnit * glm::dot(glm::abs(point - origin_), normal_abs_);
    }
    /// At least error_at of every point whose coordinates are at most `reach` in magnitude.
    double error_within(double reach) const {
        return kUnit * glm::dot(reach + glm::abs(origin_), normal_abs_) * (1.0 + kUnit);
    }
    double error_along(const DVec3& direction) const {
        return kUnit * glm::dot(glm::abs(direction), normal_abs_);
    }
    /// At least the sum of |n_i|: h changes by at most that times the largest change of a coordinate.
    double slope() const { return slope_; }
    const DVec3& normal() const { return normal_; }

private:
    DVec3 origin_, normal_;
    DVec3 normal_abs_;  ///< sums of the absolute products in n
    double slope_;
};

/// Side of a point, without error: -1 left (on an axis: below), 0 in the plane, 1 right. `value` is the
/// plane's.
int side_of(const BspPlane& plane, const PlaneValue& value, const Vec3& point);
}  // namespace boxwood
