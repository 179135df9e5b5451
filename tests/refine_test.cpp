#include "core/refs/refine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "oracle/polygon.h"
#include "support/skipped.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

References make(const Mesh& mesh, const Refinement& method) {
    Task task;
    return method.make(mesh, task);
}

std::vector<Box> boxes_of(std::span<const PrimRef> refs, uint32_t prim) {
    std::vector<Box> boxes;
    for (const PrimRef& ref : refs)
        if (ref.prim == prim) boxes.push_back(ref.bounds);
    return boxes;
}

TEST(Refinement, CutsOneIntoFourAsComputedByHand) {
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 0, 0}, {0, 4, 2}}});
    EXPECT_EQ(make(mesh, {.rounds = 0}).refs.size(), 1u);
    const Array<PrimRef> refs = make(mesh, {.rounds = 1}).refs;
    ASSERT_EQ(refs.size(), 4u);
    // At corner c, the middle piece, at corner b, at corner a.
    EXPECT_EQ(refs[0].bounds, (Box{{0, 2, 1}, {4, 4, 2}}));
    EXPECT_EQ(refs[1].bounds, (Box{{0, 0, 0}, {4, 2, 1}}));
    EXPECT_EQ(refs[2].bounds, (Box{{4, 0, 0}, {8, 2, 1}}));
    EXPECT_EQ(refs[3].bounds, (Box{{0, 0, 0}, {4, 2, 1}}));
    EXPECT_EQ(make(mesh, {.rounds = 5}).refs.size(), 1024u);
}

TEST(Refinement, CutsUntilNoEdgeIsLongerThanAFractionOfTheDiagonal) {
    // Longest edges 5 and 13, diagonal 13. Half of it, 6.5: none and one round; a quarter, 3.25: one and two.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 0, 0}, {5, 0, 0}, {0, 12, 0}}});
    Task task;
    const References half = Refinement{.edge = 1.0f}.make(mesh, task);
    EXPECT_EQ(boxes_of(half.refs, 0).size(), 1u);
    EXPECT_EQ(boxes_of(half.refs, 1).size(), 4u);
    EXPECT_EQ(half.split_count, 1u);
    EXPECT_EQ(skipped(task, "tight"), 1u);
    const References quarter = Refinement{.edge = 2.0f}.make(mesh, task);
    EXPECT_EQ(boxes_of(quarter.refs, 0).size(), 4u);
    EXPECT_EQ(boxes_of(quarter.refs, 1).size(), 16u);
    for (const PrimRef& ref : quarter.refs) EXPECT_LE(glm::length(ref.bounds.extent()), 3.25);
}

TEST(Refinement, TheUnionOfTheBoxesContainsTheTriangle) {
    for (const auto& [lower, upper] : {std::pair{-1.0f, 1.0f}, std::pair{1e7f - 50.0f, 1e7f + 50.0f},
                                       std::pair{-1e-38f, 1e-38f}, std::pair{-1e38f, 1e38f}}) {
        const Mesh mesh = make_mesh(random_triangles(6, lower, upper, 1));
        for (const int rounds : {1, 2, 3}) {
            const Array<PrimRef> refs = make(mesh, {.rounds = rounds}).refs;
            for (uint32_t prim = 0; prim < 6; ++prim) {
                const std::vector<Box> boxes = boxes_of(refs, prim);
                ASSERT_EQ(boxes.size(), size_t{1} << (2 * rounds));
                ASSERT_TRUE(oracle::covers(boxes, mesh.triangle(prim))) << lower << ", rounds " << rounds;
            }
        }
    }
}

TEST(Refinement, EachBoxContainsItsExactPieceWhereSumsRound) {
    // Coordinates of very different size: the exact corners (i a + j b + k c) / 4, by the order of emission.
    Rng rng(2);
    for (int run = 0; run < 300; ++run) {
        Vec3 corners[3];
        for (Vec3& corner : corners)
            for (int axis = 0; axis < 3; ++axis) {
                const float value = rng.next(-2.0f, 2.0f);
                corner[axis] = std::ldexp(value, -static_cast<int>(rng.next_index(40)));
            }
        const Mesh mesh = make_mesh({{corners[0], corners[1], corners[2]}});
        const Array<PrimRef> refs = make(mesh, {.rounds = 2}).refs;
        ASSERT_EQ(refs.size(), 16u);
        const auto is_inside = [&](const Box& box, int i, int j) {
            for (int axis = 0; axis < 3; ++axis) {
                const mpq_class x = (i * mpq_class(corners[0][axis]) + j * mpq_class(corners[1][axis]) +
                                     (4 - i - j) * mpq_class(corners[2][axis])) /
                                    4;
                if (x < mpq_class(box.lower[axis]) || x > mpq_class(box.upper[axis])) return false;
            }
            return true;
        };
        size_t next = 0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; i + j < 4; ++j) {
                const Box& upright = refs[next++].bounds;
                ASSERT_TRUE(is_inside(upright, i, j) && is_inside(upright, i + 1, j) &&
                            is_inside(upright, i, j + 1));
                if (i + j == 3) continue;
                const Box& turned = refs[next++].bounds;
                ASSERT_TRUE(is_inside(turned, i + 1, j) && is_inside(turned, i, j + 1) &&
                            is_inside(turned, i + 1, j + 1));
            }
    }
}

TEST(Refinement, BoundOfCornersHoldsAndHalfOfItDoesNot) {
    // 2u M, as derived in refine.cpp: (14 a + b + c) / 16 on one axis, a just above 1, b and c so small
    // that both sums round.
    Rng rng(5);
    double largest_ratio = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double a = double(1.0f + 0.15f * rng.next());
        const auto small = [&] {
            const float value = rng.next(-2.0f, 2.0f);
            return double(std::ldexp(value, -30 - static_cast<int>(rng.next_index(20))));
        };
        const double b = small(), c = small();
        const double corner = (14.0 * a + 1.0 * b + 1.0 * c) / 16.0;
        const mpq_class exact = (14 * mpq_class(a) + mpq_class(b) + mpq_class(c)) / 16;
        const mpq_class error = abs(mpq_class(exact - mpq_class(corner)));
        largest_ratio = std::max(largest_ratio, error.get_d() / (2.0 * 0x1p-53 * a));
    }
    EXPECT_LE(largest_ratio, 1.0);
    EXPECT_GT(largest_ratio, 0.5);
}

TEST(Refinement, StaysInsideItsBudgetByWholeRounds) {
    const Mesh mesh = make_mesh(random_triangles(10, -1, 1, 3));
    Task task;
    const Refinement method{.rounds = 10, .budget = {.per_triangle = 100, .at_least = 0}};
    const References references = method.make(mesh, task);
    EXPECT_EQ(references.refs.size(), 640u);  // three rounds: a fourth would make 2560
    EXPECT_EQ(skipped(task, "over the reference budget"), 10u);
    const Refinement by_edge{.edge = 20.0f, .budget = {.per_triangle = 100, .at_least = 0}};
    EXPECT_LE(make(mesh, by_edge).refs.size(), 1000u);
    EXPECT_GT(make(mesh, by_edge).refs.size(), 100u);
}

TEST(Refinement, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = make_mesh(random_triangles(3000, -1, 1, 4));
    const Array<PrimRef> many = make(mesh, {.rounds = 2}).refs;
    const ThreadLimit limit(1);
    EXPECT_EQ(many, make(mesh, {.rounds = 2}).refs);
}

TEST(Refinement, AnEmptyMeshHasNoReferences) { EXPECT_TRUE(make(Mesh{}, {}).refs.empty()); }

}  // namespace
}  // namespace boxwood
