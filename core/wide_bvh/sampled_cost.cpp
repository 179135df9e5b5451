#include "core/wide_bvh/sampled_cost.h"

#include <atomic>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/sampling.h"
#include "core/structure/leaving_ray.h"

namespace boxwood {

namespace {

constexpr uint64_t kSeed = 1;
constexpr size_t kGrain = 64;  ///< rays that a thread takes at once

DVec3 any_direction(Rng& rng) {
    const double z = 1.0 - 2.0 * static_cast<double>(rng.next());
    const SinCos turn = sin_cos_of_turn(static_cast<double>(rng.next()));
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {radius * turn.cosine, radius * turn.sine, z};
}

Ray any_ray(const Box& box, Rng& rng) {
    const DVec3 lower(box.lower), upper(box.upper);
    DVec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = static_cast<double>(rng.next());
    Ray ray;
    ray.origin = Vec3(lower + place * (upper - lower));
    ray.direction = Vec3(any_direction(rng));
    return ray;
}

}  // namespace

std::vector<Ray> viewer_rays(const Mesh& mesh, const WideBvh<16>& bvh, size_t viewers, const Task& task) {
    const Box box = mesh.bounds();
    Rng rng(kSeed);
    std::vector<Ray> rays(viewers);
    for (Ray& ray : rays) ray = any_ray(box, rng);
    std::vector<Hit> hits(viewers);
    parallel_for(viewers, kGrain, [&](size_t begin, size_t end) {
        bvh.closest_hits(mesh, std::span(rays).subspan(begin, end - begin),
                         std::span(hits).subspan(begin, end - begin), Mode::Exact, task);
    });
    for (size_t i = 0; i < viewers && !task.stopped(); ++i) {
        const Vec2 point(rng.next(), rng.next());
        if (!hits[i].is_hit()) continue;
        const DVec3 normal = facing_normal(mesh.triangle(hits[i].prim), DVec3(rays[i].direction));
        rays.push_back(leaving_ray(rays[i], hits[i], normal, cosine_direction(normal, point)));
    }
    return rays;
}

double sampled_cost(const WideBvh<16>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                    const WideCosts& costs, const Task& task) {
    std::atomic<uint64_t> boxes{0}, triangles{0};
    parallel_for(rays.size(), kGrain, [&](size_t begin, size_t end) {
        Count count;
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            ClosestHit<Mode::Exact> closest(rays[i]);
            bvh.closest_hit(mesh, closest, count);
        }
        boxes += count.nodes;
        triangles += count.tests;
    });
    using Bvh = WideBvh<16>;
    const double sum = costs.node / Bvh::kWidth * static_cast<double>(boxes.load()) +
                       costs.pack / Bvh::Pack::kSize * static_cast<double>(triangles.load());
    return rays.empty() ? 0.0 : sum / static_cast<double>(rays.size());
}

}  // namespace boxwood
