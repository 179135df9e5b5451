#include "core/bvh/late_split_clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "core/base/parallel.h"
#include "core/bvh/binned_sah.h"
#include "core/bvh/object_median.h"
#include "core/scene/load_file.h"
#include "oracle/polygon.h"
#include "support/all_recipes.h"
#include "support/processor_time.h"
#include "support/random_mesh.h"
#include "support/skipped.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

LateSplitClipping absolute(double sa, int budget) {
    return {.limit = {.absolute = true, .value = sa}, .budget = budget};
}

/// A BVH whose only node is a leaf with all of at most 64 triangles.
Bvh2 one_leaf(const Mesh& mesh) {
    Task task;
    return ObjectMedian{.max_leaf_size = 64}.build(mesh, whole_refs(mesh), task);
}

LateSplitBvh cut(const Mesh& mesh, const LateSplitClipping& method, const Bvh2& input) {
    Task task;
    return method.apply(mesh, {}, input, task);
}

Box box_of(const LateSplitBvh::Node& node) { return {node.lower, node.upper}; }

TEST(LateSplitClipping, CutsALeafAsComputedByHand) {
    // As for early split clipping: box 8 x 4 x 0, area 64; cut at x = 4, where the edge is at y = 2; the left
    // half, area 32, at x = 2, where it is at y = 3. The levels go on below the original leaf.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 0, 0}, {0, 4, 0}}});
    const Bvh2 input = one_leaf(mesh);
    EXPECT_EQ(cut(mesh, absolute(64, 3), input).nodes.size(), 1u);  // the limit itself is not cut
    const LateSplitBvh bvh = cut(mesh, absolute(16, 3), input);
    ASSERT_EQ(bvh.nodes.size(), 5u);
    EXPECT_EQ(bvh.original_count, 1u);
    EXPECT_EQ(box_of(bvh.nodes[0]), (Box{{0, 0, 0}, {8, 4, 0}}));
    EXPECT_EQ(box_of(bvh.nodes[1]), (Box{{0, 0, 0}, {4, 4, 0}}));
    EXPECT_EQ(box_of(bvh.nodes[2]), (Box{{4, 0, 0}, {8, 2, 0}}));
    EXPECT_EQ(box_of(bvh.nodes[3]), (Box{{0, 0, 0}, {2, 4, 0}}));
    EXPECT_EQ(box_of(bvh.nodes[4]), (Box{{2, 0, 0}, {4, 3, 0}}));
    EXPECT_EQ(bvh.prims, (std::vector<uint32_t>{0, 0, 0}));
    const NodeList list = bvh.list_nodes();
    EXPECT_EQ(check_nodes(list, 1), "");
    EXPECT_EQ(list.nodes[4].level, 2u);
    // The largest box first: with a budget of two references only the root is cut.
    Task task;
    EXPECT_EQ(absolute(16, 2).apply(mesh, {}, input, task).nodes.size(), 3u);
    EXPECT_EQ(skipped(task, "over the reference budget"), 1u);
    // SA_max as a fraction of the root's area of 64.
    const LateSplitClipping relative{.limit = {.absolute = false, .value = 2.0}, .budget = 3};
    EXPECT_EQ(cut(mesh, relative, input).nodes, bvh.nodes);
}

TEST(LateSplitClipping, ADeepLeafHoldsExactlyTheTrianglesThatTouchItsClosedCell) {
    // Corners on a coarse grid, so that cuts run through corners, along edges and in the triangles' planes.
    Rng rng(1);
    std::vector<Triangle> triangles;
    for (int i = 0; i < 24; ++i) {
        Vec3 corners[3];
        for (Vec3& corner : corners)
            for (int axis = 0; axis < 3; ++axis) corner[axis] = static_cast<float>(rng.next_index(5));
        if (glm::cross(corners[1] - corners[0], corners[2] - corners[0]) == Vec3(0)) continue;
        triangles.push_back({corners[0], corners[1], corners[2]});
    }
    const Mesh mesh = make_mesh(triangles);
    const LateSplitBvh bvh = cut(mesh, absolute(3.0, 1024), one_leaf(mesh));
    EXPECT_GT(bvh.nodes.size(), 100u);
    std::vector<uint32_t> all(triangles.size());
    for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    // `cell` contains what of the triangles is in this node; each half of the node's box likewise.
    const std::function<void(uint32_t, const Box&)> check = [&](uint32_t n, const Box& cell) {
        const LateSplitBvh::Node& node = bvh.nodes[n];
        ASSERT_TRUE(cell.contains(box_of(node)));
        if (node.is_leaf()) {
            std::vector<uint32_t> expected;
            for (const uint32_t prim : all)
                if (oracle::touches(mesh.triangle(prim), cell)) expected.push_back(prim);
            const auto first = bvh.prims.begin() + node.first;
            ASSERT_EQ(std::vector<uint32_t>(first, first + node.count), expected);
            EXPECT_LE(box_of(node).surface_area(), 3.0);
            return;
        }
        const LateSplitPlane plane = late_split_plane(box_of(node));
        Box lower = box_of(node), upper = box_of(node);
        lower.upper[plane.axis] = upper.lower[plane.axis] = plane.position;
        check(node.first, lower);
        check(node.first + 1, upper);
    };
    check(0, mesh.bounds());
}

/// Rays on and off a grid, along axes, edges and cuts, with both zeros.
std::vector<Ray> grid_rays(int count) {
    std::vector<Ray> rays;
    Rng rng(2);
    for (int i = 0; i < count; ++i) {
        Ray ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = 0.5f * static_cast<float>(rng.next_index(17)) - 2.0f;
            ray.direction[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
            if (ray.direction[axis] == 0.0f && rng.next() < 0.5f) ray.direction[axis] = -0.0f;
        }
        if (i % 3 == 0) ray.origin += random_point(rng, 0.5f);
        if (ray.direction == Vec3(0.0f)) continue;
        rays.push_back(ray);
    }
    return rays;
}

void expect_the_hits_of_brute_force(const Mesh& mesh, const std::string& recipe,
                                    const std::vector<Ray>& rays) {
    Task task;
    const Structure structure = run(recipe, mesh).structure, reference = run("none", mesh).structure;
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        std::vector<Hit> hits(rays.size()), expected(rays.size());
        std::vector<uint8_t> occluded(rays.size());
        structure.closest_hits(mesh, rays, hits, mode, task);
        structure.any_hits(mesh, rays, occluded, mode, task);
        reference.closest_hits(mesh, rays, expected, mode, task);
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(hits[i], expected[i]) << recipe << ", ray " << i;
            ASSERT_EQ(occluded[i] != 0, expected[i].is_hit()) << recipe << ", ray " << i;
        }
    }
}

TEST(LateSplitBvh, DropsNothingThatCouldBeHitFirst) {
    // Triangles on a grid, some of them several times: equal t in walls, at edges and corners of cells.
    Rng rng(3);
    std::vector<Triangle> triangles;
    for (int i = 0; i < 60; ++i) {
        Vec3 corners[3];
        for (Vec3& corner : corners)
            for (int axis = 0; axis < 3; ++axis) corner[axis] = static_cast<float>(rng.next_index(5));
        if (i % 4 == 0) corners[0].z = corners[1].z = corners[2].z = static_cast<float>(i % 5);
        if (glm::cross(corners[1] - corners[0], corners[2] - corners[0]) == Vec3(0)) continue;
        triangles.push_back({corners[0], corners[1], corners[2]});
        if (i % 5 == 0) triangles.push_back({corners[1], corners[2], corners[0]});
    }
    const Mesh mesh = make_mesh(triangles);
    for (const char* recipe : {"bvh-object-median(max-leaf-size=64) > lsc(s=8, budget=512)",
                               "bvh-object-median(max-leaf-size=8) > lsc(s=9, budget=64)",
                               "bvh-object-median(max-leaf-size=1) > lsc(s=9, budget=64)",
                               "esc(s=4) > bvh-binned-sah > lsc(s=9, budget=64)"})
        expect_the_hits_of_brute_force(mesh, recipe, grid_rays(4000));
    const Mesh random = random_triangles(200, 1.0f, 4);
    expect_the_hits_of_brute_force(random, "bvh-spatial-median(max-leaf-size=32) > lsc(s=12, budget=64)",
                                   rays_for(random, 4000, 5));
}

Count count_of(const LateSplitBvh& bvh, const Mesh& mesh, const Ray& ray) {
    ClosestHit<Mode::Exact> closest(ray);
    Count count;
    bvh.closest_hit(mesh, closest, count);
    return count;
}

TEST(LateSplitBvh, TheOnlyTriangleOfALeafIsTestedOnce) {
    // A slanting triangle in very many cells, and rays that graze it without a hit: the first deep leaf that
    // is visited says all.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {16, 0, 16}, {0, 16, 16}}});
    const LateSplitBvh bvh = cut(mesh, absolute(2.0, 1024), one_leaf(mesh));
    EXPECT_GT(bvh.prims.size(), 500u);
    uint64_t most = 0;
    for (const Ray& ray : rays_for(mesh, 2000, 6)) most = std::max(most, count_of(bvh, mesh, ray).tests);
    for (const float z : {0.25f, 0.5f, 1.0f}) {
        const Ray grazing{.origin = Vec3(0, 0, z), .direction = Vec3(1, 0, 1)};
        most = std::max(most, count_of(bvh, mesh, grazing).tests);
    }
    EXPECT_EQ(most, 1u);
}

TEST(LateSplitBvh, AHitInADeepCellDropsTheCellsBehindIt) {
    // Two walls at x = 1 and x = 9 in one leaf, cut into cells: a ray along x that hits the first one tests
    // nothing of the second. From beyond the first it tests the second alone.
    std::vector<Triangle> triangles;
    for (const float x : {1.0f, 9.0f}) triangles.push_back({{x, 0, 0}, {x, 4, 0}, {x, 0, 4}});
    const Mesh mesh = make_mesh(triangles);
    const LateSplitBvh bvh = cut(mesh, absolute(20.0, 1024), one_leaf(mesh));
    EXPECT_EQ(count_of(bvh, mesh, {.origin = Vec3(0, 1, 1), .direction = Vec3(1, 0, 0)}).tests, 1u);
    EXPECT_EQ(count_of(bvh, mesh, {.origin = Vec3(2, 1, 1), .direction = Vec3(1, 0, 0)}).tests, 1u);
    EXPECT_EQ(count_of(bvh, mesh, {.origin = Vec3(0, 3.5f, 3.5f), .direction = Vec3(1, -0.2f, -0.2f)}).tests,
              1u);
}

TEST(LateSplitClipping, StaysInsideItsBudget) {
    const Mesh mesh = random_triangles(500, 1.0f, 7);
    Task task;
    const Bvh2 base = BinnedSah{}.build(mesh, whole_refs(mesh), task);
    for (const int budget : {1, 2, 5}) {
        const LateSplitClipping method{.limit = {.absolute = false, .value = 30.0}, .budget = budget};
        const LateSplitBvh bvh = cut(mesh, method, base);
        EXPECT_LE(bvh.prims.size(), base.prims.size() * static_cast<size_t>(budget));
        const size_t least = budget > 1 ? base.prims.size() * static_cast<size_t>(budget) * 3 / 4 : 0;
        EXPECT_GE(bvh.prims.size(), least);
        uint32_t most_depth = 0;
        for (const NodeView& node : bvh.list_nodes().nodes) most_depth = std::max(most_depth, node.level);
        EXPECT_LE(most_depth, Bvh2::kMaxDepth);
    }
    EXPECT_EQ(cut(mesh, LateSplitClipping{.limit = {.absolute = false, .value = 0.0}}, base).nodes,
              base.nodes);
}

TEST(LateSplitClipping, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = random_triangles(3000, 0.5f, 8);
    Task task;
    const Bvh2 base = BinnedSah{}.build(mesh, whole_refs(mesh), task);
    const LateSplitBvh many = cut(mesh, {}, base);
    EXPECT_GT(many.nodes.size(), base.nodes.size() + 1000);
    const ThreadLimit limit(1);
    const LateSplitBvh one = cut(mesh, {}, base);
    EXPECT_EQ(many.nodes, one.nodes);
    EXPECT_EQ(many.prims, one.prims);
}

TEST(LateSplitClipping, EndsAtTheEndsOfFloat) {
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    const std::vector<Mesh> meshes = {
        make_mesh({{{-most, -most, -most}, {most, most, most}, {most, -most, 0}}}),
        make_mesh({{{-0.0f, 0, 0}, {5 * least, 7 * least, 9 * least}, {3 * least, -least, least}}})};
    for (const Mesh& mesh : meshes) {
        const LateSplitBvh bvh =
            cut(mesh, {.limit = {.absolute = true, .value = 1e-300}, .budget = 1024}, one_leaf(mesh));
        EXPECT_EQ(check_nodes(bvh.list_nodes(), 1), "");
        EXPECT_LE(bvh.prims.size(), 1024u);
    }
}

TEST(LateSplitClipping, TakesAboutAsLongAsItsBaseAtMostOnRealScenes) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
    GTEST_SKIP() << "times of a build for debugging mean nothing";
#endif
    const ThreadLimit limit(1);
    for (const char* name : {"trusses.glb", "arches.glb", "bunny.obj"}) {
        const std::string path = std::string(BOXWOOD_SHARED_DIR) + "/scenes/" + name;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
        Task task;
        const Mesh mesh = load_file(path, task).mesh;
        const std::vector<PrimRef> refs = whole_refs(mesh);
        const LateSplitClipping method;
        ASSERT_EQ(method.budget, 2);
        const Bvh2 base = BinnedSah{}.build(mesh, refs, task);
        size_t references = 0;
        // The truss, where most is cut, takes 0.8 to 1.08 times its base (measured: the promise of 1 is only
        // just kept or missed there), the other scenes a quarter at most.
        EXPECT_LE(median_time_ratio(
                      9, [&] { references = method.apply(mesh, refs, base, task).prims.size(); },
                      [&] { BinnedSah{}.build(mesh, refs, task); }),
                  std::string(name) == "trusses.glb" ? 1.25 : 0.5)
            << name;
        EXPECT_LE(references, 2 * base.prims.size());
    }
}

}  // namespace
}  // namespace boxwood
