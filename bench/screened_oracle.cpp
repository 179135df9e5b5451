#include "bench/screened_oracle.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/structure/closest.h"

namespace boxwood::bench {

namespace {

/// Relative slack of the screen; 2^13 units of 2^-53.
constexpr double kSlack = 1e-12;

/// Whether the closed box can hold a hit with t <= limit. A plane's t = (plane - o) / d is off by two
/// roundings, 2.01 units of 2^-53 of itself; kSlack is 4000 times that.
bool may_meet(const Ray& ray, const Box& box, double limit) {
    double t0 = static_cast<double>(ray.t_min), t1 = limit;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = static_cast<double>(ray.origin[axis]), d = static_cast<double>(ray.direction[axis]);
        const double lower = static_cast<double>(box.lower[axis]) - o;
        const double upper = static_cast<double>(box.upper[axis]) - o;
        if (d == 0.0) {
            if (lower > 0.0 || upper < 0.0) return false;  // signs of differences are exact
            continue;
        }
        t0 = std::max(t0, (d > 0.0 ? lower : upper) / d);
        t1 = std::min(t1, (d > 0.0 ? upper : lower) / d);
    }
    return t0 - kSlack * std::abs(t0) <= t1 + kSlack * std::abs(t1);
}

/// Whether the ray's line may meet the closed triangle. Each edge function d.(B x C), B = b - o, has six
/// monomials of size at most |d| m^2, m = max|A|, |B|, |C|; each is off by five roundings of its own and at
/// most three of the sums: in all less than 50 units of 2^-53 of |d| m^2. kSlack is 180 times that.
bool may_hit(const Ray& ray, const Triangle& triangle) {
    const DVec3 o(ray.origin), d(ray.direction);
    const DVec3 a = DVec3(triangle.a) - o, b = DVec3(triangle.b) - o, c = DVec3(triangle.c) - o;
    const double u = glm::dot(d, glm::cross(b, c)), v = glm::dot(d, glm::cross(c, a)),
                 w = glm::dot(d, glm::cross(a, b));
    const double m2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    const double margin = kSlack * m2 * std::sqrt(glm::dot(d, d));
    return !(std::min({u, v, w}) < -margin && std::max({u, v, w}) > margin);
}

}  // namespace

ScreenedOracle::ScreenedOracle(const Mesh& mesh) : mesh_(mesh) {
    const auto count = static_cast<uint32_t>(mesh.triangle_count());
    for (uint32_t first = 0; first < count; first += kBlock) {
        Box box;
        for (uint32_t prim = first; prim < std::min(first + kBlock, count); ++prim) {
            const Triangle triangle = mesh.triangle(prim);
            for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) box.extend(corner);
        }
        blocks_.push_back(box);
    }
}

std::optional<oracle::ExactHit> ScreenedOracle::closest_hit(const Ray& ray) const {
    std::optional<oracle::ExactHit> best;
    double limit = static_cast<double>(ray.t_max);  // no t beyond it counts; of the best hit: rounded down
    for (size_t block = 0; block < blocks_.size(); ++block) {
        if (!may_meet(ray, blocks_[block], limit)) continue;
        const auto first = static_cast<uint32_t>(block) * kBlock;
        const auto end = std::min(first + kBlock, static_cast<uint32_t>(mesh_.triangle_count()));
        for (uint32_t prim = first; prim < end; ++prim) {
            const Triangle triangle = mesh_.triangle(prim);
            if (!may_hit(ray, triangle)) continue;
            const std::optional<mpq_class> t = oracle::intersect(ray, triangle);
            if (!t || (best && *t >= best->t)) continue;
            best = oracle::ExactHit{prim, *t};
            limit = t->get_d();
        }
    }
    return best;
}

std::vector<std::optional<oracle::ExactHit>> closest_hits(const ScreenedOracle& oracle,
                                                          std::span<const Ray> rays) {
    std::vector<std::optional<oracle::ExactHit>> hits(rays.size());
    parallel_for(rays.size(), 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            if (is_valid(rays[i])) hits[i] = oracle.closest_hit(rays[i]);
    });
    return hits;
}

}  // namespace boxwood::bench
