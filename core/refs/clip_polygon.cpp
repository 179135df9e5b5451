#include "core/refs/clip_polygon.h"

#include <array>
#include <bit>
#include <cstdint>

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

/// Bracket of a number known as an approximation `x` with |x - exact| <= error, and exactly by an `offset`:
/// offset.from(f) is an ExactSum that is a positive `scale` (known to a relative error of 1e-8) times
/// (exact - f), offset.sign(f) its sign.
template <class Offset>
Bracket bracket(double x, double error, double scale, const Offset& offset) {
    // x is at most half a step away from its nearest float, so the number lies on the same side of it as x,
    // and before the next float, where that side is certain.
    float nearest = static_cast<float>(x);
    const double distance = x - double(nearest);
    if (distance > error) return {nearest, next_up(nearest)};
    if (-distance > error) return {next_down(nearest), nearest};
    // Close to zero the interval may hold many floats: there the exact sum gives x with a small relative
    // error.
    if (!(error < 1e-9 * std::abs(x))) nearest = static_cast<float>(offset.from(0.0f).value() / scale);
    const int sign = offset.sign(nearest);
    if (sign == 0) return {nearest, nearest};
    if (sign > 0) return {nearest, next_up(nearest)};
    return {next_down(nearest), nearest};
}

using Point = std::array<float, 3>;  // glm's vectors branch at each index that is no constant

Point point(const Vec3& v) { return {v.x, v.y, v.z}; }

class Clipper {
public:
    /// `reached`: bounds that the result is known to have; empty in an axis, or infinite, where none is
    /// known.
    Clipper(const Triangle& triangle, const Box& bounds, const Box& box, const Box& reached,
            double bound_scale)
        : corners_{point(triangle.a), point(triangle.b), point(triangle.c)},
          least_(point(bounds.lower)),
          most_(point(bounds.upper)),
          lower_(point(box.lower)),
          upper_(point(box.upper)),
          bound_scale_(bound_scale),
          result_lower_(point(reached.lower)),
          result_upper_(point(reached.upper)) {}

    Box bounds() {
        for (const Point& corner : corners_) add_corner(corner);
        for (size_t i = 0; i < 3 && !is_complete(); ++i) add_edge(corners_[i], corners_[(i + 1) % 3]);
        for (size_t axis = 0; axis < 3 && !is_complete(); ++axis) add_box_edges(axis);
        return {{result_lower_[0], result_lower_[1], result_lower_[2]},
                {result_upper_[0], result_upper_[1], result_upper_[2]}};
    }

private:
    bool is_inside(size_t axis, const Bracket& x) const {
        return lower_[axis] <= x.floor && x.ceil <= upper_[axis];
    }

    void add(size_t axis, const Bracket& x) {
        result_lower_[axis] = std::min(result_lower_[axis], x.floor);
        result_upper_[axis] = std::max(result_upper_[axis], x.ceil);
    }

    /// Whether no further point can make the result larger, along an axis or at all.
    bool is_complete(size_t axis) const {
        return result_lower_[axis] <= std::max(lower_[axis], least_[axis]) &&
               result_upper_[axis] >= std::min(upper_[axis], most_[axis]);
    }
    bool is_complete() const { return is_complete(0) && is_complete(1) && is_complete(2); }
    /// Whether a point with this coordinate makes the result no larger along the axis.
    bool is_reached(size_t axis, float x) const {
        return result_lower_[axis] <= x && x <= result_upper_[axis];
    }

    void add_corner(const Point& corner) {
        for (size_t axis = 0; axis < 3; ++axis)
            if (!is_inside(axis, {corner[axis], corner[axis]})) return;
        for (size_t axis = 0; axis < 3; ++axis) add(axis, {corner[axis], corner[axis]});
    }

    /// Points of an edge on the planes of the box. The ends are put in order, so that both triangles at an
    /// edge compute the same point.
    void add_edge(const Point& from, const Point& to) {
        const Point &a = std::min(from, to), &b = std::max(from, to);  // lexicographically
        for (size_t axis = 0; axis < 3; ++axis)
            if (std::max(a[axis], b[axis]) < lower_[axis] || std::min(a[axis], b[axis]) > upper_[axis])
                return;
        for (size_t axis = 0; axis < 3; ++axis)
            for (const float plane : {lower_[axis], upper_[axis]}) {
                if (!(std::min(a[axis], b[axis]) < plane && plane < std::max(a[axis], b[axis]))) continue;
                const bool are_others_complete = is_complete((axis + 1) % 3) && is_complete((axis + 2) % 3);
                if (!are_others_complete || !is_reached(axis, plane)) add_edge_point(a, b, axis, plane);
            }
    }

    /// The point of edge ab with the given coordinate, strictly between those of a and b.
    void add_edge_point(const Point& a, const Point& b, size_t axis, float plane) {
        const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Bracket at_u = edge_coordinate(a, b, axis, plane, u);
        if (!is_inside(u, at_u)) return;
        const Bracket at_v = edge_coordinate(a, b, axis, plane, v);
        if (!is_inside(v, at_v)) return;
        add(axis, {plane, plane});
        add(u, at_u);
        add(v, at_v);
    }

    /// x = (a_x (b_k - K) + b_x (K - a_k)) / (b_k - a_k): both weights have the sign of the denominator.
    ///
    /// Error in double, u = 2^-53, M = max(|a_x|, |b_x|): the weights round by u each, and as they are the
    /// same in both sums, x moves by at most 2u |a_x - b_x| f (1 - f) <= uM, f the place on the edge; the
    /// products round by u times their share of M, the sums and the quotient by u|x| each: 2uM + 3u|x|.
    Bracket edge_coordinate(const Point& a, const Point& b, size_t axis, float plane, size_t u) const {
        const float at_a = a[u], at_b = b[u];
        if (at_a == at_b) return {at_a, at_a};
        const bool ascends = a[axis] < b[axis];
        const double sign = ascends ? 1.0 : -1.0;
        const double weight_a = sign * (double(b[axis]) - double(plane));
        const double weight_b = sign * (double(plane) - double(a[axis]));
        const double scale = weight_a + weight_b;
        const double x = (weight_a * double(at_a) + weight_b * double(at_b)) / scale;
        constexpr double kUnit = 0x1p-53 * (1.0 + 0x1p-40);
        const double largest = std::max(std::abs(double(at_a)), std::abs(double(at_b)));
        const double error = bound_scale_ * kUnit * (2.0 * largest + 3.0 * std::abs(x));
        return bracket(x, error, scale,
                       EdgeOffset{ascends ? ExactDifference(b[axis], plane) : ExactDifference(plane, b[axis]),
                                  ascends ? ExactDifference(plane, a[axis]) : ExactDifference(a[axis], plane),
                                  at_a, at_b});
    }

    /// weight_a (at_a - f) + weight_b (at_b - f); see bracket.
    struct EdgeOffset {
        ExactDifference weight_a, weight_b;
        float at_a, at_b;

        ExactSum from(float f) const {
            ExactSum sum;
            sum.add_product(weight_a, ExactDifference(at_a, f));
            sum.add_product(weight_b, ExactDifference(at_b, f));
            return sum;
        }
        int sign(float f) const {
            return sign_of_products(weight_a, ExactDifference(at_a, f), weight_b, ExactDifference(at_b, f));
        }
    };

    /// Points of the triangle's inside on the four edges of the box along `axis`.
    void add_box_edges(size_t axis) {
        const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const float at_u : {lower_[u], upper_[u]}) {
            if (!(least_[u] < at_u && at_u < most_[u])) continue;
            for (const float at_v : {lower_[v], upper_[v]}) {
                if (!(least_[v] < at_v && at_v < most_[v])) continue;
                const bool adds_nothing = is_complete(axis) && is_reached(u, at_u) && is_reached(v, at_v);
                if (!adds_nothing) add_box_edge_point(axis, u, at_u, v, at_v);
            }
        }
    }

    /// Twice the area, seen along an axis, that the point (U, V) makes with the edge opposite to corner i.
    ExactSum exact_area(size_t i, size_t u, float at_u, size_t v, float at_v) const {
        const Point &a = corners_[(i + 1) % 3], &b = corners_[(i + 2) % 3];
        ExactSum sum;
        sum.add_product(ExactDifference(a[u], at_u), ExactDifference(b[v], at_v));
        sum.add_product(ExactDifference(at_v, a[v]), ExactDifference(b[u], at_u));
        return sum;
    }

    /// The sum of |area_i| (x_i - f); see bracket.
    struct LineOffset {
        const Clipper& clipper;
        size_t axis, u;
        float at_u;
        size_t v;
        float at_v;
        bool areas_are_positive;

        ExactSum from(float f) const {
            ExactSum sum;
            for (size_t i = 0; i < 3; ++i) {
                const float x = clipper.corners_[i][axis];
                sum.add_product(clipper.exact_area(i, u, at_u, v, at_v),
                                areas_are_positive ? ExactDifference(x, f) : ExactDifference(f, x));
            }
            return sum;
        }
        int sign(float f) const { return from(f).sign(); }
    };

    /// The line (U, V) along `axis` meets the triangle where the three areas that the point (U, V) makes with
    /// the triangle's edges, seen along the axis, have one sign; they are the weights of its corners. A line
    /// through an edge or a corner has an area of zero, and its point is found as B or A.
    void add_box_edge_point(size_t axis, size_t u, float at_u, size_t v, float at_v) {
        std::array<double, 3> du, dv;
        for (size_t i = 0; i < 3; ++i) {
            du[i] = double(corners_[i][u]) - double(at_u);
            dv[i] = double(corners_[i][v]) - double(at_v);
        }
        // x = sum of area_i x_i / sum of area_i, M the largest |x_i|, e the sum of the area errors, W that of
        // the areas: area errors move x by at most 2M e / W, no |x_i - x| being larger than 2M; numerator and
        // denominator round by 3u M W and 2u W, the division by u M: 2M e / W + 6u M. What is of second order
        // is below 1e-8 of it.
        constexpr double kUnit = 0x1p-53 * (1.0 + 0x1p-20);
        double total = 0.0, total_error = 0.0, numerator = 0.0, largest = 0.0;
        int sign = 0;
        for (size_t i = 0; i < 3; ++i) {
            // Each product carries three roundings, their difference one more: 4u (|left| + |right|).
            const double left = du[(i + 1) % 3] * dv[(i + 2) % 3], right = dv[(i + 1) % 3] * du[(i + 2) % 3];
            double area = left - right;
            double error = 4.0 * kUnit * (std::abs(left) + std::abs(right));
            if (!(error < 1e-9 * std::abs(area))) {
                area = exact_area(i, u, at_u, v, at_v).value();
                error = 4.0 * kUnit * std::abs(area);
            }
            const int side = area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
            if (side == 0 || (sign != 0 && side != sign)) return;
            sign = side;
            const double x = double(corners_[i][axis]);
            total += area;
            total_error += error;
            numerator += area * x;
            largest = std::max(largest, std::abs(x));
        }
        const double error = bound_scale_ * (2.0 * total_error / std::abs(total) + 6.0 * kUnit) * largest;
        const LineOffset offset{*this, axis, u, at_u, v, at_v, sign > 0};
        const Bracket x = bracket(numerator / total, error, std::abs(total), offset);
        if (!is_inside(axis, x)) return;
        add(axis, x);
        add(u, {at_u, at_u});
        add(v, {at_v, at_v});
    }

    std::array<Point, 3> corners_;
    Point least_, most_;   // the triangle's bounds
    Point lower_, upper_;  // the box
    double bound_scale_;
    Point result_lower_, result_upper_;
};

}  // namespace

Box clip_bounds(const Triangle& triangle, const Box& box, double bound_scale) {
    const Box whole = triangle.bounds();
    if (box.contains(whole)) return whole;
    if (glm::any(glm::greaterThan(whole.lower, box.upper)) || glm::any(glm::lessThan(whole.upper, box.lower)))
        return {};
    return Clipper(triangle, whole, box, Box(), bound_scale).bounds();
}

ClippedHalves clip_halves(const Triangle& triangle, const Box& part, int axis, float position) {
    Box lower = part, upper = part;
    lower.upper[axis] = upper.lower[axis] = position;
    // Only a part with points strictly on both sides reaches the plane for certain.
    if (!(part.lower[axis] < position && position < part.upper[axis]))
        return {clip_bounds(triangle, lower), clip_bounds(triangle, upper)};
    const Box whole = triangle.bounds();
    Box reached;
    reached.lower[axis] = part.lower[axis];
    reached.upper[axis] = position;
    const Box first = Clipper(triangle, whole, lower, reached, 1.0).bounds();
    // What the lower half does not reach of the part's box is reached by the upper one.
    reached = Box();
    for (int a = 0; a < 3; ++a) {
        if (first.lower[a] > part.lower[a]) reached.lower[a] = part.lower[a];
        if (first.upper[a] < part.upper[a]) reached.upper[a] = part.upper[a];
    }
    reached.lower[axis] = position;
    return {first, Clipper(triangle, whole, upper, reached, 1.0).bounds()};
}

}  // namespace boxwood
