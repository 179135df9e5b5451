#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/scene/mesh.h"

// What exact mode decides in double. Each kernel takes its bounds as a template argument, so that a test can
// show that smaller ones are wrong. u = 2^-53 is the largest relative error of one operation; differences and
// products of floats, and products of two of these, neither overflow nor underflow in double.

namespace boxwood {

/// The bounds as derived below, each with room for what is of second order: 2^-40 of it is 2^13 u.
struct FilterBounds {
    static constexpr double kUnit = 0x1p-53;
    static constexpr double kSlabPad = 1.0 + 6.0 * kUnit;                    ///< see RaySlabs
    static constexpr double kEdge = 10.0 * kUnit * (1.0 + 0x1p-40);          ///< see EdgeFilter
    static constexpr double kTermUnit = kUnit * (1.0 + 0x1p-40);             ///< see interval_of_t
    static constexpr double kEstimateError = 4.0 * kUnit * (1.0 + 0x1p-20);  ///< see interval_of_t
};

/// A ray prepared for box tests; 1/d is infinite only for d = 0.
///
/// Before its last rounding a plane parameter (plane - o) * inverse carries two, of the difference and of the
/// inverse; a far one a third, of the padded inverse. The last one is monotonic. So near <= far holds
/// whenever it does exactly if kSlabPad >= (1 + u)^2 / (1 - u)^3, which is 1 + 5u to first order; the next
/// double is 1
/// + 6u. It also covers what `meets` is asked for with a limit t * kPad: a box that is entered at t or
/// before. All parameters that count are >= 0, since t_min is. Ize, "Robust BVH Ray Traversal", JCGT 2(2),
/// 2013, section 3, there in float. A NaN (origin on the plane of a face that the ray is parallel to) keeps
/// the other bound: the ray is inside.
template <class Bounds>
class BasicRaySlabs {
public:
    static constexpr double kPad = Bounds::kSlabPad;

    explicit BasicRaySlabs(const Ray& ray)
        : near_origin_(ray.origin),
          far_origin_(ray.origin),
          inverse_(1.0 / DVec3(ray.direction)),
          padded_inverse_(inverse_ * kPad),
          t_min_(static_cast<double>(ray.t_min)) {
        for (int axis = 0; axis < 3; ++axis) negative_[axis] = std::signbit(ray.direction[axis]) ? 1 : 0;
    }

    bool is_negative(int axis) const { return negative_[axis] != 0; }

    /// From here on every box counts as larger by at least `margin` on each side: the moved origins are
    /// rounded by less than 2^-52 of them.
    void widen(double margin) {
        for (int axis = 0; axis < 3; ++axis) {
            const double rounded_up = margin + 0x1p-52 * std::abs(near_origin_[axis]);
            near_origin_[axis] += is_negative(axis) ? -rounded_up : rounded_up;
            far_origin_[axis] -= is_negative(axis) ? -rounded_up : rounded_up;
        }
    }

    /// Whether the ray may meet the closed box at a parameter of at most `limit`; then `entry` is a lower
    /// bound of the parameters inside the box, but for a factor of at most kPad.
    bool meets(const Vec3& lower, const Vec3& upper, double limit, double& entry) const {
        const Vec3* const planes[2] = {&lower, &upper};
        double t0 = t_min_, t1 = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const double near_plane = static_cast<double>((*planes[negative_[axis]])[axis]);
            const double far_plane = static_cast<double>((*planes[1 - negative_[axis]])[axis]);
            const double entry_here = near(axis, near_plane), exit_here = far(axis, far_plane);
            t0 = entry_here > t0 ? entry_here : t0;
            t1 = exit_here < t1 ? exit_here : t1;
        }
        entry = t0;
        return t0 <= t1;
    }

    /// Lower bound (but for a factor of at most kPad) of the ray's parameter on the plane of a near face: it
    /// is in the closed half-space beyond it at no smaller parameter. +-infinity or NaN where it is parallel.
    double near(int axis, double plane) const { return (plane - near_origin_[axis]) * inverse_[axis]; }
    /// Upper bound of the ray's parameter on the plane of a far face: at no larger parameter is it in the
    /// closed half-space before it. Holds for planes that are not behind the origin.
    double far(int axis, double plane) const { return (plane - far_origin_[axis]) * padded_inverse_[axis]; }
    double t_min() const { return t_min_; }

private:
    DVec3 near_origin_, far_origin_;
    DVec3 inverse_, padded_inverse_;
    double t_min_;
    uint32_t negative_[3];  ///< 1 where the direction's sign bit is set
};

using RaySlabs = BasicRaySlabs<FilterBounds>;

/// Index of the largest |component|, the first of equal ones.
inline int largest_component(const Vec3& v) {
    const Vec3 a = glm::abs(v);
    return a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
}

/// Whether a ray's line hits a closed triangle, as far as double can tell. Woop, Benthin, Wald, "Watertight
/// Ray/Triangle Intersection", JCGT 2(1), 2013: vertices relative to the origin are sheared so that the ray
/// is the z axis; U, V, W are the edge functions, whose signs decide.
///
/// With X = max|x|,|y| of the sheared vertices, Z = max|z|, m = X + Z. The slope s = d_x/d_z is off by u/2,
/// as |s| <= 1 and 1 itself is exact. In x = a_x - s a_z the differences a_x and a_z, the slope, the product
/// and the difference round: x is off by at most u|a_x| + u|s a_z| + (u/2)|a_z| + u|s a_z| + u|x|, where
/// |a_x| <= |x| + |s a_z|: by u (2X + 3.5Z). U = c_x b_y - c_y b_x has four such numbers as factors and two
/// rounded products; the last difference cannot change the sign. So U has the right sign where it exceeds 4X
/// u (2X + 3.5Z) + 2X^2 u = u (10X^2 + 14XZ) = u (14X m - 4X^2), which grows with X up to X = m: 10u m^2.
template <class Bounds>
class EdgeFilter {
public:
    enum class Answer { Miss, Hit, Unknown };
    /// Of the edges opposite to a, b, c; right in sign where the magnitude exceeds `bound`.
    struct Functions {
        double u, v, w, bound;
    };

    explicit EdgeFilter(const Ray& ray) : origin_(ray.origin), kz_(largest_component(ray.direction)) {
        kx_ = (kz_ + 1) % 3;
        ky_ = (kz_ + 2) % 3;
        const DVec3 d(ray.direction);
        shear_x_ = d[kx_] / d[kz_];
        shear_y_ = d[ky_] / d[kz_];
        is_mirrored_ = d[kz_] > 0.0;
    }

    Functions functions(const Triangle& triangle) const {
        const DVec3 a = DVec3(triangle.a) - origin_, b = DVec3(triangle.b) - origin_,
                    c = DVec3(triangle.c) - origin_;
        const double ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
        const double bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
        const double cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
        const double m =
            std::max({std::abs(ax), std::abs(ay), std::abs(bx), std::abs(by), std::abs(cx), std::abs(cy)}) +
            std::max({std::abs(a[kz_]), std::abs(b[kz_]), std::abs(c[kz_])});
        const double bound = Bounds::kEdge * m * m;
        return {cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax, bound};
    }
    static Answer decide(const Functions& f) {
        const double least = std::min({f.u, f.v, f.w}), greatest = std::max({f.u, f.v, f.w});
        if (least < -f.bound && greatest > f.bound) return Answer::Miss;
        if (least > f.bound || greatest < -f.bound) return Answer::Hit;
        return Answer::Unknown;
    }
    /// Whether the functions have the sign of -d.(P x Q), P and Q the edge's ends from the origin: with
    /// (x, y, z) the sheared coordinates of P, P = x e_x + y e_y + (z / d_z) d, so d.(P x Q) = d_z (p_x q_y -
    /// p_y q_x).
    bool is_mirrored() const { return is_mirrored_; }

private:
    DVec3 origin_;
    int kx_, ky_, kz_;
    double shear_x_, shear_y_;
    bool is_mirrored_;
};

/// t of the ray and the triangle's plane, computed from exact terms.
double estimate_t(const Ray& ray, const Triangle& triangle);

struct Interval {
    double lower, upper;
};

/// Contains the exact t of the ray and the plane of a triangle; not for a plane that is parallel to the ray.
///
/// t = N / D = A.n / d.n, n = (b - a) x (c - a), A = a - o. Each monomial of N carries 3 roundings of
/// differences, 2 of products, 1 of the difference in n, 2 of the sum: N is off by at most 8u times the sum
/// of absolute monomials, D, which has one factor without rounding, by 7u. The quotient: |t - N/D| <= (eN +
/// |N/D| eD) / (|D| - eD), then u|t| for the division and u|t| for the ends. Where D may be zero, t is the
/// quotient of two sums without error, each rounded once: 4u |t| with the division and the ends.
template <class Bounds>
Interval interval_of_t(const Ray& ray, const Triangle& triangle) {
    const DVec3 a = DVec3(triangle.a) - DVec3(ray.origin);
    const DVec3 e1 = DVec3(triangle.b) - DVec3(triangle.a), e2 = DVec3(triangle.c) - DVec3(triangle.a);
    const DVec3 d(ray.direction);
    const DVec3 n = glm::cross(e1, e2);
    const DVec3 n_abs(std::abs(e1.y * e2.z) + std::abs(e1.z * e2.y),
                      std::abs(e1.z * e2.x) + std::abs(e1.x * e2.z),
                      std::abs(e1.x * e2.y) + std::abs(e1.y * e2.x));
    const double numerator = glm::dot(a, n), denominator = glm::dot(d, n);
    const double numerator_error = 8.0 * Bounds::kTermUnit * glm::dot(glm::abs(a), n_abs);
    const double denominator_error = 7.0 * Bounds::kTermUnit * glm::dot(glm::abs(d), n_abs);
    const double rest = std::abs(denominator) - denominator_error;
    double t, error;
    if (rest > 0.0) {
        t = numerator / denominator;
        error = (numerator_error + std::abs(t) * denominator_error) / rest * (1.0 + 0x1p-40) +
                2.0 * Bounds::kTermUnit * std::abs(t);
    } else {
        t = estimate_t(ray, triangle);
        error = Bounds::kEstimateError * std::abs(t);
    }
    return {t - error, t + error};
}

}  // namespace boxwood
