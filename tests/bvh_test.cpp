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
    EXPECT_EQ(bvh.prims, std::vector<uint32_t>{0});
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
    EXPECT_EQ(bvh.prims, (std::vector<uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace boxwood
