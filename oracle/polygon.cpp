#include "oracle/polygon.h"

#include <algorithm>

namespace boxwood::oracle {

namespace {

using Polygon = std::vector<ExactPoint>;

mpq_class exact(float value) { return mpq_class(static_cast<double>(value)); }

Polygon polygon_of(const Triangle& triangle) {
    return {exact_point(triangle.a), exact_point(triangle.b), exact_point(triangle.c)};
}

ExactPoint difference(const ExactPoint& a, const ExactPoint& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

ExactPoint cross(const ExactPoint& a, const ExactPoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const ExactPoint& a, const ExactPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

bool is_zero(const ExactPoint& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0; }

/// 0 for points that are all the same, 1 for points of one line, otherwise 2; -1 for none.
int dimension(const Polygon& polygon) {
    if (polygon.empty()) return -1;
    ExactPoint line{};
    int result = 0;
    for (const ExactPoint& point : polygon) {
        const ExactPoint v = difference(point, polygon[0]);
        if (result == 0 && !is_zero(v)) {
            line = v;
            result = 1;
        } else if (result == 1 && !is_zero(cross(line, v))) {
            return 2;
        }
    }
    return result;
}

/// Whether boxes[first] and those behind it contain what of the polygon has its full dimension.
bool covers_from(std::span<const Box> boxes, const Polygon& polygon, int full_dimension) {
    if (dimension(polygon) < full_dimension) return true;
    if (boxes.empty()) return false;
    const Box& box = boxes[0];
    Polygon inside = polygon;
    std::vector<Polygon> outside;
    for (size_t axis = 0; axis < 3; ++axis) {
        for (const int sign : {-1, 1}) {
            const int k = static_cast<int>(axis);
            const mpq_class plane = exact(sign < 0 ? box.lower[k] : box.upper[k]);
            Polygon beyond = clip(inside, axis, plane, -sign);
            // What only touches the plane from inside has no full dimension beyond it, unless it lies in it.
            const bool is_beyond = std::any_of(beyond.begin(), beyond.end(), [&](const ExactPoint& p) {
                return sgn(sign * (p[axis] - plane)) > 0;
            });
            if (is_beyond) outside.push_back(std::move(beyond));
            inside = clip(inside, axis, plane, sign);
        }
    }
    const std::span<const Box> others = boxes.subspan(1);
    if (dimension(inside) < full_dimension) return covers_from(others, polygon, full_dimension);
    return std::all_of(outside.begin(), outside.end(),
                       [&](const Polygon& part) { return covers_from(others, part, full_dimension); });
}

}  // namespace

ExactPoint exact_point(const Vec3& p) { return {exact(p.x), exact(p.y), exact(p.z)}; }

std::vector<ExactPoint> clip(const std::vector<ExactPoint>& polygon, size_t axis, const mpq_class& plane,
                             int sign) {
    std::vector<ExactPoint> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const ExactPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const mpq_class p_side = sign * (p[axis] - plane), q_side = sign * (q[axis] - plane);
        if (p_side <= 0) kept.push_back(p);
        if ((p_side < 0 && q_side > 0) || (p_side > 0 && q_side < 0)) {
            const mpq_class f = p_side / (p_side - q_side);
            ExactPoint cut;
            for (size_t k = 0; k < 3; ++k) cut[k] = p[k] + f * (q[k] - p[k]);
            kept.push_back(cut);
        }
    }
    return kept;
}

std::vector<ExactPoint> clip(const Triangle& triangle, const Box& box) {
    Polygon polygon = polygon_of(triangle);
    for (int axis = 0; axis < 3; ++axis) {
        const size_t k = static_cast<size_t>(axis);
        polygon = clip(polygon, k, exact(box.lower[axis]), -1);
        polygon = clip(polygon, k, exact(box.upper[axis]), 1);
    }
    return polygon;
}

ExactPoint area_vector(const std::vector<ExactPoint>& polygon) {
    ExactPoint sum;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
        const ExactPoint part =
            cross(difference(polygon[i], polygon[0]), difference(polygon[i + 1], polygon[0]));
        for (size_t k = 0; k < 3; ++k) sum[k] += part[k];
    }
    return sum;
}

bool touches(const Triangle& triangle, const Box& box) {
    const Polygon corners = polygon_of(triangle);
    const ExactPoint lower = exact_point(box.lower), upper = exact_point(box.upper);
    const auto separates = [&](const ExactPoint& axis) {
        const mpq_class a = dot(axis, corners[0]), b = dot(axis, corners[1]), c = dot(axis, corners[2]);
        mpq_class box_least, box_most;
        for (size_t k = 0; k < 3; ++k) {
            const bool ascends = sgn(axis[k]) >= 0;
            box_least += axis[k] * (ascends ? lower[k] : upper[k]);
            box_most += axis[k] * (ascends ? upper[k] : lower[k]);
        }
        return (a < box_least && b < box_least && c < box_least) ||
               (a > box_most && b > box_most && c > box_most);
    };
    for (size_t k = 0; k < 3; ++k) {
        ExactPoint unit{};
        unit[k] = 1;
        if (separates(unit)) return false;
        for (size_t i = 0; i < 3; ++i)
            if (separates(cross(difference(corners[(i + 1) % 3], corners[i]), unit))) return false;
    }
    return !separates(cross(difference(corners[1], corners[0]), difference(corners[2], corners[0])));
}

bool covers(std::span<const Box> boxes, const Triangle& triangle) {
    const Polygon polygon = polygon_of(triangle);
    return covers_from(boxes, polygon, dimension(polygon));
}

}  // namespace boxwood::oracle
