#include "core/structure/closest.h"

#include <bit>
#include <initializer_list>
#include <numeric>

#include "core/base/expansion.h"

namespace boxwood {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

__extension__ typedef __int128 Whole;

struct WholeVec3 {
    Whole x, y, z;
};

/// Vectors of like size as whole numbers: multiples of the last place of the smallest component, zeros left
/// out. Where the largest component is at most 2^16 times as large, all are below 2^(24 + 16) = 2^40.
class WholeScale {
public:
    explicit WholeScale(std::initializer_list<const Vec3*> vectors) {
        constexpr uint32_t kRange = 16;
        uint32_t least = 255, most = 1;  // exponent fields
        for (const Vec3* v : vectors) {
            for (int axis = 0; axis < 3; ++axis) {
                const uint32_t bits = std::bit_cast<uint32_t>((*v)[axis]) & 0x7fffffffu;
                if (bits == 0) continue;
                const uint32_t exponent = std::max(bits >> 23, 1u);
                least = std::min(least, exponent);
                most = std::max(most, exponent);
            }
        }
        fits_ = most <= least + kRange;
        // A last place is 2^(exponent - 150), so its inverse, as a double, has exponent 1023 + 150 -
        // exponent.
        scale_ = std::bit_cast<double>(uint64_t{1023 + 150 - least} << 52);
    }
    bool fits() const { return fits_; }
    WholeVec3 operator()(const Vec3& v) const { return {whole(v.x), whole(v.y), whole(v.z)}; }

private:
    int64_t whole(float value) const { return static_cast<int64_t>(static_cast<double>(value) * scale_); }

    bool fits_;
    double scale_;
};

WholeVec3 operator-(const WholeVec3& a, const WholeVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

WholeVec3 cross(const WholeVec3& a, const WholeVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

int sign_of(Whole value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

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

/// Sign of the edge function d.(P x Q), P = p - o, Q = q - o: 0 where the ray's line meets that of the edge.
int edge_sign(const Ray& ray, const Vec3& p, const Vec3& q) {
    const WholeScale of_points({&ray.origin, &p, &q}), of_direction({&ray.direction});
    if (of_points.fits() && of_direction.fits()) {
        // Differences are below 2^41, the cross product below 2^83, d.(P x Q) below 3 * 2^123.
        const WholeVec3 o = of_points(ray.origin), d = of_direction(ray.direction);
        const WholeVec3 n = cross(of_points(p) - o, of_points(q) - o);
        return sign_of(d.x * n.x + d.y * n.y + d.z * n.z);
    }
    return dot(ray.direction, cross(difference(p, ray.origin), difference(q, ray.origin))).sign();
}

/// Whether the ray's line passes through p: whether d x (p - o) is zero.
bool passes_through(const Ray& ray, const Vec3& p) {
    const WholeScale of_points({&ray.origin, &p}), of_direction({&ray.direction});
    if (of_points.fits() && of_direction.fits()) {
        const WholeVec3 n = cross(of_direction(ray.direction), of_points(p) - of_points(ray.origin));
        return n.x == 0 && n.y == 0 && n.z == 0;
    }
    const ExactVec3 to_p = difference(p, ray.origin);
    const DVec3 d(ray.direction);
    return (to_p.y * d.z - to_p.z * d.y).sign() == 0 && (to_p.z * d.x - to_p.x * d.z).sign() == 0 &&
           (to_p.x * d.y - to_p.y * d.x).sign() == 0;
}

/// Corners that two triangles have in common.
struct SharedCorners {
    const Vec3* corners[3];
    int count = 0;

    SharedCorners(const Triangle& s, const Triangle& t) {
        for (const Vec3* corner : {&s.a, &s.b, &s.c})
            if (*corner == t.a || *corner == t.b || *corner == t.c) corners[count++] = corner;
    }
    /// Whether the ray's line meets the one edge or vertex that is shared.
    bool are_met(const Ray& ray) const {
        if (count == 1) return passes_through(ray, *corners[0]);
        return count == 2 && edge_sign(ray, *corners[0], *corners[1]) == 0;
    }
};

/// Whether all corners of both triangles lie in one axis plane.
bool share_axis_plane(const Triangle& s, const Triangle& t) {
    for (int axis = 0; axis < 3; ++axis) {
        const float plane = s.a[axis];
        if (s.b[axis] == plane && s.c[axis] == plane && t.a[axis] == plane && t.b[axis] == plane &&
            t.c[axis] == plane)
            return true;
    }
    return false;
}

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

bool ClosestHit<Mode::Exact>::decide_exactly(const Triangle& triangle,
                                             const EdgeFilter<FilterBounds>::Functions& functions) const {
    // The closed triangle is hit if no two edge functions differ in sign; all zero means that its plane holds
    // the ray.
    const auto sign = [&](double rounded, const Vec3& p, const Vec3& q) {
        if (std::abs(rounded) > functions.bound) return (rounded > 0.0) == edges_.is_mirrored() ? -1 : 1;
        return edge_sign(ray_, p, q);
    };
    const int u = sign(functions.u, triangle.b, triangle.c);
    const int v = sign(functions.v, triangle.c, triangle.a);
    const int w = sign(functions.w, triangle.a, triangle.b);
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
    bool is_filtered = true;
    if (prim_ != kNoIndex && !is_surely_nearer) {
        if (prim == prim_) return true;  // a second reference to the best hit
        const SharedCorners shared(triangle, best_);
        if (shared.count == 3 || share_axis_plane(triangle, best_)) {
            // Copies (a model that stands twice in a scene), floors, walls: at the best hit's t, which is in
            // range, without any arithmetic.
            if (prim < prim_) {
                prim_ = prim;
                best_ = triangle;
            }
            return true;
        }
        const int order = shared.are_met(ray_) ? 0 : ExactT(ray_, triangle).compare(ExactT(ray_, best_));
        if (order > 0 || (order == 0 && prim > prim_)) return false;
        is_filtered = false;
    }
    if (!is_surely_in_range) {
        const ExactT exact(ray_, triangle);
        if (exact.compare(t_min) < 0 || (!std::isinf(ray_.t_max) && exact.compare(t_max) > 0)) return false;
        is_filtered = false;
    }
    best_ = triangle;
    prim_ = prim;
    t_lower_ = t.lower;
    t_upper_ = t.upper;
    limit_ = std::min(limit_, t.upper * RaySlabs::kPad);
    return is_filtered;
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

Hit ClosestHit<Mode::Fast>::hit(const Mesh& mesh) const {
    if (!hit_.is_hit()) return hit_;
    const Triangle triangle = mesh.triangle(hit_.prim);
    const Interval on_plane = interval_of_t<FilterBounds>(ray_, triangle);
    const double t = 0.5 * (on_plane.lower + on_plane.upper);
    if (!std::isfinite(t)) return hit_;  // seen edge-on
    const double origin = static_cast<double>(ray_.origin[kz_]), d = static_cast<double>(ray_.direction[kz_]);
    const double at_a = (static_cast<double>(triangle.a[kz_]) - origin) / d,
                 at_b = (static_cast<double>(triangle.b[kz_]) - origin) / d,
                 at_c = (static_cast<double>(triangle.c[kz_]) - origin) / d;
    const double on_triangle = std::clamp(t, std::min({at_a, at_b, at_c}), std::max({at_a, at_b, at_c}));
    return {std::clamp(static_cast<float>(on_triangle), ray_.t_min, ray_.t_max), hit_.prim};
}

}  // namespace boxwood
