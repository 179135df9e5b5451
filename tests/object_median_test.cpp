#include "core/bvh/object_median.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random_mesh.h"

namespace boxwood {
namespace {

PrimRef point_ref(const Vec3& point, uint32_t prim) { return {Box{point, point}, prim}; }

/// Primitives of each leaf, from left to right.
std::vector<std::vector<uint32_t>> leaves_of(const Bvh2& bvh) {
    std::vector<std::vector<uint32_t>> leaves;
    std::vector<uint32_t> stack{0};
    while (!stack.empty()) {
        const Bvh2::Node& node = bvh.nodes[stack.back()];
        stack.pop_back();
        if (node.is_leaf()) {
            const auto first = bvh.prims.begin() + node.first;
            leaves.push_back(std::vector<uint32_t>(first, first + node.count));
        } else {
            stack.push_back(node.first + 1);
            stack.push_back(node.first);
        }
    }
    return leaves;
}

using Leaves = std::vector<std::vector<uint32_t>>;

TEST(ObjectMedian, HalvesByCountAndTheAxesTakeTurns) {
    // By hand: the root in x: {0 1 2 3 | 4 5 6 7}. Level 1 in y: on the left 1, 3, 0, 2 at y = 1, 3, 5, 7, on
    // the right 4, 6, 7, 5 at y = 0, 2, 4, 6. Level 2 in z, which falls as the number grows.
    const float y[] = {5, 1, 7, 3, 0, 6, 2, 4};
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < 8; ++i)
        refs.push_back(point_ref({static_cast<float>(i), y[i], -static_cast<float>(i)}, i));
    Task task;
    const Mesh mesh;
    EXPECT_EQ(leaves_of(ObjectMedian{.max_leaf_size = 4}.build(mesh, refs, task)),
              (Leaves{{0, 1, 2, 3}, {4, 5, 6, 7}}));
    EXPECT_EQ(leaves_of(ObjectMedian{.max_leaf_size = 2}.build(mesh, refs, task)),
              (Leaves{{1, 3}, {0, 2}, {4, 6}, {5, 7}}));
    EXPECT_EQ(leaves_of(ObjectMedian{.max_leaf_size = 1}.build(mesh, refs, task)),
              (Leaves{{3}, {1}, {2}, {0}, {6}, {4}, {7}, {5}}));
}

TEST(ObjectMedian, TheSmallerHalfOfAnOddCountGoesLeft) {
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < 5; ++i) refs.push_back(point_ref({static_cast<float>(i), 0, 0}, i));
    Task task;
    EXPECT_EQ(leaves_of(ObjectMedian{.max_leaf_size = 3}.build(Mesh{}, refs, task)),
              (Leaves{{0, 1}, {2, 3, 4}}));
}

TEST(ObjectMedian, EqualCentresAreHalvedByPrimitiveWhateverTheInputOrder) {
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < 4; ++i)
        refs.push_back(
            {Box{Vec3(-1.0f - static_cast<float>(i % 2)), Vec3(1.0f + static_cast<float>(i % 2))}, i});
    Task task;
    const Leaves expected{{0, 1}, {2, 3}};
    do {
        EXPECT_EQ(leaves_of(ObjectMedian{.max_leaf_size = 2}.build(Mesh{}, refs, task)), expected);
    } while (std::ranges::next_permutation(refs, {}, &PrimRef::prim).found);
}

TEST(ObjectMedian, IsAsDeepAsHalvingMakesItForEveryInput) {
    Task task;
    for (const float size : {1e-30f, 0.1f, 1e37f}) {
        const Mesh mesh = random_triangles(1000, size, 1);
        const NodeList list =
            ObjectMedian{.max_leaf_size = 1}.build(mesh, whole_refs(mesh), task).list_nodes();
        for (const NodeView& node : list.nodes) ASSERT_LE(node.level, 10u);  // 2^10 = 1024
    }
}

}  // namespace
}  // namespace boxwood
