#include "core/measure/verify.h"

#include <bit>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/scene/camera.h"

namespace boxwood {
namespace {

constexpr size_t kBatch = 256;  ///< rays between two looks at the clock of other threads

/// Draws one ray after the other; every number in a statement of its own, so that all compilers draw alike.
class RaySource {
public:
    RaySource(const Scene& scene, uint64_t seed) : mesh_(scene.mesh), box_(mesh_.bounds()), rng_(seed) {
        const Camera fitted = fit_camera(box_);
        fitted_ = camera_frame(fitted, 1.0);
        own_ = camera_frame(scene.camera.value_or(fitted), 1.0);
    }

    Ray next(size_t index) {
        switch (index % 4) {
            case 0:
                return through_pixel(index % 8 == 0 ? own_ : fitted_);
            case 1:
                return between_points();
            case 2:
                return at_triangle();
            default:
                return along_axis();
        }
    }

private:
    Vec3 point_of_box() {
        const float x = rng_.next(), y = rng_.next(), z = rng_.next();
        return Vec3(DVec3(box_.lower) + DVec3(Vec3(x, y, z)) * box_.extent());
    }
    Ray through_pixel(const CameraFrame& frame) {
        constexpr int kSize = 1024;
        const double x = 0.5 + static_cast<double>(rng_.next_index(kSize));
        const double y = 0.5 + static_cast<double>(rng_.next_index(kSize));
        return camera_ray(frame, x, y, kSize, kSize);
    }
    Ray between_points() {
        Ray ray;
        ray.origin = point_of_box();
        ray.direction = point_of_box() - ray.origin;
        if (rng_.next() < 0.5f) ray.t_max = 1.0f;
        return ray;
    }
    /// At a vertex, a point of an edge or an inner point.
    Ray at_triangle() {
        const Triangle triangle = random_triangle();
        const float f = rng_.next(), g = rng_.next();
        const uint64_t kind = rng_.next_index(3);
        Vec3 target = triangle.a;
        if (kind > 0) target += f * (triangle.b - triangle.a);
        if (kind > 1) target += (1.0f - f) * g * (triangle.c - triangle.a);
        Ray ray;
        ray.origin = point_of_box();
        ray.direction = target - ray.origin;
        return ray;
    }
    /// Through coordinates of vertices, which often lie in faces of boxes.
    Ray along_axis() {
        const Triangle triangle = random_triangle();
        const int axis = static_cast<int>(rng_.next_index(3));
        const bool backward = rng_.next() < 0.5f;
        const uint64_t mixed = rng_.next_index(3);
        Ray ray;
        ray.origin = mixed == 0 ? triangle.a : triangle.b;
        if (mixed == 1) ray.origin = 0.5f * triangle.a + 0.5f * triangle.b;
        const float near = rng_.next() < 0.5f ? point_of_box()[axis] : box_.lower[axis];
        ray.origin[axis] = backward ? box_.upper[axis] : near;
        ray.direction = Vec3(0.0f);
        ray.direction[axis] = backward ? -1.0f : 1.0f;
        return ray;
    }
    Triangle random_triangle() {
        return mesh_.triangle(static_cast<uint32_t>(rng_.next_index(mesh_.triangle_count())));
    }

    const Mesh& mesh_;
    Box box_;
    Rng rng_;
    CameraFrame fitted_, own_;
};

bool same(const Hit& a, const Hit& b) {
    return a.prim == b.prim && std::bit_cast<uint32_t>(a.t) == std::bit_cast<uint32_t>(b.t);
}

}  // namespace

std::vector<Ray> verification_rays(const Scene& scene, size_t count, uint64_t seed) {
    std::vector<Ray> rays;
    if (scene.mesh.triangle_count() == 0) return rays;
    rays.reserve(count);
    RaySource source(scene, seed);
    for (size_t i = 0; i < count; ++i) rays.push_back(source.next(i));
    return rays;
}

std::vector<Hit> closest_hits(const Structure& structure, const Mesh& mesh, std::span<const Ray> rays,
                              Mode mode, Task& task) {
    std::vector<Hit> hits(rays.size());
    task.done = 0;
    task.total = rays.size();
    parallel_for(rays.size(), kBatch, [&](size_t begin, size_t end) {
        structure.closest_hits(mesh, rays.subspan(begin, end - begin),
                               std::span(hits).subspan(begin, end - begin), mode, task);
        task.done += end - begin;
    });
    return hits;
}

Disagreement compare_hits(const Structure& structure, const Mesh& mesh, std::span<const Ray> rays,
                          std::span<const Hit> expected, Mode mode, Task& task) {
    const std::vector<Hit> hits = closest_hits(structure, mesh, rays, mode, task);
    std::vector<uint8_t> occluded(rays.size());
    parallel_for(rays.size(), kBatch, [&](size_t begin, size_t end) {
        structure.any_hits(mesh, rays.subspan(begin, end - begin),
                           std::span(occluded).subspan(begin, end - begin), mode, task);
    });
    Disagreement result;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (same(hits[i], expected[i]) && (occluded[i] != 0) == expected[i].is_hit()) continue;
        if (result.wrong++ > 0) continue;
        result.first = i;
        result.found = hits[i];
        result.occluded = occluded[i] != 0;
    }
    return result;
}

}  // namespace boxwood
