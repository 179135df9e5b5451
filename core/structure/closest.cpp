#include "core/structure/closest.h"

#include <bit>
#include <numeric>

#include "core/base/expansion.h"

namespace boxwood {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

struct ExactVec3 {
    Expansion x, y, z;
};

ExactVec3 difference(const Vec3& a, const Vec3& b) {
    const DVec3 p(a), q(b);
    return {Expansion::difference(p.x, q.x), Expansion::difference(p.y, q.y),
            Expansion::difference(p.z, q.z)};
}

ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Expansion dot(const Vec3& a, const ExactVec3& b) {
    const DVec3 p(a);
    return b.x * p.x + b.y * p.y + b.z * p.z;
}

Expansion dot(const ExactVec3& a, const ExactVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Place of a float among all floats in ascending order; both zeros have place 0.
int32_t ordered(float value) {
    const int32_t bits = std::bit_cast<int32_t>(value);
    return bits >= 0 ? bits : std::numeric_limits<int32_t>::min() - bits;
}

/// The inverse; +0 at place 0.
float float_at(int32_t place) {
    return std::bit_cast<float>(place >= 0 ? place : std::numeric_limits<int32_t>::min() - place);
}

/// t = numerator / denominator of the ray and the triangle's plane, exactly.
struct ExactT {
    Expansion numerator, denominator;

    ExactT(const Ray& ray, const Triangle& triangle) {
        const ExactVec3 normal =
            cross(difference(triangle.b, triangle.a), difference(triangle.c, triangle.a));
        numerator = dot(difference(triangle.a, ray.origin), normal);
        denominator = dot(ray.direction, normal);
        if (denominator.sign() < 0) {
            numerator = -numerator;
            denominator = -denominator;
        }
    }
    /// Sign of t - value.
    int compare(double value) const { return (numerator - denominator * value).sign(); }
    /// Sign of t - other.
    int compare(const ExactT& other) const {
        return (numerator * other.denominator - other.numerator * denominator).sign();
    }
    /// Numerator, denominator and their quotient are rounded once each.
    double estimate() const { return numerator.estimate() / denominator.estimate(); }
};

}  // namespace

double estimate_t(const Ray& ray, const Triangle& triangle) { return ExactT(ray, triangle).estimate(); }

bool is_valid(const Ray& ray) {
    return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3(0.0f) &&
           ray.t_min >= 0.0f && ray.t_min <= ray.t_max && ray.t_min < std::numeric_limits<float>::infinity();
}

ClosestHit<Mode::Exact>::ClosestHit(const Ray& ray)
    : ray_(ray),
      slabs_(ray),
      edges_(ray),
      limit_(static_cast<double>(ray.t_max) * RaySlabs::kPad),
      t_lower_(kInfinity),
      t_upper_(kInfinity) {}

bool ClosestHit<Mode::Exact>::decide_exactly(const Triangle& triangle) const {
    // The edge functions d.(B x C), d.(C x A), d.(A x B): the closed triangle is hit if no two differ in
    // sign; all zero means that its plane holds the ray.
    const ExactVec3 a = difference(triangle.a, ray_.origin);
    const ExactVec3 b = difference(triangle.b, ray_.origin);
    const ExactVec3 c = difference(triangle.c, ray_.origin);
    const int u = dot(ray_.direction, cross(b, c)).sign();
    const int v = dot(ray_.direction, cross(c, a)).sign();
    const int w = dot(ray_.direction, cross(a, b)).sign();
    const bool some_negative = u < 0 || v < 0 || w<0, some_positive = u> 0 || v > 0 || w > 0;
    return some_negative != some_positive;
}

bool ClosestHit<Mode::Exact>::is_in_range(const Triangle& triangle) const {
    const Interval t = interval_of_t<FilterBounds>(ray_, triangle);
    const double t_min = static_cast<double>(ray_.t_min), t_max = static_cast<double>(ray_.t_max);
    if (t.upper < t_min || t.lower > t_max) return false;
    if (t.lower >= t_min && t.upper <= t_max) return true;
    const ExactT exact(ray_, triangle);
    return exact.compare(t_min) >= 0 && (std::isinf(ray_.t_max) || exact.compare(t_max) <= 0);
}

bool ClosestHit<Mode::Exact>::keep_if_nearer(const Triangle& triangle, uint32_t prim) {
    const Interval t = interval_of_t<FilterBounds>(ray_, triangle);
    const double t_min = static_cast<double>(ray_.t_min), t_max = static_cast<double>(ray_.t_max);
    if (t.upper < t_min || t.lower > t_max || t.lower > t_upper_) return true;
    const bool is_surely_in_range = t.lower >= t_min && t.upper <= t_max;
    const bool is_surely_nearer = t.upper < t_lower_;
    if (!is_surely_in_range || !is_surely_nearer) {
        if (prim == prim_) return true;  // a second reference to the best hit
        const ExactT exact(ray_, triangle);
        if (exact.compare(t_min) < 0 || (!std::isinf(ray_.t_max) && exact.compare(t_max) > 0)) return false;
        if (prim_ != kNoIndex) {
            const int order = exact.compare(ExactT(ray_, best_));
            if (order > 0 || (order == 0 && prim > prim_)) return false;
        }
    }
    best_ = triangle;
    prim_ = prim;
    t_lower_ = t.lower;
    t_upper_ = t.upper;
    limit_ = std::min(limit_, t.upper * RaySlabs::kPad);
    return is_surely_in_range && is_surely_nearer;
}

Hit ClosestHit<Mode::Exact>::hit(const Mesh&) const {
    if (prim_ == kNoIndex) return {};
    const float lower = static_cast<float>(t_lower_), upper = static_cast<float>(t_upper_);
    if (lower == upper) return {upper, prim_};
    // Rounding is monotonic, so the result lies in [lower, upper]. That can be very many floats where t is
    // near 0 (a ray that starts on the triangle), so halve their number: a float is too low where t is beyond
    // the midpoint (a double) to the next one.
    const ExactT exact(ray_, best_);
    int32_t first = ordered(lower), last = ordered(upper);
    while (first < last) {
        const int32_t middle = std::midpoint(first, last);
        const float t = float_at(middle), next = float_at(middle + 1);
        const double above = std::isinf(next) ? 0x1p128 : static_cast<double>(next);
        const double border = 0.5 * (static_cast<double>(t) + above);
        const int order = exact.compare(border);
        if (order == 0) return {static_cast<float>(border), prim_};  // a tie goes to the even neighbour
        if (order < 0) {
            last = middle;
        } else {
            first = middle + 1;
        }
    }
    return {float_at(first), prim_};
}

ClosestHit<Mode::Fast>::ClosestHit(const Ray& ray)
    : ray_(ray),
      slabs_(ray),
      kz_(largest_component(ray.direction)),
      limit_(static_cast<double>(ray.t_max) * kPad) {
    kx_ = (kz_ + 1) % 3;
    ky_ = (kz_ + 2) % 3;
    shear_x_ = ray.direction[kx_] / ray.direction[kz_];
    shear_y_ = ray.direction[ky_] / ray.direction[kz_];
}

}  // namespace boxwood
