#include "core/kdtree/kd_sah.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/kdtree/kd_events.h"
#include "support/random_mesh.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

std::vector<KdEvent> sorted_events(const std::vector<Box>& pieces, int axis) {
    std::vector<KdEvent> events;
    for (uint32_t i = 0; i < pieces.size(); ++i) add_events(pieces[i], i, axis, events);
    std::sort(events.begin(), events.end());
    return events;
}

KdTree build(const Mesh& mesh, const KdSah& params = {}) {
    Task task;
    return params.build(mesh, whole_refs(mesh), task);
}

TEST(KdEvent, KeepsPlaneKindAndPiece) {
    for (const float plane : {-3e38f, -1.5f, -1e-40f, 0.0f, 1e-40f, 2.5f, 3e38f}) {
        const KdEvent event(plane, KdEventKind::Planar, 12345);
        EXPECT_EQ(event.plane(), plane);
        EXPECT_EQ(event.kind(), KdEventKind::Planar);
        EXPECT_EQ(event.piece(), 12345u);
        EXPECT_EQ(event.at(7), KdEvent(plane, KdEventKind::Planar, 7));
    }
}

TEST(KdEvent, SortsByPlaneThenEndPlanarStart) {
    std::vector<KdEvent> events;
    for (const float plane : {2.0f, -2.0f, 0.0f, -1e-40f, 1e-40f})
        for (const KdEventKind kind : {KdEventKind::Start, KdEventKind::End, KdEventKind::Planar})
            for (const uint32_t piece : {1u, 0u}) events.push_back({plane, kind, piece});
    std::sort(events.begin(), events.end());
    size_t i = 0;
    for (const float plane : {-2.0f, -1e-40f, 0.0f, 1e-40f, 2.0f})
        for (const KdEventKind kind : {KdEventKind::End, KdEventKind::Planar, KdEventKind::Start})
            for (const uint32_t piece : {0u, 1u}) {
                EXPECT_EQ(events[i].plane(), plane);
                EXPECT_EQ(events[i].kind(), kind);
                EXPECT_EQ(events[i++].piece(), piece);
            }
}

TEST(KdEvent, BothZerosAreOnePlane) {
    EXPECT_TRUE(KdEvent(-0.0f, KdEventKind::End, 0).is_at_plane_of(KdEvent(0.0f, KdEventKind::Start, 1)));
}

/// A cell of 8 x 1 x 1 with four pieces along x: [0, 2], [2, 4], the plane x = 4, and [4, 8].
const std::vector<Box> kPieces = {
    {{0, 0, 0}, {2, 1, 1}}, {{2, 0, 0}, {4, 1, 1}}, {{4, 0, 0}, {4, 1, 1}}, {{4, 0, 0}, {8, 1, 1}}};
const Box kCell = {{0, 0, 0}, {8, 1, 1}};

TEST(KdSweep, WeighsEachPlaneAsComputedByHand) {
    // Half areas: left 1 + 2x, right 1 + 2 (8 - x), cell 17. With C_t = 1 and no bonus, times 17:
    //   x = 2: the first ends, the second starts: 1 left, 3 right: 17 + 5 * 1 + 13 * 3 = 61
    //   x = 4, planar left: 3 left, 1 right: 17 + 9 * 3 + 9 * 1 = 53; planar right: 17 + 9 * 2 + 9 * 2 = 53
    //   x = 0 and x = 8 are walls of the cell.
    const std::vector<KdEvent> events = sorted_events(kPieces, 0);
    ASSERT_EQ(events.size(), 7u);
    KdBestSplit best;
    sweep(events, 0, kCell, kPieces.size(), {.traversal = 1.0, .empty_bonus = 0.0}, best);
    EXPECT_EQ(best.cost, 53.0);
    EXPECT_EQ(best.split.axis, 0);
    EXPECT_EQ(best.split.plane, 4.0f);
    EXPECT_TRUE(best.split.planar_left);  // of equal costs the first
}

TEST(KdSweep, PlanarPiecesGoToTheCheaperSide) {
    // Half areas at x = 6: left 13, right 5; the two pieces in the plane are cheaper on the right.
    const std::vector<Box> pieces = {
        {{0, 0, 0}, {6, 1, 1}}, {{6, 0, 0}, {6, 1, 1}}, {{6, 0, 0}, {6, 1, 1}}, {{6, 0, 0}, {8, 1, 1}}};
    KdBestSplit best;
    sweep(sorted_events(pieces, 0), 0, kCell, pieces.size(), {.traversal = 1.0, .empty_bonus = 0.0}, best);
    EXPECT_EQ(best.cost, 17.0 + 13.0 * 1.0 + 5.0 * 3.0);
    EXPECT_FALSE(best.split.planar_left);
}

TEST(KdSweep, AnEmptyChildIsCheaperByTheBonus) {
    // One piece [4, 8]: cut at x = 4, left 0, right 1: (17 + 9) * 0.8.
    const std::vector<Box> pieces = {kPieces[3]};
    KdBestSplit best;
    sweep(sorted_events(pieces, 0), 0, kCell, 1, {.traversal = 1.0, .empty_bonus = 0.2}, best);
    EXPECT_DOUBLE_EQ(best.cost, 26.0 * 0.8);
}

TEST(KdSide, APieceThatEndsAtThePlaneStaysOnItsSide) {
    const auto side = [](float lower, float upper, bool planar_left) {
        return side_of({{lower, 0, 0}, {upper, 1, 1}}, {0, 1.0f, planar_left});
    };
    EXPECT_EQ(side(0, 1, false), KdSide::Left);
    EXPECT_EQ(side(1, 2, true), KdSide::Right);
    EXPECT_EQ(side(0, 2, true), KdSide::Both);
    EXPECT_EQ(side(1, 1, true), KdSide::Left);
    EXPECT_EQ(side(1, 1, false), KdSide::Right);
    EXPECT_EQ(side(0, 0, false), KdSide::Left);
    EXPECT_EQ(side(2, 2, true), KdSide::Right);
}

/// Walls x = 0 and x = 8 of a corridor whose triangles end at x = 0, 4 and 8.
TEST(KdSah, SplitsAsComputedByHand) {
    // Three pairs of triangles in the planes x = 0, 4, 8 of a cell 8 x 1 x 1: half area 17, leaf 6. The plane
    // x = 4 with its pair on the left: 1 + (9 * 4 + 9 * 2) / 17 = 71 / 17, which is below 6. Both children
    // are 4 x 1 x 1, half area 9. The left one holds pairs at x = 0 and 4, its walls: no plane inside.
    Mesh mesh;
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 4.0f, 8.0f}) {
        triangles.push_back({{x, 0, 0}, {x, 1, 0}, {x, 1, 1}});
        triangles.push_back({{x, 0, 0}, {x, 1, 1}, {x, 0, 1}});
    }
    const KdTree tree = build(make_mesh(triangles), {.empty_bonus = 0.0f});
    ASSERT_EQ(tree.nodes.size(), 3u);
    EXPECT_EQ(tree.nodes[0], KdTree::Node::inner(0, 4.0f, 2));
    EXPECT_EQ(tree.nodes[1], KdTree::Node::leaf(0, 4));
    EXPECT_EQ(tree.nodes[2], KdTree::Node::leaf(4, 2));
    EXPECT_EQ(tree.prims, (std::vector<uint32_t>{0, 1, 2, 3, 4, 5}));
    // With a bonus of 0.9 the right child's empty space is cut off, x = 8 with its pair on the right is a
    // wall, so nothing is left to cut.
    EXPECT_EQ(build(make_mesh(triangles), {.empty_bonus = 0.9f}).nodes.size(), 3u);
}

TEST(KdSah, EndsWhereALeafIsCheaper) {
    const Mesh mesh = random_triangles(100, 0.3f, 1);
    EXPECT_EQ(build(mesh, {.empty_bonus = 0.0f, .traversal_cost = 16.0f, .max_depth = 1}).nodes.size(), 3u);
    const Mesh equal = make_mesh(std::vector<Triangle>(50, {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}}));
    EXPECT_EQ(build(equal).nodes.size(), 1u);
    EXPECT_EQ(build(equal).prims.size(), 50u);
}

TEST(KdSah, KeepsToItsLimits) {
    const Mesh mesh = random_triangles(400, 1.0f, 2);
    const auto level_count = [](const KdTree& tree) {
        return make_level_table(tree.list_nodes()).level_count();
    };
    const KdTree free = build(mesh, {.traversal_cost = 0.0f, .max_depth = 64, .budget = 64});
    EXPECT_GT(free.prims.size(), 1600u);
    EXPECT_LE(build(mesh, {.traversal_cost = 0.0f, .max_depth = 64, .budget = 3}).prims.size(), 1200u);
    EXPECT_EQ(build(mesh, {.traversal_cost = 0.0f, .budget = 1}).prims.size(), 400u);
    EXPECT_EQ(level_count(build(mesh, {.max_depth = 5})), 6u);
    EXPECT_EQ(build(random_triangles(64, 1.0f, 3), {.traversal_cost = 0.0f, .leaf_size = 64}).nodes.size(),
              1u);
}

}  // namespace
}  // namespace boxwood
