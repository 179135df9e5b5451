#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/brute_force/brute_force.h"
#include "core/bvh/binned_sah.h"
#include "core/bvh/spatial_median.h"
#include "core/bvh/sweep_sah.h"

namespace boxwood {
namespace {

Vec3 random_point(Rng& rng, float extent) {
    const float x = rng.next(-extent, extent), y = rng.next(-extent, extent), z = rng.next(-extent, extent);
    return {x, y, z};
}

Mesh random_triangles(uint32_t count, float size, uint64_t seed) {
    Mesh mesh;
    Rng rng(seed);
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 center = random_point(rng, 1.0f);
        for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(center + random_point(rng, size));
        mesh.triangles.push_back(UVec3(3 * i, 3 * i + 1, 3 * i + 2));
    }
    return mesh;
}

std::vector<PrimRef> whole(const Mesh& mesh) {
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) refs.push_back({mesh.triangle(i).bounds(), i});
    return refs;
}

/// Random rays, and rays aimed at vertices, edges and along axes.
std::vector<Ray> rays_for(const Mesh& mesh, size_t count, uint64_t seed) {
    std::vector<Ray> rays;
    Rng rng(seed);
    for (size_t i = 0; i < count; ++i) {
        Ray ray;
        ray.origin = random_point(rng, 2.0f);
        Vec3 target = random_point(rng, 1.0f);
        if (i % 2 == 1) target = mesh.positions[rng.next_index(mesh.positions.size())];
        ray.direction = target - ray.origin;
        if (i % 7 == 0) ray.direction[static_cast<int>(i % 3)] = 0.0f;
        if (i % 11 == 0) ray.direction = Vec3(0.0f, -0.0f, i % 2 == 0 ? 1.0f : -3.0f);
        rays.push_back(ray);
    }
    return rays;
}

template <class Method>
void expect_same_hits_as_brute_force(const Mesh& mesh, const Method& method, Mode mode) {
    Task task;
    const std::vector<PrimRef> refs = whole(mesh);
    const Structure structure(method.build(mesh, refs, task));
    const Structure reference(BruteForceBuilder{}.build(mesh, refs, task));
    const std::vector<Ray> rays = rays_for(mesh, 2000, 5);
    std::vector<Hit> hits(rays.size()), expected(rays.size());
    std::vector<uint8_t> occluded(rays.size()), expected_occluded(rays.size());
    structure.closest_hits(mesh, rays, hits, mode, task);
    reference.closest_hits(mesh, rays, expected, mode, task);
    structure.any_hits(mesh, rays, occluded, mode, task);
    size_t hit_count = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(hits[i], expected[i]) << "ray " << i;
        EXPECT_EQ(occluded[i] != 0, expected[i].is_hit()) << "ray " << i;
        hit_count += expected[i].is_hit();
    }
    EXPECT_GT(hit_count, rays.size() / 10);
}

TEST(Bvh, FindsTheSameHitsAsBruteForce) {
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        for (const float size : {0.02f, 0.3f}) {
            const Mesh mesh = random_triangles(400, size, 1);
            expect_same_hits_as_brute_force(mesh, SpatialMedian{}, mode);
            expect_same_hits_as_brute_force(mesh, BinnedSah{}, mode);
            expect_same_hits_as_brute_force(mesh, SweepSah{}, mode);
        }
    }
}

template <class Method>
void expect_same_bytes_for_one_and_many_threads(const Method& method) {
    Task task;
    const Mesh mesh = random_triangles(20000, 0.02f, 2);
    const std::vector<PrimRef> refs = whole(mesh);
    const Bvh2 many = method.build(mesh, refs, task);
    const ThreadLimit limit(1);
    const Bvh2 one = method.build(mesh, refs, task);
    EXPECT_EQ(one.nodes, many.nodes);
    EXPECT_EQ(one.prims, many.prims);
}

TEST(Bvh, IsTheSameForOneAndManyThreads) {
    expect_same_bytes_for_one_and_many_threads(SpatialMedian{});
    expect_same_bytes_for_one_and_many_threads(BinnedSah{});
    expect_same_bytes_for_one_and_many_threads(SweepSah{});
}

template <class Method>
void expect_to_end(const Mesh& mesh, const Method& method) {
    Task task;
    const Bvh2 bvh = method.build(mesh, whole(mesh), task);
    EXPECT_EQ(bvh.prims.size(), mesh.triangle_count());
    for (const NodeView& node : bvh.list_nodes().nodes) EXPECT_LE(node.level, Bvh2::kMaxDepth);
}

TEST(Bvh, BuildersEndOnEqualBoxesAndOnGeometricChains) {
    Mesh equal = random_triangles(1, 0.5f, 3);
    equal.triangles.assign(5000, equal.triangles[0]);
    Mesh chain;
    for (uint32_t i = 0; i < 240; ++i) {
        const float s = std::ldexp(1.0f, static_cast<int>(i) - 120);
        for (const Vec3& corner : {Vec3(s, s, s), Vec3(2 * s, s, s), Vec3(s, 2 * s, s)}) {
            chain.positions.push_back(corner);
        }
        chain.triangles.push_back(UVec3(3 * i, 3 * i + 1, 3 * i + 2));
    }
    for (const Mesh& mesh : {Mesh{}, equal, chain}) {
        expect_to_end(mesh, SpatialMedian{});
        expect_to_end(mesh, BinnedSah{});
        expect_to_end(mesh, SweepSah{});
    }
}

TEST(Bvh, HoldsAPrimitiveOnceInEachLeaf) {
    Task task;
    const Mesh mesh = random_triangles(1, 0.5f, 4);
    const std::vector<PrimRef> refs(6, PrimRef{mesh.triangle(0).bounds(), 0});
    const Bvh2 bvh = BinnedSah{}.build(mesh, refs, task);
    EXPECT_EQ(bvh.prims, std::vector<uint32_t>{0});
    EXPECT_EQ(bvh.nodes.size(), 1u);
}

TEST(SweepSah, TakesTheCheapestOfAllSplits) {
    // Four unit boxes on a line at 0, 1, 10, 11: the cheapest split parts them two and two; by hand, with the
    // slab [0,2]x[0,1]x[0,1] on each side, cost = 1 + (2 * 5 + 2 * 5) / (12 + 1 + 12) < 4.
    Mesh mesh;
    std::vector<PrimRef> refs;
    for (const float x : {0.0f, 1.0f, 10.0f, 11.0f}) {
        refs.push_back(
            {Box{Vec3(x, 0.0f, 0.0f), Vec3(x + 1.0f, 1.0f, 1.0f)}, static_cast<uint32_t>(refs.size())});
    }
    Task task;
    const Bvh2 bvh = SweepSah{.max_leaf_size = 2}.build(mesh, refs, task);
    ASSERT_EQ(bvh.nodes.size(), 3u);
    EXPECT_EQ(bvh.nodes[1].upper.x, 2.0f);
    EXPECT_EQ(bvh.nodes[2].lower.x, 10.0f);
    EXPECT_EQ(bvh.prims, (std::vector<uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace boxwood
