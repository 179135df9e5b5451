#include "core/bvh/spatial_splits.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/bvh/spatial_bins.h"
#include "core/bvh/sweep_sah.h"
#include "core/measure/tree_stats.h"
#include "core/refs/early_split_clipping.h"
#include "core/refs/edge_volume.h"
#include "core/scene/scene.h"
#include "oracle/polygon.h"
#include "support/random_mesh.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

Bvh2 build(const Mesh& mesh, const SpatialSplits& method = {}) {
    Task task;
    return method.build(mesh, whole_refs(mesh), task);
}

double sah_cost(const Bvh2& bvh) { return tree_stats(make_level_table(bvh.list_nodes())).sah_cost; }

/// The boxes of the leaves that hold each primitive.
std::vector<std::vector<Box>> boxes_of_prims(const Bvh2& bvh, size_t triangle_count) {
    std::vector<std::vector<Box>> boxes(triangle_count);
    for (const Bvh2::Node& node : bvh.nodes)
        for (uint32_t i = node.first; node.is_leaf() && i < node.first + node.count; ++i)
            boxes[bvh.prims[i]].push_back({node.lower, node.upper});
    return boxes;
}

/// Long thin triangles in all directions, corners in the cube [lower, upper]^3: what spatial splits are for.
Mesh needles(size_t count, float lower, float upper, uint64_t seed) {
    std::vector<Triangle> triangles = random_triangles(count, lower, upper, seed);
    for (Triangle& t : triangles) t.c = t.b + 0.01f * (t.c - t.b);
    return make_mesh(triangles);
}

void expect_covered(const Mesh& mesh, const Bvh2& bvh) {
    EXPECT_EQ(check_nodes(bvh.list_nodes(), mesh.triangle_count()), "");
    const auto boxes = boxes_of_prims(bvh, mesh.triangle_count());
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
        ASSERT_TRUE(oracle::covers(boxes[prim], mesh.triangle(prim))) << "primitive " << prim;
}

TEST(SpatialSplits, LeafBoxesOfEachPrimitiveTogetherContainIt) {
    const SpatialSplits one = {.max_leaf_size = 1};
    for (const float offset : {0.0f, 1e7f}) {
        const Mesh mesh = needles(250, offset - 50.0f, offset + 50.0f, 1);
        const Bvh2 bvh = build(mesh, one);
        EXPECT_GT(bvh.prims.size(), 260u);  // some were cut
        expect_covered(mesh, bvh);
    }
}

TEST(SpatialSplits, CutsPiecesOfTrianglesInsideTheirBoxes) {
    const Mesh mesh = needles(30, -1.0f, 1.0f, 2);
    Task task;
    for (const References& pieces :
         {EdgeVolume{.t = 8}.make(mesh, task),
          EarlySplitClipping{.limit = {.absolute = false, .value = 5.0}}.make(mesh, task)}) {
        ASSERT_GT(pieces.refs.size(), 60u);
        const Bvh2 bvh = SpatialSplits{.max_leaf_size = 1}.build(mesh, pieces.refs, task);
        expect_covered(mesh, bvh);
        for (const Bvh2::Node& node : bvh.nodes) {
            if (!node.is_leaf()) continue;
            // A leaf of one primitive lies inside the common box of that primitive's pieces.
            Box all;
            for (const PrimRef& ref : pieces.refs)
                if (ref.prim == bvh.prims[node.first]) all.extend(ref.bounds);
            ASSERT_TRUE(all.contains({node.lower, node.upper}));
        }
    }
}

/// Eight slivers along the diagonal of a square, from (0, 0, 0) to (16, 16, 0) and (16, 16, 1/4).
std::vector<Triangle> diagonals() {
    return std::vector<Triangle>(8, Triangle{{0, 0, 0}, {16, 16, 0}, {16, 16, 0.25f}});
}

TEST(SpatialBins, FindsTheSplitComputedByHand) {
    // Cut at x = 8, the left part ends at z = 1/8: half areas 8 8 + 2 8/8 = 66 and 8 8 + 2 8/4 = 68. Cut at
    // x = 4: 16 + 2 4/16 = 16.5 and 144 + 2 12/4 = 150, which is more.
    const Mesh mesh = make_mesh(diagonals());
    SpatialBins bins(box4(mesh.bounds()), 4);
    for (uint32_t prim = 0; prim < 8; ++prim) bins.add({{0, 0, 0}, prim, {16, 16, 0.25f}}, mesh);
    const SpatialSplit split = bins.cheapest_split();
    EXPECT_EQ(split.axis, 0);
    EXPECT_EQ(split.position, 8.0f);
    EXPECT_EQ(split.left_count, 8u);
    EXPECT_EQ(split.right_count, 8u);
    EXPECT_EQ(split.cost, 8.0 * 66.0 + 8.0 * 68.0);
    const SpatialCutter::Parts parts = SpatialCutter(mesh, split).cut({{0, 0, 0}, 3, {16, 16, 0.25f}});
    ASSERT_TRUE(parts.has_left && parts.has_right);
    EXPECT_EQ(parts.left.bounds(), (Box{{0, 0, 0}, {8, 8, 0.125f}}));
    EXPECT_EQ(parts.right.bounds(), (Box{{8, 8, 0}, {16, 16, 0.25f}}));
    EXPECT_EQ(parts.right.prim, 3u);
}

TEST(SpatialBins, AReferenceThatEndsOnAPlaneIsOnOneSideOfIt) {
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 1, 0}, {0, 1, 0}}, {{8, 0, 0}, {16, 1, 0}, {8, 1, 0}}});
    SpatialBins bins(box4(mesh.bounds()), 4);
    bins.add({{0, 0, 0}, 0, {8, 1, 0}}, mesh);
    bins.add({{8, 0, 0}, 1, {16, 1, 0}}, mesh);
    const SpatialSplit split = bins.cheapest_split();
    EXPECT_EQ(split.position, 8.0f);
    EXPECT_EQ(split.left_count, 1u);
    EXPECT_EQ(split.right_count, 1u);
    EXPECT_EQ(bins.side({{0, 0, 0}, 0, {8, 1, 0}}, split), Side::Left);
    EXPECT_EQ(bins.side({{8, 0, 0}, 1, {16, 1, 0}}, split), Side::Right);
    EXPECT_EQ(bins.side({{7, 0, 0}, 0, {9, 1, 0}}, split), Side::Both);
}

TEST(SpatialCutter, LeavesAReferenceWholeWhereThatIsCheaper) {
    // Half areas 3 and 3, ten references each: 60 if one is cut. All of [0.5, 1.01] to the left: 10 (2 1.01 +
    // 1) + 9 3 = 57.2. All of [0.1, 1.9] to a side: 10 (2 1.9 + 1) + 27 = 75.
    const Mesh mesh = make_mesh({{{0.5f, 0, 0}, {1.01f, 0.1f, 0}, {0.5f, 0, 0.1f}},
                                 {{0.1f, 0, 0}, {1.9f, 0.1f, 0}, {0.1f, 0, 0.1f}}});
    SpatialSplit split;
    split.axis = 0;
    split.position = 1.0f;
    split.left_count = split.right_count = 10;
    split.left_box = box4({{0, 0, 0}, {1, 1, 1}});
    split.right_box = box4({{1, 0, 0}, {2, 1, 1}});
    const auto cut = [&](uint32_t prim) {
        const Box box = mesh.triangle(prim).bounds();
        return SpatialCutter(mesh, split).cut({box.lower, prim, box.upper});
    };
    EXPECT_TRUE(cut(0).has_left && !cut(0).has_right);
    EXPECT_EQ(cut(0).left.bounds(), mesh.triangle(0).bounds());
    EXPECT_TRUE(cut(1).has_left && cut(1).has_right);
}

TEST(SpatialSplits, StaysInsideItsBudgetAndSaysSo) {
    const Mesh mesh = needles(1500, -1.0f, 1.0f, 3);
    size_t last = 0;
    for (const float budget : {1.0f, 1.25f, 2.0f, 4.0f}) {
        Task task;
        SpatialSplits method = {.max_leaf_size = 1, .budget = budget};
        const Bvh2 bvh = method.build(mesh, whole_refs(mesh), task);
        EXPECT_LE(static_cast<double>(bvh.prims.size()), double(budget) * 1500.0);
        EXPECT_GT(bvh.prims.size(), last);
        EXPECT_GT(task.skipped.counts().at("over the reference budget"), 0u);
        last = bvh.prims.size();
    }
}

TEST(SpatialSplits, TriesNoSpatialSplitWhereChildrenDoNotOverlap) {
    std::vector<Triangle> row;
    for (int i = 0; i < 3000; ++i) {
        const float x = 2.0f * static_cast<float>(i);
        row.push_back({{x, 0, 0}, {x + 1, 0, 1}, {x, 1, 0}});
    }
    const Mesh mesh = make_mesh(row);
    Task task;
    const Bvh2 bvh = SpatialSplits{.max_leaf_size = 1}.build(mesh, whole_refs(mesh), task);
    EXPECT_EQ(bvh.prims.size(), row.size());
    // Every node that was divided by a sweep or by bins: all but those of at most six references.
    EXPECT_GT(task.skipped.counts().at("children do not overlap"), 500u);
    EXPECT_EQ(task.skipped.counts().count("over the reference budget"), 0u);
}

TEST(SpatialSplits, OverlapOfOneGivesObjectSplitsAlone) {
    const Mesh mesh = needles(2000, -1.0f, 1.0f, 4);
    EXPECT_EQ(build(mesh, {.overlap = 1.0f}).prims.size(), 2000u);
    EXPECT_GT(build(mesh, {.overlap = 0.0f}).prims.size(), 2300u);
}

TEST(SpatialSplits, CostsNoMoreThanASweep) {
    for (const char* name : {"atrium", "spaceship", "cornell", "two-triangles"}) {
        Task task;
        const auto scene = open_scene(name, task);
        const std::vector<PrimRef> refs = whole_refs(scene->mesh);
        const Bvh2 bvh = SpatialSplits{}.build(scene->mesh, refs, task);
        EXPECT_LE(sah_cost(bvh), sah_cost(SweepSah{}.build(scene->mesh, refs, task))) << name;
    }
}

TEST(SpatialSplits, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = needles(6000, -1.0f, 1.0f, 5);
    const Bvh2 many = build(mesh);
    const ThreadLimit limit(1);
    const Bvh2 one = build(mesh);
    EXPECT_EQ(many.nodes, one.nodes);
    EXPECT_EQ(many.prims, one.prims);
}

TEST(SpatialSplits, EndsWithinItsDepthWhereAllReferencesCross) {
    // A fan: every plane through the middle cuts all of them.
    std::vector<Triangle> fan;
    for (int i = 0; i < 1000; ++i) {
        const float a = static_cast<float>(i) * 0.0005f;
        fan.push_back({{-1, -a, -1 + a}, {1, a, 1 - a}, {1, a, 1 - a + 1e-4f}});
    }
    const Mesh mesh = make_mesh(fan);
    const Bvh2 bvh = build(mesh, {.max_leaf_size = 1, .overlap = 0.0f, .budget = 16.0f});
    EXPECT_LE(bvh.prims.size(), 16000u);
    const LevelTable table = make_level_table(bvh.list_nodes());
    EXPECT_LE(table.level_count(), 65u);
    EXPECT_EQ(check_nodes(table.list, mesh.triangle_count()), "");
}

}  // namespace
}  // namespace boxwood
