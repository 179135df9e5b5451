#include "core/octree/octree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/octree/quadtree.h"
#include "core/refs/clip_polygon.h"
#include "support/cell_visits.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

template <class Builder>
CellTree build(const Builder& builder, const Mesh& mesh) {
    Task task;
    return builder.build(mesh, whole_refs(mesh), task);
}

/// A triangle of a hundredth at each place, and the box [0, 8]^3 by two of them at its corners.
Mesh small_triangles(const std::vector<Vec3>& places) {
    Mesh mesh;
    const auto add = [&](const Vec3& p, float size) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(),
                              {p, p + Vec3(size, size, 0.0f), p + Vec3(size, 0.0f, size)});
        mesh.triangles.push_back(UVec3(first, first + 1, first + 2));
    };
    for (const Vec3& place : places) add(place, 0.01f);
    add(Vec3(0.0f), 0.01f);
    add(Vec3(8.0f), -0.01f);
    return mesh;
}

/// The slides' rule with N_leaf = 4 on a plane: five triangles in one quadrant, four of them in one of its
/// quadrants.
const std::vector<Vec3> kPlaces = {{1, 4, 1}, {1.5f, 4, 1}, {1, 4, 1.5f}, {3, 4, 3}, {6, 4, 1}};

TEST(Quadtree, SubdividesWhereThereAreMoreThanNLeaf) {
    const Mesh mesh = small_triangles(kPlaces);
    const CellTree tree = build(Quadtree{.max_leaf_size = 4}, mesh);
    // Root with 7; quadrant (0, 0) with 5 is subdivided: 4 of them lie in its own quadrant (0, 0).
    const NodeList list = tree.list_nodes();
    ASSERT_EQ(list.nodes.size(), 9u);
    std::vector<uint32_t> counts;
    for (const NodeView& node : list.nodes) counts.push_back(node.ref_count);
    EXPECT_EQ(counts, (std::vector<uint32_t>{0, 0, 1, 0, 1, 4, 0, 0, 1}));
    EXPECT_EQ(list.nodes[1].kind, NodeKind::Inner);
    EXPECT_EQ(list.nodes[5].bounds, (Box{{0, 0, 0}, {2, 8, 2}}));
    EXPECT_EQ(list.nodes[8].bounds, (Box{{2, 0, 2}, {4, 8, 4}}));
}

TEST(Quadtree, StopsAfterSMaxSubdivisions) {
    const Mesh mesh = small_triangles(kPlaces);
    EXPECT_EQ(build(Quadtree{.max_depth = 0, .max_leaf_size = 4}, mesh).nodes.size(), 1u);
    const CellTree tree = build(Quadtree{.max_depth = 1, .max_leaf_size = 4}, mesh);
    ASSERT_EQ(tree.nodes.size(), 5u);
    EXPECT_EQ(tree.nodes[1].count, 5u);
}

TEST(Quadtree, CellsReachThroughTheHeight) {
    const Mesh mesh = random_triangles(200, 0.1f, 1);
    for (int up = 0; up < 3; ++up) {
        const CellTree tree = build(Quadtree{.up = up}, mesh);
        EXPECT_GT(tree.nodes.size(), 5u);
        for (const NodeView& node : tree.list_nodes().nodes) {
            EXPECT_EQ(node.bounds.lower[up], tree.bounds.lower[up]);
            EXPECT_EQ(node.bounds.upper[up], tree.bounds.upper[up]);
        }
    }
}

TEST(Octree, SubdividesWhereThereAreMoreThanNLeaf) {
    const Mesh mesh = small_triangles({{1, 1, 1}, {1, 1, 3}, {1, 3, 1}, {3, 1, 1}, {1, 1, 6}});
    const NodeList list = build(Octree{.max_leaf_size = 4}, mesh).list_nodes();
    // Octant 0 holds five of seven: the four named first and the one at the corner.
    ASSERT_EQ(list.nodes.size(), 17u);
    std::vector<uint32_t> counts;
    for (const NodeView& node : list.nodes) counts.push_back(node.ref_count);
    EXPECT_EQ(counts, (std::vector<uint32_t>{0, 0, 0, 0, 0, 1, 0, 0, 1, 2, 1, 1, 0, 1, 0, 0, 0}));
    EXPECT_EQ(list.nodes[13].bounds, (Box{{0, 0, 2}, {2, 2, 4}}));
}

TEST(Octree, WallsAreAFunctionOfTheirNumber) {
    constexpr uint32_t kLast = 1u << CellTree::kMaxDepth;
    CellTree tree;
    // -1 + (1 + 1e-30) is 0 in double.
    for (const Box& bounds : {Box{Vec3(0.0f), Vec3(1.0f)}, Box{Vec3(-1.0f), Vec3(1e-30f)},
                              Box{Vec3(-3e38f), Vec3(3e38f)}, Box{Vec3(1e7f), Vec3(10000003.0f)}}) {
        tree.bounds = bounds;
        EXPECT_EQ(tree.wall(0, 0), bounds.lower.x);
        EXPECT_EQ(tree.wall(0, kLast), bounds.upper.x);
        for (uint32_t n = 1; n <= kLast; n += 7) ASSERT_LE(tree.wall(0, n - 1), tree.wall(0, n));
    }
    tree.bounds = {Vec3(0.0f), Vec3(3.0f)};
    EXPECT_EQ(tree.wall(1, kLast / 4), 0.75f);
}

/// The children of a node share its faces and the middle planes, bit for bit, and are not flat.
TEST(Octree, ChildrenFillTheirParent) {
    Mesh mesh = random_triangles(300, 0.05f, 2);
    for (Vec3& p : mesh.positions) p = 1e6f + p * 4.0f;  // walls soon are neighbouring floats
    const NodeList list = build(Octree{.max_depth = 20, .max_leaf_size = 1}, mesh).list_nodes();
    EXPECT_EQ(check_nodes(list, mesh.triangle_count()), "");
    std::vector<double> child_volume(list.nodes.size(), 0.0);
    for (const NodeView& node : list.nodes) {
        EXPECT_GT(node.bounds.volume(), 0.0);
        if (node.parent != kNoIndex) child_volume[node.parent] += node.bounds.volume();
    }
    for (size_t i = 0; i < list.nodes.size(); ++i) {
        if (list.nodes[i].kind == NodeKind::Leaf) continue;
        EXPECT_NEAR(child_volume[i], list.nodes[i].bounds.volume(), 1e-12 * child_volume[i]);
    }
}

TEST(Octree, VisitsExactlyTheCellsThatTheRayMeets) {
    for (const Vec3& offset : {Vec3(0.0f), Vec3(0.3f, 70000.0f, -1e6f)}) {
        Mesh mesh = two_corners(offset);
        Rng rng(1);
        for (uint32_t i = 0; i < 12; ++i) {
            const Vec3 place = offset + random_point(rng, 0.9f);
            mesh.positions.insert(mesh.positions.end(),
                                  {place, place + Vec3(0.02f, 0.02f, 0.0f), place + Vec3(0.02f)});
            mesh.triangles.push_back(6u + 3u * i + UVec3(0, 1, 2));
        }
        for (const bool is_octree : {true, false}) {
            const CellTree tree = is_octree ? build(Octree{.max_depth = 5, .max_leaf_size = 1}, mesh)
                                            : build(Quadtree{.max_depth = 5, .max_leaf_size = 1}, mesh);
            EXPECT_GT(tree.nodes.size(), 20u);
            const std::vector<Ray> rays = rays_at_walls(tree.list_nodes().nodes, 1500, 1);
            expect_visits_of_boxes_met<Mode::Exact>(tree, mesh, rays, 500);
            expect_visits_of_boxes_met<Mode::Fast>(tree, mesh, rays, 500);
        }
    }
}

TEST(Octree, TestsNoPrimitiveTwice) {
    const Mesh mesh = random_triangles(60, 0.9f, 3);
    const std::vector<Ray> rays = rays_for(mesh, 300, 4);
    expect_no_test_twice(build(Octree{.max_depth = 4}, mesh), mesh, rays);
    expect_no_test_twice(build(Quadtree{.max_depth = 5}, mesh), mesh, rays);
}

TEST(Octree, LeavesHaveExactlyTheTrianglesThatTouchThem) {
    Mesh mesh = random_triangles(16, 0.4f, 5);
    Rng rng(6);
    for (Vec3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (rng.next() < 0.7f) p[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
    const Mesh slanted = random_triangles(16, 0.5f, 7);
    for (const Mesh& each : {mesh, slanted}) {
        expect_exact_references(build(Octree{.max_depth = 3, .max_leaf_size = 2}, each).list_nodes(), each);
        expect_exact_references(build(Quadtree{.max_depth = 4, .max_leaf_size = 2}, each).list_nodes(), each);
    }
}

TEST(Octree, KeepsTheBoxesOfPartsWhereTrianglesAreSplit) {
    const Mesh mesh = random_triangles(200, 0.5f, 8);
    const CellTree whole = build(Octree{.max_depth = 5}, mesh);
    const CellTree split = build(Octree{.max_depth = 5, .split = true}, mesh);
    EXPECT_EQ(split.nodes, whole.nodes);
    EXPECT_EQ(split.prims, whole.prims);
    EXPECT_TRUE(whole.pieces.empty());
    ASSERT_EQ(split.pieces.size(), split.prims.size());
    const NodeList list = split.list_nodes();
    for (const NodeView& leaf : list.nodes)
        for (uint32_t r = leaf.first_ref; r < leaf.first_ref + leaf.ref_count; ++r) {
            ASSERT_FALSE(split.pieces[r].is_empty());
            ASSERT_EQ(split.pieces[r], clip_bounds(mesh.triangle(split.prims[r]), leaf.bounds));
        }
    uint64_t whole_tests = 0, split_tests = 0;
    for (const Ray& each : rays_for(mesh, 500, 9)) {
        Count whole_count, split_count;
        ClosestHit<Mode::Exact> whole_ray(each), split_ray(each);
        whole.closest_hit(mesh, whole_ray, whole_count);
        split.closest_hit(mesh, split_ray, split_count);
        ASSERT_EQ(whole_ray.hit(mesh), split_ray.hit(mesh));
        whole_tests += whole_count.tests;
        split_tests += split_count.tests;
    }
    EXPECT_LT(split_tests, whole_tests * 3 / 4);
}

TEST(Octree, SubdividesAClusterButNotWhatCannotBeParted) {
    // Equal triangles across the first middle plane: every child that has one has all.
    Mesh equal = random_triangles(50, 0.2f, 10);
    for (UVec3& triangle : equal.triangles) triangle = UVec3(0, 1, 2);
    EXPECT_EQ(build(Octree{}, equal).nodes.size(), 1u);
    // A cluster in a corner: one child has nearly all of them, ten times.
    Mesh cluster = random_triangles(50, 0.3f, 11);
    for (Vec3& p : cluster.positions) p *= 1e-3f;
    cluster.positions[0] = Vec3(1.0f);
    const NodeList list = build(Octree{.max_depth = 20}, cluster).list_nodes();
    uint32_t most = 0, depth = 0;
    for (const NodeView& node : list.nodes) {
        most = std::max(most, node.ref_count);
        depth = std::max(depth, node.level);
    }
    EXPECT_GE(depth, 8u);
    EXPECT_LE(most, 20u);
}

TEST(Octree, StaysWithinItsBudget) {
    const Mesh mesh = random_triangles(100, 0.9f, 12);
    Octree builder{.max_depth = 6, .max_leaf_size = 1};
    EXPECT_GT(build(builder, mesh).prims.size(), 2000u);
    builder.budget = {.per_triangle = 20, .at_least = 0};
    Task task;
    const CellTree tree = builder.build(mesh, whole_refs(mesh), task);
    EXPECT_LE(tree.prims.size(), 2000u);
    EXPECT_GT(tree.nodes.size(), 8u);
    EXPECT_GT(task.skipped.counts().at("octree cells left whole: reference budget"), 0u);
}

}  // namespace
}  // namespace boxwood
