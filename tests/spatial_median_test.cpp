#include "core/bvh/spatial_median.h"

#include <gtest/gtest.h>

#include "support/random_mesh.h"

namespace boxwood {
namespace {

/// Primitives of the root's two children, which are leaves.
struct Halves {
    std::vector<uint32_t> left, right;
};

Halves halves_of(const SpatialMedian& method, const std::vector<PrimRef>& refs) {
    Task task;
    const Bvh2 bvh = method.build(Mesh{}, refs, task);
    EXPECT_EQ(bvh.nodes.size(), 3u);
    Halves halves;
    if (bvh.nodes.size() != 3) return halves;
    const auto first = bvh.prims.begin();
    halves.left.assign(first, first + bvh.nodes[1].count);
    halves.right.assign(first + bvh.nodes[2].first, bvh.prims.end());
    return halves;
}

PrimRef cube(float lower, float upper, uint32_t prim) { return {Box{Vec3(lower), Vec3(upper)}, prim}; }

using Prims = std::vector<uint32_t>;

TEST(SpatialMedian, SplitsTheLongestAxisInTheMiddleByTheSideOfEachCentre) {
    // Box 10 x 4 x 1, middle x = 5; the centres are at 0.5, 1.5, 6 and 9.5. The halves by count are refs.
    const std::vector<PrimRef> refs = {{Box{Vec3(0, 0, 0), Vec3(1, 1, 1)}, 0},
                                       {Box{Vec3(1, 3, 0), Vec3(2, 4, 1)}, 1},
                                       {Box{Vec3(2, 0, 0), Vec3(7, 1, 1)}, 2},
                                       {Box{Vec3(9, 0, 0), Vec3(10, 1, 1)}, 3}};
    const Halves halves = halves_of({.max_leaf_size = 3}, refs);
    EXPECT_EQ(halves.left, (Prims{0, 1, 2}));
    EXPECT_EQ(halves.right, (Prims{3}));
}

TEST(SpatialMedian, TriesOtherAxesWhereAllCentresLieOnOneSide) {
    // In x the middle is 5 and the centres are 5, 9.5, 9; in y the middle is 2 and they are 1, 3, 3.
    const std::vector<PrimRef> refs = {{Box{Vec3(0, 0, 0), Vec3(10, 2, 1)}, 0},
                                       {Box{Vec3(9, 2, 0), Vec3(10, 4, 1)}, 1},
                                       {Box{Vec3(8, 2, 0), Vec3(10, 4, 1)}, 2}};
    const Halves halves = halves_of({.max_leaf_size = 2}, refs);
    EXPECT_EQ(halves.left, (Prims{0}));
    EXPECT_EQ(halves.right, (Prims{1, 2}));
}

TEST(SpatialMedian, SplitsTheCentresBoxWhereNoAxisOfTheBoxPartsThem) {
    // Cubes from 0, 8, 6 to 10: the middle of every axis is 5, the centres are at 5, 9, 8; the middle of
    // their box is 7.
    const std::vector<PrimRef> refs = {cube(0, 10, 0), cube(8, 10, 1), cube(6, 10, 2), cube(6, 10, 3)};
    const Halves halves = halves_of({.max_leaf_size = 3}, refs);
    EXPECT_EQ(halves.left, (Prims{0}));
    EXPECT_EQ(halves.right, (Prims{1, 2, 3}));
}

TEST(SpatialMedian, SplitsTheCentresBoxFromTheStartIfAsked) {
    // Box from 0 to 17, middle 8.5; centres at 5, 6, 9.5, 15: their box has its middle at 10.
    const std::vector<PrimRef> refs = {cube(0, 10, 0), cube(4, 8, 1), cube(2, 17, 2), cube(14, 16, 3)};
    EXPECT_EQ(halves_of({.max_leaf_size = 3}, refs).left, (Prims{0, 1}));
    EXPECT_EQ(halves_of({.max_leaf_size = 3, .of_centers = true}, refs).left, (Prims{0, 1, 2}));
}

TEST(SpatialMedian, BeyondTheLimitOfAttemptsItHalvesByCount) {
    const std::vector<PrimRef> refs = {cube(0, 10, 0), cube(8, 10, 1), cube(6, 10, 2), cube(6, 10, 3)};
    for (const int attempts : {1, 2, 3})
        EXPECT_EQ(halves_of({.max_leaf_size = 3, .attempts = attempts}, refs).left.size(), 2u);
    EXPECT_EQ(halves_of({.max_leaf_size = 3, .attempts = 4}, refs).left.size(), 1u);
    const std::vector<PrimRef> equal(6, cube(0, 1, 0));
    Task task;
    EXPECT_EQ(SpatialMedian{.max_leaf_size = 1}.build(Mesh{}, equal, task).nodes.size(), 11u);
}

TEST(SpatialMedian, EndsWithinItsDepthWhereEverySplitPartsOffOne) {
    // Centres at 2^-100 to 2^100: each middle leaves all but one on the left.
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < 200; ++i) {
        const float x = std::ldexp(1.0f, static_cast<int>(i) - 100);
        refs.push_back({Box{Vec3(x), Vec3(x)}, i});
    }
    Task task;
    const NodeList list = SpatialMedian{.max_leaf_size = 1}.build(Mesh{}, refs, task).list_nodes();
    uint32_t depth = 0;
    for (const NodeView& node : list.nodes) depth = std::max(depth, node.level);
    EXPECT_GT(depth, 30u);
    EXPECT_LE(depth, Bvh2::kMaxDepth);
}

}  // namespace
}  // namespace boxwood
