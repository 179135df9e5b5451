#include "core/wide_bvh/sampled_cost.h"

#include <gtest/gtest.h>

#include "core/bvh/binned_sah.h"
#include "core/refs/prim_ref.h"
#include "core/scene/scene.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

WideBvh<16> wide_of(const Mesh& mesh) {
    Task task;
    const std::vector<PrimRef> refs = whole_refs(mesh);
    return Collapse<16>{}.apply(mesh, refs, BinnedSah{}.build(mesh, refs, task), task);
}

/// Sixteen walls across the x axis, at x = 0, 1, 2, ...: two packs of eight, so two children of the root.
Mesh walls() {
    Mesh mesh;
    for (uint32_t i = 0; i < 16; ++i) {
        const auto x = static_cast<float>(i);
        for (const Vec3& corner : {Vec3(x, 0, 0), Vec3(x, 4, 0), Vec3(x, 0, 4)})
            mesh.positions.push_back(corner);
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

Ray along_x(float x, float y) {
    Ray ray;
    ray.origin = {x, y, 1.0f};
    ray.direction = {1.0f, 0.0f, 0.0f};
    return ray;
}

TEST(SampledCost, IsThatOfTheBoxesAndTrianglesMet) {
    const Mesh mesh = walls();
    const WideBvh<16> bvh = wide_of(mesh);
    ASSERT_EQ(bvh.packs.size(), 2u);
    const Task task;
    const auto cost = [&](std::initializer_list<Ray> rays, const WideCosts& costs) {
        return sampled_cost(bvh, mesh, std::vector<Ray>(rays), costs, task);
    };
    // The root's box and those of its two children; the eight triangles of the nearer leaf.
    EXPECT_EQ(cost({along_x(-1.0f, 1.0f)}, {1.0, 0.0}), 3.0 / 16.0);
    EXPECT_EQ(cost({along_x(-1.0f, 1.0f)}, {0.0, 1.0}), 1.0);
    EXPECT_EQ(cost({along_x(-1.0f, 1.0f)}, {1.0, 0.5}), 3.0 / 16.0 + 0.5);
    // A ray through the boxes beside the triangles tests all; one from behind the last wall none.
    EXPECT_EQ(cost({along_x(-1.0f, 3.5f)}, {0.0, 1.0}), 2.0);
    EXPECT_EQ(cost({along_x(15.5f, 1.0f)}, {0.0, 1.0}), 0.0);
    EXPECT_EQ(cost({along_x(-1.0f, 1.0f), along_x(-1.0f, 3.5f), along_x(15.5f, 1.0f)}, {0.0, 1.0}), 1.0);
    EXPECT_EQ(cost({}, {1.0, 1.0}), 0.0);
}

TEST(SampledCost, ViewersStandInTheSceneAndSeeABounceOfWhatTheyHit) {
    Task task;
    const auto scene = open_scene("cornell", task);
    const WideBvh<16> bvh = wide_of(scene->mesh);
    constexpr size_t kViewers = 500;
    const std::vector<Ray> rays = viewer_rays(scene->mesh, bvh, kViewers, task);
    std::vector<Hit> hits(kViewers);
    bvh.closest_hits(scene->mesh, std::span(rays).first(kViewers), hits, Mode::Exact, task);
    ASSERT_EQ(rays.size(), kViewers + static_cast<size_t>(std::ranges::count_if(hits, &Hit::is_hit)));
    ASSERT_GT(rays.size(), kViewers + kViewers / 2);
    DVec3 sum(0.0);
    for (size_t i = 0; i < kViewers; ++i) {
        EXPECT_TRUE(scene->mesh.bounds().contains({rays[i].origin, rays[i].origin}));
        EXPECT_NEAR(glm::length(DVec3(rays[i].direction)), 1.0, 1e-6);
        sum += DVec3(rays[i].direction);
    }
    EXPECT_LT(glm::length(sum / double{kViewers}), 0.1) << "some directions are more frequent";
    size_t next = kViewers;
    for (size_t i = 0; i < kViewers; ++i) {
        if (!hits[i].is_hit()) continue;
        const Ray& bounced = rays[next++];
        const Triangle triangle = scene->mesh.triangle(hits[i].prim);
        const DVec3 normal =
            glm::cross(DVec3(triangle.b) - DVec3(triangle.a), DVec3(triangle.c) - DVec3(triangle.a));
        EXPECT_LE(glm::dot(normal, DVec3(rays[i].direction)) * glm::dot(normal, DVec3(bounced.direction)),
                  0.0)
            << "goes on behind the surface";
        const DVec3 point = DVec3(rays[i].origin) + static_cast<double>(hits[i].t) * DVec3(rays[i].direction);
        EXPECT_LT(glm::distance(point, DVec3(bounced.origin)), 1e-3);
    }
    EXPECT_EQ(viewer_rays(scene->mesh, bvh, 10, task).front().origin, rays.front().origin);
}

}  // namespace
}  // namespace boxwood
