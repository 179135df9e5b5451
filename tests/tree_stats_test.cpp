#include "core/measure/tree_stats.h"

#include <gtest/gtest.h>

#include <cmath>

namespace boxwood {
namespace {

NodeView inner(const Box& bounds, uint32_t parent, uint32_t level) {
    return {.bounds = bounds, .parent = parent, .level = level, .kind = NodeKind::Inner};
}
NodeView leaf(const Box& bounds, uint32_t parent, uint32_t level, uint32_t first_ref, uint32_t ref_count) {
    return {bounds, parent, level, NodeKind::Leaf, first_ref, ref_count};
}

/// Root 4 x 2 x 2 (half area 20); leaves 3 x 2 x 2 (16) with 3 primitives and 2 x 2 x 2 (12) with 2; they
/// share 1 x 2 x 2 (8).
NodeList three_nodes(float scale = 1.0f) {
    NodeList list;
    list.nodes = {inner({Vec3(0), scale * Vec3(4, 2, 2)}, kNoIndex, 0),
                  leaf({Vec3(0), scale * Vec3(3, 2, 2)}, 0, 1, 0, 3),
                  leaf({scale * Vec3(2, 0, 0), scale * Vec3(4, 2, 2)}, 0, 1, 3, 2)};
    list.ref_prims = {0, 1, 2, 2, 3};
    return list;
}

TEST(TreeStats, ThreeNodesComputedByHand) {
    const TreeStats stats = tree_stats(make_level_table(three_nodes()));
    EXPECT_EQ(stats.nodes, 3u);
    EXPECT_EQ(stats.leaves, 2u);
    EXPECT_EQ(stats.references, 5u);
    ASSERT_EQ(stats.levels.size(), 2u);
    EXPECT_DOUBLE_EQ(stats.levels[0].sah_cost, 1.0);
    EXPECT_DOUBLE_EQ(stats.levels[1].sah_cost, 0.8 * 3 + 0.6 * 2);
    EXPECT_DOUBLE_EQ(stats.sah_cost, 4.6);
    EXPECT_DOUBLE_EQ(stats.levels[1].total_area, 1.4);
    EXPECT_DOUBLE_EQ(stats.levels[1].mean_area, 0.7);
    EXPECT_DOUBLE_EQ(stats.levels[1].sibling_overlap, 8.0 / 20.0);
    EXPECT_EQ(stats.levels[0].sibling_overlap, 0.0);
    EXPECT_EQ(stats.levels[1].nodes, 2u);
    EXPECT_EQ(stats.levels[1].leaves, 2u);
    EXPECT_EQ(stats.levels[1].references, 5u);
    EXPECT_EQ(stats.leaf_sizes, (std::vector<uint64_t>{0, 0, 1, 1}));
    EXPECT_EQ(stats.empty_leaves, 0u);
}

TEST(TreeStats, AVolumeThatIsNoBoxCountsWithItsOwnArea) {
    NodeList list = three_nodes();
    list.half_areas = {10.0, 5.0, 2.0};
    const TreeStats stats = tree_stats(make_level_table(list));
    EXPECT_DOUBLE_EQ(stats.levels[1].total_area, 0.7);
    EXPECT_DOUBLE_EQ(stats.sah_cost, 1.0 + 0.5 * 3 + 0.2 * 2);
    EXPECT_DOUBLE_EQ(stats.levels[1].sibling_overlap, 8.0 / 20.0);  // of their boxes
}

TEST(TreeStats, OtherConstantsWeighInnerNodesAndPrimitives) {
    EXPECT_DOUBLE_EQ(tree_stats(make_level_table(three_nodes()), 2.0, 0.5).sah_cost, 2.0 + 0.5 * 3.6);
}

TEST(TreeStats, TheCostDoesNotDependOnTheScenesSize) {
    const double cost = tree_stats(make_level_table(three_nodes())).sah_cost;
    EXPECT_EQ(tree_stats(make_level_table(three_nodes(0x1p120f))).sah_cost, cost);
    EXPECT_EQ(tree_stats(make_level_table(three_nodes(0x1p-120f))).sah_cost, cost);
}

TEST(TreeStats, ARootWithoutAreaIsMetWithAllItsNodes) {
    NodeList list = three_nodes();
    for (NodeView& node : list.nodes) node.bounds = {Vec3(1), Vec3(1)};
    const TreeStats stats = tree_stats(make_level_table(list));
    EXPECT_EQ(stats.sah_cost, 1.0 + 5.0);
    EXPECT_EQ(stats.levels[1].sibling_overlap, 0.0);
}

TEST(TreeStats, AnEmptyTableCostsNothing) {
    const TreeStats stats = tree_stats(make_level_table({}));
    EXPECT_EQ(stats.sah_cost, 0.0);
    EXPECT_EQ(stats.nodes, 0u);
    EXPECT_TRUE(stats.levels.empty());
}

TEST(TreeStats, CountsEmptyCellsAndGathersLargeLeaves) {
    NodeList list = three_nodes();
    list.nodes[1] = leaf(list.nodes[1].bounds, 0, 1, 0, 0);
    list.nodes[2] = leaf(list.nodes[2].bounds, 0, 1, 0, 1000);
    list.ref_prims.assign(1000, 0);
    const TreeStats stats = tree_stats(make_level_table(list));
    EXPECT_EQ(stats.empty_leaves, 1u);
    ASSERT_EQ(stats.leaf_sizes.size(), TreeStats::kMostLeafSize + 1);
    EXPECT_EQ(stats.leaf_sizes.back(), 1u);
    EXPECT_EQ(stats.leaf_sizes[0], 1u);
}

TEST(TreeStats, AParentOfManyIsLeftOutOfTheOverlapAndCounted) {
    NodeList list;
    list.nodes.push_back(inner({Vec3(0), Vec3(1)}, kNoIndex, 0));
    for (uint32_t i = 0; i < 1000; ++i) list.nodes.push_back(leaf({Vec3(0), Vec3(1)}, 0, 1, i, 1));
    list.ref_prims.assign(1000, 0);
    const TreeStats stats = tree_stats(make_level_table(list));
    EXPECT_EQ(stats.crowded_parents, 1u);
    EXPECT_EQ(stats.levels[1].sibling_overlap, 0.0);
}

/// Root 4 x 2 x 2 over 2 x 2 x 2 (half area 12), which is over 1 x 2 x 2 (8) and 1 x 1 x 1 (3), and over
/// 1 x 2 x 2.
NodeList nodes_with_gaps() {
    NodeList list;
    list.nodes = {inner({Vec3(0), {4, 2, 2}}, kNoIndex, 0), inner({Vec3(0), Vec3(2)}, 0, 1),
                  leaf({{3, 0, 0}, {4, 2, 2}}, 0, 1, 0, 1), leaf({Vec3(0), {1, 2, 2}}, 1, 2, 1, 1),
                  leaf({Vec3(1), Vec3(2)}, 1, 2, 2, 4)};
    list.ref_prims = {0, 1, 2, 3, 4, 5};
    return list;
}

TEST(TreeStats, EmptyVolumeByHand) {
    const TreeStats stats = tree_stats(make_level_table(nodes_with_gaps()));
    EXPECT_EQ(stats.levels[0].empty_volume, 0.0);
    EXPECT_DOUBLE_EQ(stats.levels[1].empty_volume, 4.0 / 16.0);
    EXPECT_DOUBLE_EQ(stats.levels[2].empty_volume, 3.0 / 8.0);
    EXPECT_DOUBLE_EQ(stats.empty_volume, (20.0 * 0.25 + 12.0 * 0.375) / 32.0);
}

TEST(TreeStats, EmptyVolumeOfALevelIsWeightedByTheParentsAreaAndOfFlatBoxesIsArea) {
    // Under the root a cube of half area 12, a quarter full, and a flat box of half area 4, half full.
    NodeList list;
    list.nodes = {inner({Vec3(0), {4, 2, 2}}, kNoIndex, 0), inner({Vec3(0), Vec3(2)}, 0, 1),
                  inner({{4, 0, 0}, {4, 2, 2}}, 0, 1), leaf({Vec3(0), {2, 1, 1}}, 1, 2, 0, 1),
                  leaf({{4, 0, 0}, {4, 2, 1}}, 2, 2, 1, 1)};
    list.ref_prims = {0, 1};
    const TreeStats stats = tree_stats(make_level_table(list));
    EXPECT_DOUBLE_EQ(stats.levels[2].empty_volume, (12.0 * 0.75 + 4.0 * 0.5) / 16.0);
    EXPECT_DOUBLE_EQ(stats.levels[1].empty_volume, 0.5);
}

TEST(TreeStats, CellsThatFillTheirParentLeaveNothingEmpty) {
    NodeList list = three_nodes(1.0f / 3.0f);
    list.nodes[1].bounds.upper.x = list.nodes[2].bounds.lower.x = 0.1f;
    EXPECT_EQ(tree_stats(make_level_table(list)).levels[1].empty_volume, 0.0);
}

TEST(TreeStats, OverlapOfTheWholeTreeIsRelativeToTheRoot) {
    EXPECT_DOUBLE_EQ(tree_stats(make_level_table(three_nodes())).sibling_overlap, 8.0 / 20.0);
}

TEST(TreeStats, LeafSizesVaryAroundTheirMeanEmptyLeavesLeftOut) {
    const TreeStats stats = tree_stats(make_level_table(nodes_with_gaps()));  // 1, 1 and 4
    EXPECT_DOUBLE_EQ(stats.mean_leaf_size, 2.0);
    EXPECT_DOUBLE_EQ(stats.leaf_size_variation, std::sqrt((1.0 + 1.0 + 4.0) / 3.0) / 2.0);
    NodeList list = nodes_with_gaps();
    list.nodes[2].ref_count = 0;
    EXPECT_DOUBLE_EQ(tree_stats(make_level_table(list)).mean_leaf_size, 2.5);
}

TEST(OverlapHalfArea, IsZeroForBoxesThatOnlyTouch) {
    const Box box{Vec3(0), Vec3(2)};
    EXPECT_EQ(overlap_half_area(box, {{2, 0, 0}, {4, 2, 2}}), 0.0);  // kd-tree cells
    EXPECT_EQ(overlap_half_area(box, {{5, 0, 0}, {6, 2, 2}}), 0.0);
    EXPECT_EQ(overlap_half_area(box, {{1, 1, 1}, {4, 4, 4}}), 3.0);
    EXPECT_EQ(overlap_half_area(box, box), 12.0);
    EXPECT_EQ(overlap_half_area(box, Box{}), 0.0);
    // A flat box inside, on the border, and two in one plane.
    EXPECT_EQ(overlap_half_area(box, {{0, 1, 0}, {2, 1, 2}}), 4.0);
    EXPECT_EQ(overlap_half_area(box, {{0, 2, 0}, {2, 2, 2}}), 0.0);
    EXPECT_EQ(overlap_half_area({{0, 1, 0}, {2, 1, 2}}, {{1, 1, 1}, {3, 1, 3}}), 1.0);
}

}  // namespace
}  // namespace boxwood
