#include "core/grid/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/grid/uniform_grid.h"
#include "core/structure/tested_prims.h"
#include "support/cell_visits.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

Grid build(const UniformGrid& builder, const Mesh& mesh) {
    Task task;
    return builder.build(mesh, whole_refs(mesh), task);
}

bool increases_strictly(const std::vector<float>& walls) {
    return std::adjacent_find(walls.begin(), walls.end(), std::greater_equal<float>()) == walls.end();
}

TEST(Grid, WallsComeFromTheirIndexAndIncrease) {
    EXPECT_EQ(make_walls(0.0f, 3.0f, 3), (std::vector<float>{0.0f, 1.0f, 2.0f, 3.0f}));
    EXPECT_EQ(make_walls(2.0f, 2.0f, 9), (std::vector<float>{2.0f, 2.0f}));
    // Tenths added up in float lead to 1.0000001.
    const std::vector<float> tenths = make_walls(0.0f, 1.0f, 10);
    for (int i = 0; i <= 10; ++i) EXPECT_EQ(tenths[static_cast<size_t>(i)], static_cast<float>(i / 10.0));
    // -1 + (1 + 1e-30) is 0 in double: the last wall is the box's face all the same.
    EXPECT_EQ(make_walls(-1.0f, 1e-30f, 4).back(), 1e-30f);
    EXPECT_TRUE(increases_strictly(make_walls(-1.0f, 1e-30f, 4)));
    // Eight floats of distance 1 hold no more than eight cells.
    const std::vector<float> coarse = make_walls(8388608.0f, 8388616.0f, 100);
    EXPECT_TRUE(increases_strictly(coarse));
    EXPECT_EQ(coarse.size(), 7u);  // 100 is halved to 6 cells
    EXPECT_TRUE(increases_strictly(make_walls(-3e38f, 3e38f, 1000)));
    EXPECT_TRUE(increases_strictly(make_walls(0.0f, 1e-38f, 1000)));
}

TEST(Grid, ResolutionFollowsFromTheDensityAndTheBox) {
    const Box box{{0, 0, 0}, {4, 2, 1}};
    UniformGrid grid{.density = 2.0f};
    EXPECT_EQ(grid.resolution(box, 32), UVec3(8, 4, 2));  // 64 cells of edge 1/2
    EXPECT_EQ(grid.resolution({{0, 0, 0}, {4, 0, 1}}, 8), UVec3(8, 1, 2));
    // A cube of 8 cells would be longer than the box is wide and high: one cell there, 8 along x.
    EXPECT_EQ(grid.resolution({{0, 0, 0}, {1000, 1, 1}}, 4), UVec3(8, 1, 1));
    grid.y = 16;
    EXPECT_EQ(grid.resolution(box, 32), UVec3(4, 16, 1));  // 4 cells are left for 4 x 1
    grid.x = grid.y = grid.z = 4096;
    const UVec3 most = grid.resolution(box, 32);
    EXPECT_EQ(uint64_t{most.x} * most.y * most.z, UniformGrid::kMaxCells);
}

TEST(Grid, VisitsExactlyTheCellsThatTheRayMeets) {
    for (const Vec3& offset : {Vec3(0.0f), Vec3(0.3f, 70000.0f, -1e6f)}) {
        const Mesh mesh = two_corners(offset);
        const Grid grid = build({.x = 7, .y = 5, .z = 8}, mesh);
        const std::vector<Ray> rays = rays_at_walls(grid.list_nodes().nodes, 1500, 1);
        expect_visits_of_boxes_met<Mode::Exact>(grid, mesh, rays, 500);
        expect_visits_of_boxes_met<Mode::Fast>(grid, mesh, rays, 500);
    }
}

TEST(Grid, VisitsACellThatIsLeftAsTheNextOneIsEntered) {
    // The cell before x = 1 is left at most at 1 + 6u, u = 2^-53, where the one beyond y = 1 is entered.
    Mesh mesh = two_corners(Vec3(0.0f));
    for (Vec3& p : mesh.positions) p *= 2.0f;
    const Grid grid = build({.x = 4, .y = 4, .z = 4}, mesh);
    Ray ray;
    ray.origin = {0.0f, -6.0f * 0x1p-53f, 0.5f};
    ray.direction = {1.0f, 1.0f, 0.0f};
    ASSERT_EQ(RaySlabs(ray).far(0, 1.0), RaySlabs(ray).near(1, 1.0));
    expect_visits_of_boxes_met<Mode::Exact>(grid, mesh, {ray}, 1);
}

TEST(Grid, TestsNoPrimitiveTwice) {
    const Mesh mesh = random_triangles(60, 0.9f, 1);
    const Grid grid = build({.x = 16, .y = 16, .z = 16}, mesh);
    expect_no_test_twice(grid, mesh, rays_for(mesh, 300, 2));
}

TEST(Grid, CellsHaveExactlyTheTrianglesThatTouchThem) {
    Mesh mesh = random_triangles(40, 0.4f, 3);
    // Corners on walls and edges in walls: the box becomes [-2, 2]^3, in cells of edge 1, 1 and 1/2.
    Rng rng(4);
    for (Vec3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis)
            if (rng.next() < 0.7f) p[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
    const Grid grid = build({.x = 4, .y = 4, .z = 8}, mesh);
    ASSERT_EQ(grid.bounds(), (Box{Vec3(-2.0f), Vec3(2.0f)}));
    expect_exact_references(grid.list_nodes(), mesh);
    const Mesh slanted = random_triangles(40, 0.5f, 5);
    expect_exact_references(build({.x = 6, .y = 3, .z = 5}, slanted).list_nodes(), slanted);
}

TEST(Grid, PiecesOfReferencesChangeNothing) {
    const Mesh mesh = random_triangles(50, 0.5f, 6);
    std::vector<PrimRef> refs;
    for (const PrimRef& ref : whole_refs(mesh)) refs.insert(refs.end(), 3, ref);
    Task task;
    const UniformGrid builder;
    const Grid pieces = builder.build(mesh, refs, task), whole = build(builder, mesh);
    EXPECT_EQ(pieces.prims, whole.prims);
    EXPECT_EQ(pieces.cell_begin, whole.cell_begin);
}

TEST(Grid, StaysWithinItsBudget) {
    const Mesh mesh = random_triangles(100, 0.9f, 7);
    UniformGrid builder{.x = 64, .y = 64, .z = 64};
    const size_t unbounded = build(builder, mesh).prims.size();
    builder.budget = {.per_triangle = 10, .at_least = 0};
    Task task;
    const Grid grid = builder.build(mesh, whole_refs(mesh), task);
    EXPECT_GT(unbounded, 1000u);
    EXPECT_LE(grid.prims.size(), 1000u);
    EXPECT_EQ(task.skipped.counts().at("grid cells over the reference budget"),
              64u * 64u * 64u - (grid.cell_begin.size() - 1));
}

TEST(TestedPrims, ForgetNone) {
    TestedPrims tested;
    for (uint32_t i = 0; i < 5000; ++i) {
        ASSERT_TRUE(tested.add(64 * i));
        ASSERT_FALSE(tested.add(64 * (i / 2)));
    }
}

}  // namespace
}  // namespace boxwood
