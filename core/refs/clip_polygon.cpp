#include "core/refs/clip_polygon.h"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/base/exact_sum.h"

// The part of a triangle inside a box is a convex polygon. Where two lines meet in a corner of it, they are
//   A. two edges of the triangle: the corner is a corner of the triangle, inside the box;
//   B. an edge of the triangle and a plane of the box;
//   C. two planes of the box: an edge of the box passes through the inside of the triangle.
// The box of all of them is the part's box. Coordinates of B and C are rational numbers; only the floats
// around them matter, and comparing with a float bound needs no more than those: x <= U if and only if
// ceil(x) <= U.

namespace boxwood {

namespace {

/// The neighbouring floats of a number: the largest below or equal, the smallest above or equal.
struct Bracket {
    float floor, ceil;
};

/// The next float above and below; the largest float has none that is finite.
float next_up(float x) {
    if (x == 0.0f) return std::numeric_limits<float>::denorm_min();
    const int32_t bits = std::bit_cast<int32_t>(x);
    return std::bit_cast<float>(x > 0.0f ? bits + 1 : bits - 1);
}
float next_down(float x) { return -next_up(-x); }

/// Bracket of a number known as an approximation `x` with |x - exact| <= error, and exactly by
/// `difference(f)`: an ExactSum that is a positive `scale` (known to a relative error of 1e-8) times (exact -
/// f).
template <class Difference>
Bracket bracket(double x, double error, double scale, const Difference& difference) {
    // x is at most half a step away from its nearest float, so the number lies on the same side of it as x,
    // and before the next float, where that side is certain.
    float nearest = static_cast<float>(x);
    const double distance = x - double(nearest);
    if (distance > error) return {nearest, next_up(nearest)};
    if (-distance > error) return {next_down(nearest), nearest};
    // Close to zero the interval may hold many floats: there the exact sum gives x with a small relative
    // error.
    if (!(error < 1e-9 * std::abs(x))) nearest = static_cast<float>(difference(0.0f).value() / scale);
    const int sign = difference(nearest).sign();
    if (sign == 0) return {nearest, nearest};
    if (sign > 0) return {nearest, next_up(nearest)};
    return {next_down(nearest), nearest};
}

bool lexicographically_less(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

class Clipper {
public:
    Clipper(const Triangle& triangle, const Box& box)
        : corners_{triangle.a, triangle.b, triangle.c}, bounds_(triangle.bounds()), box_(box) {}

    Box bounds() {
        for (const Vec3& corner : corners_) add_corner(corner);
        for (size_t i = 0; i < 3; ++i) add_edge(corners_[i], corners_[(i + 1) % 3]);
        for (int axis = 0; axis < 3; ++axis) add_box_edges(axis);
        return result_;
    }

private:
    bool is_inside(int axis, float x) const { return box_.lower[axis] <= x && x <= box_.upper[axis]; }
    bool is_inside(int axis, const Bracket& x) const {
        return box_.lower[axis] <= x.floor && x.ceil <= box_.upper[axis];
    }

    void add_corner(const Vec3& corner) {
        if (is_inside(0, corner.x) && is_inside(1, corner.y) && is_inside(2, corner.z))
            result_.extend(corner);
    }

    /// Points of an edge on the planes of the box. The ends are put in order, so that both triangles at an
    /// edge compute the same point.
    void add_edge(Vec3 a, Vec3 b) {
        if (lexicographically_less(b, a)) std::swap(a, b);
        for (int axis = 0; axis < 3; ++axis) {
            const float lower = std::min(a[axis], b[axis]);
            const float upper = std::max(a[axis], b[axis]);
            for (const float plane : {box_.lower[axis], box_.upper[axis]})
                if (lower < plane && plane < upper) add_edge_point(a, b, axis, plane);
        }
    }

    /// The point of edge ab with the given coordinate, strictly between those of a and b.
    void add_edge_point(const Vec3& a, const Vec3& b, int axis, float plane) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Bracket at_u = edge_coordinate(a, b, axis, plane, u);
        if (!is_inside(u, at_u)) return;
        const Bracket at_v = edge_coordinate(a, b, axis, plane, v);
        if (!is_inside(v, at_v)) return;
        add_point(axis, {plane, plane}, u, at_u, v, at_v);
    }

    /// x = (a_x (b_k - K) + b_x (K - a_k)) / (b_k - a_k): both weights have the sign of the denominator.
    ///
    /// Error in double, u = 2^-53: the weights and products round by u each, their sum by u; the denominator,
    /// the sum of the rounded weights, is off by 2u, the division by u: 6u max(|a_x|, |b_x|) < 1e-15 times
    /// that.
    static Bracket edge_coordinate(const Vec3& a, const Vec3& b, int axis, float plane, int u) {
        const float at_a = a[u], at_b = b[u];
        if (at_a == at_b) return {at_a, at_a};
        const double sign = a[axis] < b[axis] ? 1.0 : -1.0;
        const double weight_a = sign * (double(b[axis]) - double(plane));
        const double weight_b = sign * (double(plane) - double(a[axis]));
        const double scale = weight_a + weight_b;
        const double x = (weight_a * double(at_a) + weight_b * double(at_b)) / scale;
        const double error = 1e-15 * std::max(std::abs(double(at_a)), std::abs(double(at_b)));
        return bracket(x, error, scale, [&](float f) {
            const bool ascends = sign > 0.0;
            ExactSum sum;
            sum.add_product(ascends ? ExactDifference(b[axis], plane) : ExactDifference(plane, b[axis]),
                            ExactDifference(at_a, f));
            sum.add_product(ascends ? ExactDifference(plane, a[axis]) : ExactDifference(a[axis], plane),
                            ExactDifference(at_b, f));
            return sum;
        });
    }

    /// Points of the triangle's inside on the four edges of the box along `axis`.
    void add_box_edges(int axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const float at_u : {box_.lower[u], box_.upper[u]}) {
            if (!(bounds_.lower[u] < at_u && at_u < bounds_.upper[u])) continue;
            for (const float at_v : {box_.lower[v], box_.upper[v]})
                if (bounds_.lower[v] < at_v && at_v < bounds_.upper[v])
                    add_box_edge_point(axis, u, at_u, v, at_v);
        }
    }

    /// The line (U, V) along `axis` meets the triangle where the three areas that the point (U, V) makes with
    /// the triangle's edges, seen along the axis, have one sign; they are the weights of its corners. A line
    /// through an edge or a corner has an area of zero, and its point is found as B or A.
    void add_box_edge_point(int axis, int u, float at_u, int v, float at_v) {
        std::array<double, 3> area, area_error;
        for (size_t i = 0; i < 3; ++i) {
            const Vec3 &a = corners_[(i + 1) % 3], &b = corners_[(i + 2) % 3];
            const double left = (double(a[u]) - double(at_u)) * (double(b[v]) - double(at_v));
            const double right = (double(a[v]) - double(at_v)) * (double(b[u]) - double(at_u));
            // Each product carries three roundings, their difference one more: 4u (|left| + |right|) < 5e-16
            // of it.
            area[i] = left - right;
            area_error[i] = 5e-16 * (std::abs(left) + std::abs(right));
        }
        const auto exact_area = [&](size_t i) {
            const Vec3 &a = corners_[(i + 1) % 3], &b = corners_[(i + 2) % 3];
            ExactSum sum;
            sum.add_product(ExactDifference(a[u], at_u), ExactDifference(b[v], at_v));
            sum.add_product(ExactDifference(at_v, a[v]), ExactDifference(b[u], at_u));
            return sum;
        };
        int sign = 0;
        for (size_t i = 0; i < 3; ++i) {
            if (!(area_error[i] < 1e-9 * std::abs(area[i]))) {
                area[i] = exact_area(i).value();
                area_error[i] = 5e-16 * std::abs(area[i]);
            }
            const int side = area[i] > 0.0 ? 1 : area[i] < 0.0 ? -1 : 0;
            if (side == 0 || (sign != 0 && side != sign)) return;
            sign = side;
        }

        // x = sum of area_i x_i / sum of area_i, M the largest |x_i|, e the sum of the area errors, W that of
        // the areas: numerator and denominator are off by e M and e, and round by 3u M W and 2u W; the
        // division by u.
        double total = 0.0, total_error = 0.0, numerator = 0.0, largest = 0.0;
        for (size_t i = 0; i < 3; ++i) {
            total += area[i];
            total_error += area_error[i];
            numerator += area[i] * double(corners_[i][axis]);
            largest = std::max(largest, std::abs(double(corners_[i][axis])));
        }
        const double error = (2.1 * total_error / std::abs(total) + 1e-15) * largest;
        const Bracket x = bracket(numerator / total, error, std::abs(total), [&](float f) {
            ExactSum sum;
            for (size_t i = 0; i < 3; ++i)
                sum.add_product(exact_area(i), sign > 0 ? ExactDifference(corners_[i][axis], f)
                                                        : ExactDifference(f, corners_[i][axis]));
            return sum;
        });
        if (is_inside(axis, x)) add_point(axis, x, u, {at_u, at_u}, v, {at_v, at_v});
    }

    void add_point(int i, const Bracket& x, int j, const Bracket& y, int k, const Bracket& z) {
        Vec3 floor, ceil;
        floor[i] = x.floor, floor[j] = y.floor, floor[k] = z.floor;
        ceil[i] = x.ceil, ceil[j] = y.ceil, ceil[k] = z.ceil;
        result_.lower = glm::min(result_.lower, floor);
        result_.upper = glm::max(result_.upper, ceil);
    }

    std::array<Vec3, 3> corners_;
    Box bounds_, box_, result_;
};

}  // namespace

Box clip_bounds(const Triangle& triangle, const Box& box) {
    const Box whole = triangle.bounds();
    if (box.contains(whole)) return whole;
    for (int axis = 0; axis < 3; ++axis)
        if (!(whole.lower[axis] <= box.upper[axis] && box.lower[axis] <= whole.upper[axis])) return {};
    return Clipper(triangle, box).bounds();
}

}  // namespace boxwood
