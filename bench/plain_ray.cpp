#include "bench/plain_ray.h"

#include <algorithm>
#include <cmath>

namespace boxwood::bench {

bool is_plain(const Mesh& mesh, const Ray& ray, float t) {
    // In double, which is far finer than the margin.
    const DVec3 o(ray.origin), d = glm::normalize(DVec3(ray.direction));
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const Triangle triangle = mesh.triangle(prim);
        const DVec3 a = DVec3(triangle.a) - o, b = DVec3(triangle.b) - o, c = DVec3(triangle.c) - o;
        const double u = glm::dot(d, glm::cross(b, c)), v = glm::dot(d, glm::cross(c, a)),
                     w = glm::dot(d, glm::cross(a, b));
        const double m = std::max({glm::length(a), glm::length(b), glm::length(c)});
        const double margin = 1e-6 * m * m;
        const double least = std::min({u, v, w}), greatest = std::max({u, v, w});
        if (least < -margin && greatest > margin) continue;  // clearly beside it
        if (std::min({std::abs(u), std::abs(v), std::abs(w)}) <= margin) return false;
    }
    const auto is_near = [&](float end) { return std::isfinite(end) && std::abs(t - end) <= 1e-5f * end; };
    return !is_near(ray.t_min) && !is_near(ray.t_max);
}

}  // namespace boxwood::bench
