#include "core/measure/area_inside.h"

#include <array>

namespace boxwood {
namespace {

/// A convex polygon: a triangle cut by six planes has at most nine corners.
struct Polygon {
    std::array<DVec3, 10> corners;
    size_t count = 0;

    void add(const DVec3& corner) { corners[count++] = corner; }
};

double area_of(const Polygon& polygon) {
    DVec3 sum(0.0);
    for (size_t i = 2; i < polygon.count; ++i)
        sum +=
            glm::cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
    return 0.5 * glm::length(sum);
}

/// What remains on the side where sign * (x[axis] - plane) >= 0.
Polygon cut(const Polygon& polygon, int axis, double plane, double sign) {
    Polygon part;
    for (size_t i = 0; i < polygon.count; ++i) {
        const DVec3& from = polygon.corners[i];
        const DVec3& to = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        const double a = sign * (from[axis] - plane), b = sign * (to[axis] - plane);
        if (a >= 0.0) part.add(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) {
            DVec3 crossing = from + (a / (a - b)) * (to - from);
            crossing[axis] = plane;
            part.add(crossing);
        }
    }
    return part;
}

}  // namespace

double area_of(const Triangle& triangle) {
    const DVec3 a(triangle.a);
    return 0.5 * glm::length(glm::cross(DVec3(triangle.b) - a, DVec3(triangle.c) - a));
}

double area_inside(const Triangle& triangle, const Box& box) {
    const Box bounds = triangle.bounds();
    Polygon polygon;
    polygon.add(DVec3(triangle.a));
    polygon.add(DVec3(triangle.b));
    polygon.add(DVec3(triangle.c));
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = static_cast<double>(box.lower[axis]),
                     upper = static_cast<double>(box.upper[axis]);
        if (bounds.lower[axis] < box.lower[axis]) polygon = cut(polygon, axis, lower, 1.0);
        if (bounds.upper[axis] > box.upper[axis]) polygon = cut(polygon, axis, upper, -1.0);
        if (polygon.count < 3) return 0.0;
    }
    return area_of(polygon);
}

}  // namespace boxwood
