#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <functional>

#include "core/bvh/binned_sah.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/wide_bvh/collapse.h"
#include "core/wide_bvh/plain_hits.h"
#include "support/random_mesh.h"
#include "support/simd_targets.h"

namespace boxwood {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Primary rays; random ones; rays aimed at vertices, from outside and from other vertices, some along axes
/// or almost, some that end or begin at the vertex; and rays that the float tracer leaves to the plain one.
std::vector<Ray> rays_of(const Scene& scene) {
    const Mesh& mesh = scene.mesh;
    Box box;
    for (const Vec3& p : mesh.positions) box.extend(p);
    std::vector<Ray> rays;
    const CameraFrame frame = camera_frame(scene.camera.value_or(fit_camera(box)), 1.0);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) rays.push_back(camera_ray(frame, x + 0.5, y + 0.5, 20, 20));
    Rng rng(1);
    const auto vertex = [&] { return mesh.positions[rng.next_index(mesh.positions.size())]; };
    const Vec3 center = 0.5f * (box.lower + box.upper);
    const float size = glm::length(box.upper - box.lower);
    for (int i = 0; i < 800; ++i) {
        Ray ray;
        ray.origin = i % 4 == 0 ? vertex() : center + random_point(rng, 0.6f * size);
        const Vec3 target = i % 3 == 0 ? center + random_point(rng, 0.5f * size) : vertex();
        ray.direction = target - ray.origin;
        if (i % 7 == 0) ray.direction[i % 3] *= 0.0f;
        if (i % 11 == 0) ray.direction[i % 3] *= 0x1p-60f;
        if (i % 13 == 0) ray.t_max = 1.0f;
        if (i % 17 == 0) ray.t_min = 1.0f;
        if (i % 101 == 0) ray.direction *= 0x1p-100f;
        if (i % 103 == 0) ray.origin *= 0x1p60f;
        if (i % 107 == 0) ray.direction = Vec3(0.0f);
        if (i % 109 == 0) ray.origin.y = kInfinity;
        if (i % 113 == 0) ray.t_min = 2.0f * (ray.t_max = 1.0f);
        rays.push_back(ray);
    }
    return rays;
}

template <Mode mode, uint32_t Width>
void expect_plain_hits(const WideBvh<Width>& bvh, const Mesh& mesh, const std::vector<Ray>& rays) {
    const Task task;
    std::vector<Hit> expected(rays.size()), hits(rays.size());
    std::vector<uint8_t> expected_any(rays.size()), any(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        expected[i] = plain_closest_hit<mode>(bvh, mesh, rays[i], task);
        expected_any[i] = plain_any_hit<mode>(bvh, mesh, rays[i], task) ? 1 : 0;
        ASSERT_EQ(expected_any[i] != 0, expected[i].is_hit());
    }
    for_each_target(HWY_TARGETS, [&](const SimdTarget& target) {
        bvh.closest_hits(mesh, rays, hits, mode, task);
        bvh.any_hits(mesh, rays, any, mode, task);
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(std::bit_cast<uint32_t>(hits[i].t), std::bit_cast<uint32_t>(expected[i].t))
                << target.name() << ", ray " << i;
            ASSERT_EQ(hits[i].prim, expected[i].prim) << target.name() << ", ray " << i;
            ASSERT_EQ(any[i], expected_any[i]) << target.name() << ", ray " << i;
        }
    });
}

class WideTracer : public testing::TestWithParam<const char*> {};

TEST_P(WideTracer, FindsThePlainTracersHitsWithEveryInstructionSet) {
    Task task;
    const auto scene = open_scene(GetParam(), task);
    const Mesh& mesh = scene->mesh;
    const std::vector<Ray> rays = rays_of(*scene);
    const Bvh2 bvh = BinnedSah{}.build(mesh, whole_refs(mesh), task);
    const WideBvh<4> four = Collapse<4>{}.apply(mesh, {}, bvh, task);
    const WideBvh<8> eight = Collapse<8>{}.apply(mesh, {}, bvh, task);
    const WideBvh<16> sixteen = Collapse<16>{}.apply(mesh, {}, bvh, task);
    expect_plain_hits<Mode::Exact>(four, mesh, rays);
    expect_plain_hits<Mode::Fast>(four, mesh, rays);
    expect_plain_hits<Mode::Exact>(eight, mesh, rays);
    expect_plain_hits<Mode::Fast>(eight, mesh, rays);
    expect_plain_hits<Mode::Exact>(sixteen, mesh, rays);
    expect_plain_hits<Mode::Fast>(sixteen, mesh, rays);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WideTracer, testing::Values("atrium", "spaceship"));

}  // namespace
}  // namespace boxwood
