#include "core/refs/triangle_touches_box.h"

#include <algorithm>
#include <cmath>

#include "core/refs/clip_polygon.h"

// Bounds of rounding errors. u = 2^-53 is the largest relative error of one operation; kUnit leaves room for
// what is of second order, and for the rounding of the bounds themselves. A last addition or subtraction
// cannot carry a sum across its bound, which is a double itself, and so does not count. Differences of floats
// and products of up to three of them neither overflow nor underflow in double.

namespace boxwood {

namespace {

constexpr double kUnit = 0x1p-53 * (1.0 + 0x1p-40);
constexpr double kEdgeBound = 3.0 * kUnit;   ///< of two products of two differences each: 3 roundings
constexpr double kPlaneBound = 7.0 * kUnit;  ///< see compare_plane

std::array<double, 3> coordinates(const Vec3& p) { return {double(p.x), double(p.y), double(p.z)}; }

bool are_apart(const Box& a, const Box& b) {
    return a.lower.x > b.upper.x || b.lower.x > a.upper.x || a.lower.y > b.upper.y || b.lower.y > a.upper.y ||
           a.lower.z > b.upper.z || b.lower.z > a.upper.z;
}

bool is_in(const Vec3& p, const Box& box) {
    return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y &&
           box.lower.z <= p.z && p.z <= box.upper.z;
}

}  // namespace

TriangleBoxTest::TriangleBoxTest(const Triangle& triangle, double bound_scale)
    : triangle_(triangle),
      bounds_(triangle.bounds()),
      corner_{coordinates(triangle.a), coordinates(triangle.b), coordinates(triangle.c)},
      bound_scale_(bound_scale) {
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k) edge_[i][k] = corner_[(i + 1) % 3][k] - corner_[i][k];
    for (size_t k = 0; k < 3; ++k) {
        const size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const double left = edge_[0][u] * edge_[1][v], right = edge_[0][v] * edge_[1][u];
        normal_[k] = left - right;
        normal_terms_[k] = std::abs(left) + std::abs(right);
        const double bound = bound_scale_ * kEdgeBound * normal_terms_[k];
        facing_[k] = normal_[k] > bound ? 1 : normal_[k] < -bound ? -1 : 0;
    }
}

bool TriangleBoxTest::has_corner_in(const Box& box) const {
    return is_in(triangle_.a, box) || is_in(triangle_.b, box) || is_in(triangle_.c, box);
}

/// n . (p - a) over the corners p of the box. A term n_k (p_k - a_k) carries the 4 roundings of n_k (two
/// differences, product, difference of products), one of p_k - a_k and one of the product, each at most u
/// times its term with absolute values; the first of the two additions rounds once more: 7u.
TriangleBoxTest::Answer TriangleBoxTest::compare_plane(const Box& box) const {
    const std::array<double, 3> lower = coordinates(box.lower), upper = coordinates(box.upper);
    double least = 0.0, most = 0.0, terms = 0.0;
    for (size_t k = 0; k < 3; ++k) {
        const double to_lower = lower[k] - corner_[0][k], to_upper = upper[k] - corner_[0][k];
        const double at_lower = normal_[k] * to_lower, at_upper = normal_[k] * to_upper;
        least += std::min(at_lower, at_upper);
        most += std::max(at_lower, at_upper);
        terms += normal_terms_[k] * std::max(std::abs(to_lower), std::abs(to_upper));
    }
    const double bound = bound_scale_ * kPlaneBound * terms;
    if (least > bound || most < -bound) return Answer::Apart;
    return least <= -bound && most >= bound ? Answer::Touching : Answer::Open;
}

/// Seen along the axis, (U, V) is on the inner side of the edge from a where (b_u - a_u) (V - a_v) - (b_v -
/// a_v) (U - a_u) has the sign of the triangle's area: three roundings for each product.
TriangleBoxTest::Answer TriangleBoxTest::compare_edges(size_t axis, const Box& box) const {
    const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::array<double, 3> lower = coordinates(box.lower), upper = coordinates(box.upper);
    const bool is_edge_on = normal_terms_[axis] == 0.0;  // without error, and so are the terms it is made of
    Answer answer = Answer::Touching;
    for (size_t i = 0; i < 3; ++i) {
        const double edge_u = edge_[i][u], edge_v = edge_[i][v];
        const double a_u = corner_[i][u], a_v = corner_[i][v];
        // The corner of the box with the largest value, or with the smallest one; true: it is on that side.
        const auto reaches = [&](double sign) {
            const double du = (sign * edge_v >= 0.0 ? lower[u] : upper[u]) - a_u;
            const double dv = (sign * edge_u >= 0.0 ? upper[v] : lower[v]) - a_v;
            const double left = edge_u * dv, right = edge_v * du;
            const double value = sign * (left - right);
            const double bound = bound_scale_ * kEdgeBound * (std::abs(left) + std::abs(right));
            return value < -bound ? Answer::Apart : value >= bound ? Answer::Touching : Answer::Open;
        };
        if (facing_[axis] != 0) {
            const Answer inner = reaches(facing_[axis] > 0 ? 1.0 : -1.0);
            if (inner == Answer::Apart) return Answer::Apart;
            if (inner == Answer::Open) answer = Answer::Open;
            continue;
        }
        const Answer above = reaches(1.0), below = reaches(-1.0);
        if (is_edge_on && (above == Answer::Apart || below == Answer::Apart)) return Answer::Apart;
        if (above != Answer::Touching || below != Answer::Touching) answer = Answer::Open;
    }
    return answer;
}

bool TriangleBoxTest::touches_near(const Box& box) const {
    if (has_corner_in(box)) return true;
    bool is_open = false;
    const Answer plane = compare_plane(box);
    if (plane == Answer::Apart) return false;
    is_open = plane == Answer::Open;
    for (size_t axis = 0; axis < 3; ++axis) {
        const Answer edges = compare_edges(axis, box);
        if (edges == Answer::Apart) return false;
        if (edges == Answer::Open) is_open = true;
    }
    return !is_open || !clip_bounds(triangle_, box).is_empty();
}

bool TriangleBoxTest::touches(const Box& box) const { return !are_apart(bounds_, box) && touches_near(box); }

bool touches(const Triangle& triangle, const Box& box) { return TriangleBoxTest(triangle).touches(box); }

}  // namespace boxwood
