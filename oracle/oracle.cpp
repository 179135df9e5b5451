#include "oracle/oracle.h"

#include <cmath>
#include <limits>

namespace boxwood::oracle {

namespace {

struct QVec3 {
    mpq_class x, y, z;

    explicit QVec3(const Vec3& v)
        : x(static_cast<double>(v.x)), y(static_cast<double>(v.y)), z(static_cast<double>(v.z)) {}
    QVec3(mpq_class x_, mpq_class y_, mpq_class z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
};

QVec3 operator-(const QVec3& a, const QVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
QVec3 cross(const QVec3& a, const QVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
mpq_class dot(const QVec3& a, const QVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

bool is_in_range(const Ray& ray, const mpq_class& t) {
    if (t < static_cast<double>(ray.t_min)) return false;
    return std::isinf(ray.t_max) || t <= static_cast<double>(ray.t_max);
}

}  // namespace

bool hits_line(const Ray& ray, const Triangle& triangle) {
    const QVec3 o(ray.origin), d(ray.direction);
    const QVec3 a = QVec3(triangle.a) - o, b = QVec3(triangle.b) - o, c = QVec3(triangle.c) - o;
    const int u = sgn(dot(d, cross(b, c))), v = sgn(dot(d, cross(c, a))), w = sgn(dot(d, cross(a, b)));
    return (u < 0 || v < 0 || w < 0) != (u > 0 || v > 0 || w > 0);
}

std::optional<mpq_class> plane_parameter(const Ray& ray, const Triangle& triangle) {
    const QVec3 a(triangle.a);
    const QVec3 normal = cross(QVec3(triangle.b) - a, QVec3(triangle.c) - a);
    const mpq_class denominator = dot(QVec3(ray.direction), normal);
    if (sgn(denominator) == 0) return std::nullopt;
    return mpq_class(dot(a - QVec3(ray.origin), normal) / denominator);
}

std::optional<mpq_class> intersect(const Ray& ray, const Triangle& triangle) {
    if (!hits_line(ray, triangle)) return std::nullopt;
    const std::optional<mpq_class> t = plane_parameter(ray, triangle);
    return t && is_in_range(ray, *t) ? t : std::nullopt;
}

std::optional<ExactHit> closest_hit(const Mesh& mesh, const Ray& ray) {
    std::optional<ExactHit> best;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const std::optional<mpq_class> t = intersect(ray, mesh.triangle(prim));
        if (t && (!best || *t < best->t)) best = ExactHit{prim, *t};
    }
    return best;
}

float round_to_float(const mpq_class& value) {
    // Truncated to double, at most a few floats away; then walk to the interval of half steps that holds the
    // value.
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    float f = static_cast<float>(value.get_d());
    if (std::isinf(f)) f = std::copysign(std::numeric_limits<float>::max(), f);
    const auto midpoint = [](float x, float y) -> mpq_class {
        const double beyond = std::copysign(0x1p128, static_cast<double>(std::isinf(x) ? x : y));
        const double p = std::isinf(x) ? beyond : static_cast<double>(x);
        const double q = std::isinf(y) ? beyond : static_cast<double>(y);
        return 0.5 * (p + q);
    };
    while (true) {
        const float above = std::nextafter(f, kInfinity), below = std::nextafter(f, -kInfinity);
        const mpq_class upper = midpoint(f, above), lower = midpoint(below, f);
        if (value > upper) {
            f = above;
        } else if (value < lower) {
            f = below;
        } else if (value == upper) {
            return static_cast<float>(upper.get_d());
        } else if (value == lower) {
            return static_cast<float>(lower.get_d());
        } else {
            return f;
        }
        if (std::isinf(f)) return f;
    }
}

bool meets(const Ray& ray, const Box& box) {
    mpq_class lower = static_cast<double>(ray.t_min);
    std::optional<mpq_class> upper;
    if (!std::isinf(ray.t_max)) upper = static_cast<double>(ray.t_max);
    for (int axis = 0; axis < 3; ++axis) {
        const mpq_class o = static_cast<double>(ray.origin[axis]),
                        d = static_cast<double>(ray.direction[axis]);
        const mpq_class box_lower = static_cast<double>(box.lower[axis]);
        const mpq_class box_upper = static_cast<double>(box.upper[axis]);
        if (sgn(d) == 0) {
            if (o < box_lower || o > box_upper) return false;
            continue;
        }
        mpq_class near = (box_lower - o) / d, far = (box_upper - o) / d;
        if (near > far) std::swap(near, far);
        if (near > lower) lower = near;
        if (!upper || far < *upper) upper = far;
    }
    return !upper || lower <= *upper;
}

}  // namespace boxwood::oracle
