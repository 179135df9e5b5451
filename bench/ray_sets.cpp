#include "bench/ray_sets.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/rng.h"
#include "core/base/sampling.h"
#include "core/measure/verify.h"
#include "core/structure/leaving_ray.h"

namespace boxwood::bench {

namespace {

class Hasher {
public:
    void add(uint32_t bits) { state_ = mix_bits((state_ ^ bits) + 0x9e3779b97f4a7c15ull); }
    void add(float value) { add(std::bit_cast<uint32_t>(value)); }
    void add(const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) add(v[axis]);
    }
    uint64_t value() const { return state_; }

private:
    uint64_t state_ = 0;
};

Ray bounce(const Mesh& mesh, const Ray& ray, const Hit& hit, const Vec2& point) {
    const DVec3 normal = facing_normal(mesh.triangle(hit.prim), glm::normalize(DVec3(ray.direction)));
    return leaving_ray(ray, hit, normal, cosine_direction(normal, point));
}

}  // namespace

std::vector<Ray> primary_rays(const Camera& camera, size_t count) {
    const int size = static_cast<int>(std::sqrt(static_cast<double>(count)));
    const CameraFrame frame = camera_frame(camera, 1.0);
    std::vector<Ray> rays;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) rays.push_back(camera_ray(frame, x + 0.5, y + 0.5, size, size));
    return rays;
}

std::vector<Ray> diffuse_rays(const Structure& structure, const Mesh& mesh, std::span<const Ray> primary,
                              size_t count, Task& task) {
    const std::vector<Hit> hits = boxwood::closest_hits(structure, mesh, primary, Mode::Exact, task);
    std::vector<Ray> rays;
    if (std::ranges::none_of(hits, &Hit::is_hit)) return rays;
    rays.reserve(count);
    for (uint32_t round = 0; rays.size() < count; ++round) {
        for (size_t i = 0; i < hits.size() && rays.size() < count; ++i) {
            if (!hits[i].is_hit()) continue;
            const Vec2 point = sequence_point(static_cast<uint32_t>(i), round, 1);
            rays.push_back(bounce(mesh, primary[i], hits[i], point));
        }
    }
    return rays;
}

std::vector<Ray> bounced_rays(const Mesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits) {
    std::vector<Ray> bounced;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].is_hit()) continue;
        bounced.push_back(
            bounce(mesh, rays[i], hits[i], sequence_point(static_cast<uint32_t>(i), 0, /*bounce=*/1)));
    }
    return bounced;
}

std::vector<Ray> shadow_rays(const Mesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits,
                             const Vec3& light) {
    std::vector<Ray> shadows;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].is_hit()) continue;
        const DVec3 normal =
            facing_normal(mesh.triangle(hits[i].prim), glm::normalize(DVec3(rays[i].direction)));
        Ray ray = leaving_ray(rays[i], hits[i], normal, normal);
        const DVec3 to_light = DVec3(light) - DVec3(ray.origin);
        if (!(glm::dot(normal, to_light) > 0.0)) continue;
        ray.direction = Vec3(to_light);
        ray.t_max = 1.0f;
        shadows.push_back(ray);
    }
    return shadows;
}

Vec3 light_by_camera(const Camera& camera, const Structure& structure, const Mesh& mesh) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    const DVec3 way = glm::normalize(frame.up + 0.5 * frame.right);
    Ray ray;
    ray.origin = camera.eye;
    ray.direction = Vec3(way);
    Hit hit;
    structure.closest_hits(mesh, std::span(&ray, 1), std::span(&hit, 1), Mode::Exact, Task{});
    const double diagonal = glm::length(DVec3(mesh.bounds().extent()));
    return Vec3(frame.eye + way * (0.5 * std::min(diagonal, static_cast<double>(hit.t))));
}

uint64_t hash_of(std::span<const Ray> rays) {
    Hasher hasher;
    for (const Ray& ray : rays) {
        hasher.add(ray.origin);
        hasher.add(ray.t_min);
        hasher.add(ray.direction);
        hasher.add(ray.t_max);
    }
    return hasher.value();
}

uint64_t hash_of(std::span<const Hit> hits) {
    Hasher hasher;
    for (const Hit& hit : hits) {
        hasher.add(hit.t);
        hasher.add(hit.prim);
    }
    return hasher.value();
}

uint64_t hash_of(std::span<const uint8_t> occluded) {
    Hasher hasher;
    for (const uint8_t one : occluded) hasher.add(uint32_t{one});
    return hasher.value();
}

}  // namespace boxwood::bench
