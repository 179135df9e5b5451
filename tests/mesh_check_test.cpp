#include "core/scene/mesh_check.h"

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <cmath>
#include <limits>

#include "core/base/rng.h"

namespace boxwood {
namespace {

/// Whether (b - a) x (c - a) is zero, in rational arithmetic.
bool is_zero_by_rationals(const Triangle& t) {
    const auto exact = [](float f) { return mpq_class(static_cast<double>(f)); };
    for (int u = 0; u < 3; ++u) {
        const int v = (u + 1) % 3;
        const mpq_class bu = exact(t.b[u]) - exact(t.a[u]), bv = exact(t.b[v]) - exact(t.a[v]);
        const mpq_class cu = exact(t.c[u]) - exact(t.a[u]), cv = exact(t.c[v]) - exact(t.a[v]);
        if (bu * cv != bv * cu) return false;
    }
    return true;
}

TEST(ZeroArea, IsDecidedExactly) {
    constexpr float kTiny = std::numeric_limits<float>::denorm_min(),
                    kHuge = std::numeric_limits<float>::max();
    EXPECT_FALSE(has_zero_area({{0, 0, 0}, {kTiny, 0, 0}, {0, kTiny, 0}}));  // area 2^-299: zero in any float
    EXPECT_FALSE(has_zero_area({{-kHuge, 0, 0}, {kHuge, 0, 0}, {0, kTiny, 0}}));
    EXPECT_FALSE(has_zero_area({{kHuge, 0, 0}, {0, kHuge, 0}, {0, 0, kHuge}}));
    EXPECT_TRUE(has_zero_area({{1, 2, 3}, {1, 2, 3}, {4, 5, 6}}));
    EXPECT_TRUE(has_zero_area({{0, 0, 0}, {0.1f, 0.2f, 0.3f}, {0.2f, 0.4f, 0.6f}}));   // twice the floats
    EXPECT_FALSE(has_zero_area({{0, 0, 0}, {0.1f, 0.2f, 0.3f}, {0.3f, 0.6f, 0.9f}}));  // off by a rounding
    EXPECT_TRUE(has_zero_area({{-kHuge, -kHuge, 0}, {0, 0, 0}, {kHuge, kHuge, 0}}));
}

TEST(ZeroArea, AgreesWithRationalsNearCollinear) {
    Rng rng(1);
    int zero_count = 0;
    for (int i = 0; i < 4000; ++i) {
        Triangle t{};
        for (int axis = 0; axis < 3; ++axis) {
            const float start = std::ldexp(static_cast<float>(rng.next_index(64)), -3);
            const float step = static_cast<float>(rng.next_index(5)) - 2.0f;
            t.a[axis] = start;
            t.b[axis] = start + step;
            t.c[axis] = start - 3.0f * step;
            if (rng.next_index(9) == 0) t.c[axis] = std::nextafter(t.c[axis], 1e9f);
        }
        const bool is_zero = is_zero_by_rationals(t);
        zero_count += is_zero ? 1 : 0;
        ASSERT_EQ(has_zero_area(t), is_zero) << i;
    }
    EXPECT_GT(zero_count, 500);
    EXPECT_LT(zero_count, 3800);
}

TEST(CheckMesh, DropsAndCountsWhatNoStageMaySee) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kNan, 0, 0}, {2, 0, 0}};
    mesh.triangles = {{0, 1, 7}, {0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {2, 1, 4}};
    mesh.object = {0, 1, 2, 3, 4};
    mesh.objects.resize(5);
    Task task;
    check_mesh(mesh, task);
    EXPECT_EQ(mesh.triangles, (Array<UVec3>{{0, 1, 2}, {2, 1, 4}}));
    EXPECT_EQ(mesh.source_prim, (std::vector<uint32_t>{1, 4}));
    EXPECT_EQ(mesh.object, (std::vector<uint32_t>{1, 4}));
    EXPECT_EQ(mesh.positions[3], Vec3(0.0f));
    const std::map<std::string, uint64_t> expected = {
        {"index out of range", 1}, {"non-finite vertex", 1}, {"zero area", 1}};
    EXPECT_EQ(task.skipped.counts(), expected);
}

TEST(CheckMesh, KeepsTheNumbersOfAnEarlierCheck) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 0, 1}, {0, 1, 2}};
    mesh.object = {0, 0};
    mesh.source_prim = {4, 9};
    Task task;
    check_mesh(mesh, task);
    EXPECT_EQ(mesh.source_prim, (std::vector<uint32_t>{9}));
}

}  // namespace
}  // namespace boxwood
