#include "core/measure/leaf_count_variability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "tests/support/all_recipes.h"
#include "tests/support/random_mesh.h"

namespace boxwood {
namespace {

NodeList root_with_leaves(const Box& root, const std::vector<Box>& leaves) {
    NodeList list;
    list.nodes.push_back({.bounds = root, .kind = NodeKind::Inner});
    for (const Box& box : leaves)
        list.nodes.push_back({.bounds = box, .parent = 0, .level = 1, .kind = NodeKind::Leaf});
    return list;
}

TEST(LeafCounts, WhereEveryLineMeetsTheSameLeavesTheyDoNotVary) {
    const Box cube{Vec3(1), Vec3(3)};
    Task task;
    const LeafCounts counts = count_leaves_on_lines(root_with_leaves(cube, {cube, cube, cube}), task, 1000);
    EXPECT_EQ(counts.mean, 3.0);
    EXPECT_EQ(counts.deviation, 0.0);
}

TEST(LeafCounts, HalfACubeIsMetByTwoThirdsOfAllLines) {
    // Half areas 2 and 3: a line meets the leaf with p = 2/3; the deviation of one such draw is
    // sqrt(p (1 - p)).
    const Box cube{Vec3(-1), Vec3(1)};
    Task task;
    const LeafCounts counts =
        count_leaves_on_lines(root_with_leaves(cube, {{Vec3(-1), {1, 1, 0}}}), task, 1 << 16);
    EXPECT_NEAR(counts.mean, 2.0 / 3.0, 5.0 * 0.4714 / 256.0);
    EXPECT_NEAR(counts.deviation, 0.4714, 0.003);
}

TEST(LeafCounts, AFlatRootIsMetOnItsArea) {
    const Box square{{0, 0, 5}, {4, 4, 5}};
    Task task;
    const LeafCounts counts =
        count_leaves_on_lines(root_with_leaves(square, {{{0, 0, 5}, {1, 4, 5}}}), task, 1 << 16);
    EXPECT_NEAR(counts.mean, 0.25, 5.0 * 0.433 / 256.0);
    EXPECT_NEAR(counts.deviation, 0.433, 0.003);
}

TEST(LeafCounts, TheirMeanIsTheSumOfTheLeavesProbabilities) {
    const Mesh mesh = random_triangles(300, 0.3f, 6);
    for (const char* recipe : {"bvh-binned-sah", "grid", "kd-sah"}) {
        const Built built = run(recipe, mesh);
        const NodeList& list = built.levels->list;
        double expected = 0.0;
        for (size_t n = 0; n < list.nodes.size(); ++n)
            if (list.nodes[n].kind == NodeKind::Leaf) expected += list.half_area(n) / list.half_area(0);
        Task task;
        const LeafCounts counts = count_leaves_on_lines(list, task, 1 << 14);
        EXPECT_GT(counts.deviation, 1.0) << recipe;
        EXPECT_NEAR(counts.mean, expected, 5.0 * counts.deviation / 128.0) << recipe;
    }
}

TEST(LeafCounts, AreTheSameForAnyNumberOfThreads) {
    const Built built = run("bvh-binned-sah", random_triangles(300, 0.3f, 7));
    Task task;
    const LeafCounts counts = count_leaves_on_lines(built.levels->list, task, 5000);
    const ThreadLimit one_thread(1);
    const LeafCounts again = count_leaves_on_lines(built.levels->list, task, 5000);
    EXPECT_EQ(again.mean, counts.mean);
    EXPECT_EQ(again.deviation, counts.deviation);
}

TEST(LeafCounts, AreNotDefinedForOtherVolumesAndForARootWithoutArea) {
    NodeList list = root_with_leaves({Vec3(0), Vec3(1)}, {{Vec3(0), Vec3(1)}});
    Task task;
    list.half_areas = {1.0, 1.0};
    EXPECT_TRUE(std::isnan(count_leaves_on_lines(list, task, 100).deviation));
    EXPECT_TRUE(std::isnan(count_leaves_on_lines({}, task, 100).deviation));
    const Box point{Vec3(1), Vec3(1)};
    EXPECT_TRUE(std::isnan(count_leaves_on_lines(root_with_leaves(point, {point}), task, 100).deviation));
}

}  // namespace
}  // namespace boxwood
