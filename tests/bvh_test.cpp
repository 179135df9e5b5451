#include <gtest/gtest.h>

#include "core/bvh/binned_sah.h"
#include "core/bvh/sweep_sah.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

TEST(Bvh, HoldsAPrimitiveOnceInEachLeaf) {
    Task task;
    const Mesh mesh = random_triangles(1, 0.5f, 4);
    const std::vector<PrimRef> refs(6, PrimRef{mesh.triangle(0).bounds(), 0});
    const Bvh2 bvh = BinnedSah{}.build(mesh, refs, task);
    EXPECT_EQ(bvh.prims, Array<uint32_t>{0});
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
    EXPECT_EQ(bvh.prims, (Array<uint32_t>{0, 1, 2, 3}));
}

TEST(SweepSah, WeighsEveryPlaceByTheLecturesFormula) {
    // Unit cubes at 0, 1, 2, 10. LSA(1..3) = 6, 10, 14; RSA(1..3) = 42, 38, 6; f(i) = LSA(i) i + RSA(i) (4 -
    // i) = 132, 96, 48: three go left, on whichever axis they stand. The object median takes two, a sweep
    // that is off by one in either array another place.
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<PrimRef> refs;
        for (const float x : {2.0f, 10.0f, 0.0f, 1.0f}) {  // not parted by number
            Box box{Vec3(0.0f), Vec3(1.0f)};
            box.lower[axis] = x;
            box.upper[axis] = x + 1.0f;
            refs.push_back({box, static_cast<uint32_t>(refs.size())});
        }
        Task task;
        const Bvh2 bvh = SweepSah{.max_leaf_size = 3, .traversal_cost = 2.0f}.build(Mesh{}, refs, task);
        ASSERT_EQ(bvh.nodes.size(), 3u);
        EXPECT_EQ(bvh.nodes[1].count, 3u);
        EXPECT_EQ(bvh.prims, (Array<uint32_t>{0, 2, 3, 1}));
        EXPECT_EQ(bvh.nodes[1].upper[axis], 3.0f);
        EXPECT_EQ(bvh.nodes[2].lower[axis], 10.0f);
    }
}

TEST(SweepSah, StopsWhereALeafIsCheaper) {
    // Two unit cubes side by side, half areas 3 and 3, together 5: 1 + (3 + 3) / 5 = 2.2 tests against 2.
    // Farther apart, 3 and 3 in 21: 1 + 6 / 21 against 2.
    Task task;
    for (const float x : {1.0f, 9.0f}) {
        const std::vector<PrimRef> refs = {{Box{Vec3(0), Vec3(1)}, 0},
                                           {Box{Vec3(x, 0, 0), Vec3(x + 1, 1, 1)}, 1}};
        EXPECT_EQ(SweepSah{.max_leaf_size = 2}.build(Mesh{}, refs, task).nodes.size(), x == 1.0f ? 1u : 3u);
    }
}

}  // namespace
}  // namespace boxwood
