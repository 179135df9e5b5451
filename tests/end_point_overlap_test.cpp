#include "core/measure/end_point_overlap.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "core/base/parallel.h"
#include "core/measure/area_inside.h"
#include "core/measure/search_boxes.h"
#include "tests/support/all_recipes.h"
#include "tests/support/random_mesh.h"

namespace boxwood {
namespace {

Mesh mesh_of(const std::vector<Triangle>& triangles) {
    Mesh mesh;
    mesh.objects.push_back({});
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        for (const Vec3& corner : {triangles[i].a, triangles[i].b, triangles[i].c})
            mesh.positions.push_back(corner);
        mesh.triangles.push_back(UVec3(3 * i, 3 * i + 1, 3 * i + 2));
        mesh.source_prim.push_back(i);
        mesh.object.push_back(0);
    }
    return mesh;
}

NodeView inner(const Box& bounds, uint32_t parent, uint32_t level) {
    return {.bounds = bounds, .parent = parent, .level = level, .kind = NodeKind::Inner};
}
NodeView leaf(const Box& bounds, uint32_t parent, uint32_t level, uint32_t first_ref,
              uint32_t ref_count = 1) {
    return {bounds, parent, level, NodeKind::Leaf, first_ref, ref_count};
}

/// Two right triangles of area 8 in the plane z = 0, with flat boxes [0, 4] and [2, 6] squared: the square
/// from 2 to 4 that these share holds nothing of the first triangle and lies wholly in the second one.
struct TwoTriangles {
    Mesh mesh = mesh_of({{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{2, 2, 0}, {6, 2, 0}, {2, 6, 0}}});
    NodeList list;

    TwoTriangles() {
        list.nodes = {inner({Vec3(0), {6, 6, 0}}, kNoIndex, 0), leaf({Vec3(0), {4, 4, 0}}, 0, 1, 0),
                      leaf({{2, 2, 0}, {6, 6, 0}}, 0, 1, 1)};
        list.ref_prims = {0, 1};
    }
};

TEST(EndPointOverlap, TwoBoxesThatShareASquareByHand) {
    const TwoTriangles scene;
    Task task;
    const EndPointOverlap overlap = end_point_overlap(scene.list, scene.mesh, task);
    EXPECT_DOUBLE_EQ(overlap.total, 4.0 / 16.0);
    ASSERT_EQ(overlap.levels.size(), 2u);
    EXPECT_EQ(overlap.levels[0], 0.0);
    EXPECT_DOUBLE_EQ(overlap.levels[1], 0.25);
    EXPECT_DOUBLE_EQ(end_point_overlap(scene.list, scene.mesh, task, 2.0, 3.0).total, 0.75);
    EXPECT_EQ(task.done, 2u);
}

TEST(EndPointOverlap, AnInnerNodeCountsOneVisitAndALeafItsPrimitives) {
    // The first leaf under a node of its own, which with its box of two triangles counts on top.
    TwoTriangles scene;
    scene.list.nodes = {inner({Vec3(0), {6, 6, 0}}, kNoIndex, 0), inner({Vec3(0), {4, 4, 0}}, 0, 1),
                        leaf({{2, 2, 0}, {6, 6, 0}}, 0, 1, 1),    leaf({Vec3(0), {4, 4, 0}}, 1, 2, 0),
                        leaf({{3, 3, 0}, {4, 4, 0}}, 1, 2, 2, 3), leaf({{9, 9, 0}, {9, 9, 0}}, 0, 1, 0)};
    scene.list.ref_prims = {0, 1, 0, 2, 3};
    scene.mesh = mesh_of({scene.mesh.triangle(0),
                          scene.mesh.triangle(1),
                          {{9, 9, 0}, {10, 9, 0}, {9, 11, 0}},
                          {{9, 9, 0}, {10, 9, 0}, {9, 15, 0}}});  // areas 8, 8, 1, 3
    Task task;
    const EndPointOverlap overlap = end_point_overlap(scene.list, scene.mesh, task, 2.0, 1.0);
    EXPECT_DOUBLE_EQ(overlap.levels[1], 2.0 * 4.0 / 20.0);
    EXPECT_DOUBLE_EQ(overlap.levels[2], (1.0 * 4.0 + 3.0 * 1.0) / 20.0);
}

TEST(EndPointOverlap, APrimitiveOfSeveralReferencesBelongsToEachNodeAboveOne) {
    TwoTriangles scene;  // triangle 1 is also in the first leaf now
    scene.list.nodes[1] = leaf(scene.list.nodes[1].bounds, 0, 1, 0, 2);
    scene.list.nodes[2] = leaf(scene.list.nodes[2].bounds, 0, 1, 1, 1);
    Task task;
    EXPECT_EQ(end_point_overlap(scene.list, scene.mesh, task).total, 0.0);
}

TEST(EndPointOverlap, IsNotDefinedForNodesThatAreNoBoxesAndZeroForNothing) {
    TwoTriangles scene;
    Task task;
    EXPECT_EQ(end_point_overlap({}, {}, task).total, 0.0);
    scene.list.half_areas = {1.0, 1.0, 1.0};
    EXPECT_TRUE(std::isnan(end_point_overlap(scene.list, scene.mesh, task).total));
    EXPECT_TRUE(end_point_overlap(scene.list, scene.mesh, task).levels.empty());
}

/// Every triangle cut by every box; membership from the leaves below each node.
double overlap_of_all_pairs(const NodeList& list, const Mesh& mesh) {
    std::vector<std::set<uint32_t>> below(list.nodes.size());
    for (size_t n = list.nodes.size(); n-- > 0;) {
        const NodeView& node = list.nodes[n];
        if (node.kind == NodeKind::Leaf)
            for (uint32_t r = 0; r < node.ref_count; ++r) below[n].insert(list.ref_prims[node.first_ref + r]);
        if (node.parent != kNoIndex) below[node.parent].insert(below[n].begin(), below[n].end());
    }
    double sum = 0.0, scene_area = 0.0;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const Triangle triangle = mesh.triangle(prim);
        scene_area += area_of(triangle);
        for (size_t n = 0; n < list.nodes.size(); ++n) {
            const NodeView& node = list.nodes[n];
            if (below[n].contains(prim)) continue;
            sum += area_inside(triangle, node.bounds) * (node.kind == NodeKind::Inner ? 1.0 : node.ref_count);
        }
    }
    return sum / scene_area;
}

TEST(EndPointOverlap, TheSearchFindsWhatAllPairsOfTrianglesAndBoxesGive) {
    const Mesh mesh = random_triangles(120, 0.5f, 3);
    for (const char* recipe :
         {"bvh-object-median", "bvh-sweep-sah", "esc(s=6) > bvh-binned-sah", "kd-sah", "octree", "grid"}) {
        const Built built = run(recipe, mesh);
        Task task;
        const double overlap = end_point_overlap(built.levels->list, mesh, task).total;
        EXPECT_NEAR(overlap, overlap_of_all_pairs(built.levels->list, mesh), 1e-9 * (1.0 + overlap))
            << recipe;
    }
}

TEST(EndPointOverlap, ManySiblingsAreGroupedAndAllFound) {
    const Mesh mesh = random_triangles(150, 0.4f, 4);
    NodeList list;
    list.nodes.push_back(inner(mesh.bounds(), kNoIndex, 0));
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        list.nodes.push_back(leaf(mesh.triangle(i).bounds(), 0, 1, i));
        list.ref_prims.push_back(i);
    }
    EXPECT_GT(search_boxes(list).size(), list.nodes.size());
    Task task;
    const double overlap = end_point_overlap(list, mesh, task).total;
    EXPECT_GT(overlap, 0.5);
    EXPECT_NEAR(overlap, overlap_of_all_pairs(list, mesh), 1e-9 * overlap);
}

TEST(EndPointOverlap, IsTheSameForAnyNumberOfThreadsAndAnySizeOfTheScene) {
    Mesh mesh = random_triangles(600, 0.3f, 5);
    Task task;
    const auto measure = [&] {
        return end_point_overlap(run("bvh-binned-sah", mesh).levels->list, mesh, task).levels;
    };
    const std::vector<double> levels = measure();
    {
        const ThreadLimit one_thread(1);
        EXPECT_EQ(measure(), levels);
    }
    for (Vec3& position : mesh.positions) position *= 0x1p100f;
    EXPECT_EQ(measure(), levels);
}

TEST(AreaInside, OfTheHexagonThatThePlaneThroughSixEdgesCutsFromACube) {
    const Triangle large{{3.5f, -1, -1}, {-1, 3.5f, -1}, {-1, -1, 3.5f}};  // x + y + z = 1.5
    EXPECT_NEAR(area_inside(large, {Vec3(0), Vec3(1)}), 0.75 * std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(area_inside(large, {Vec3(-9), Vec3(9)}), area_of(large), 1e-14);
    EXPECT_EQ(area_inside(large, {Vec3(1), Vec3(2)}), 0.0);
}

TEST(AreaInside, OfATriangleInAWallOrAFlatBoxIsTheWholeAndOfATouchNothing) {
    const Triangle triangle{{0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    EXPECT_EQ(area_inside(triangle, {Vec3(0), {4, 4, 1}}), 2.0);
    EXPECT_EQ(area_inside(triangle, {{0, 0, 1}, {4, 4, 1}}), 2.0);
    EXPECT_EQ(area_inside(triangle, {{1, 0, 1}, {4, 4, 1}}), 0.5);
    EXPECT_EQ(area_inside(triangle, {{2, 0, 0}, {4, 4, 4}}), 0.0);
    EXPECT_EQ(area_inside(triangle, {{1, 1, 0}, {4, 4, 4}}), 0.0);
}

}  // namespace
}  // namespace boxwood
