#include "core/structure/leaving_ray.h"

#include <algorithm>
#include <cmath>

namespace boxwood {

namespace {

double largest(const DVec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

DVec3 facing_normal(const Triangle& triangle, const DVec3& direction) {
    const DVec3 a(triangle.a);
    const DVec3 normal = glm::cross(DVec3(triangle.b) - a, DVec3(triangle.c) - a);
    const double length = std::sqrt(glm::dot(normal, normal));
    if (!(length > 0.0)) return -direction;
    return glm::dot(normal, direction) > 0.0 ? normal / -length : normal / length;
}

Ray leaving_ray(const Ray& ray, const Hit& hit, const DVec3& normal, const DVec3& direction) {
    const DVec3 step = static_cast<double>(hit.t) * DVec3(ray.direction);
    const DVec3 point = DVec3(ray.origin) + step;
    const double offset = (largest(point) + largest(step)) * 0x1p-22;
    Ray leaving;
    leaving.origin = Vec3(point + offset * normal);
    leaving.direction = Vec3(direction);
    return leaving;
}

}  // namespace boxwood
