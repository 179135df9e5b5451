#include "oracle/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.h"
#include "core/refs/early_split_clipping.h"
#include "core/refs/edge_volume.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

/// A whole number of -2 to 2 on each axis.
Vec3 lattice_point(Rng& rng) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
    return p;
}

TEST(OraclePolygon, TouchesAsComputedByHand) {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    EXPECT_TRUE(oracle::touches(triangle, {{2, 2, 0}, {4, 4, 1}}));  // one point in common
    EXPECT_FALSE(oracle::touches(triangle, {{2, std::nextafter(2.0f, 9.0f), 0}, {4, 4, 1}}));
    EXPECT_FALSE(oracle::touches(triangle, {{0, 0, 1e-30f}, {4, 4, 1}}));
    EXPECT_TRUE(oracle::touches({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}));
    EXPECT_FALSE(oracle::touches({{0, 0, 0}, {2, 2, 0}, {1, 1, 0}}, {{1, 0, 0}, {2, 0.5f, 0}}));
}

TEST(OraclePolygon, SeparatingAxesAndClippingDecideAlike) {
    Rng rng(1);
    int touch_count = 0;
    for (int i = 0; i < 6000; ++i) {
        const bool is_lattice = i % 3 != 0;
        const auto point = [&] { return is_lattice ? lattice_point(rng) : random_point(rng, 1.0f); };
        const Vec3 a = point(), b = point(), c = point();
        Box box;
        box.extend(point());
        box.extend(point());
        const bool touches = oracle::touches({a, b, c}, box);
        ASSERT_EQ(touches, !oracle::clip({a, b, c}, box).empty()) << "case " << i;
        touch_count += touches;
    }
    EXPECT_GT(touch_count, 1000);
    EXPECT_LT(touch_count, 5000);
}

TEST(OraclePolygon, CoversAsComputedByHand) {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const Box left{{0, 0, 0}, {2, 4, 0}}, right{{2, 0, 0}, {4, 2, 0}};
    const std::array boxes = {left, right};
    EXPECT_TRUE(oracle::covers(boxes, triangle));
    EXPECT_FALSE(oracle::covers(std::span(boxes).first(1), triangle));
    EXPECT_FALSE(oracle::covers({}, triangle));
    const float above = std::nextafter(2.0f, 3.0f), below = std::nextafter(2.0f, 1.0f);
    EXPECT_FALSE(oracle::covers(std::array{left, Box{{above, 0, 0}, {4, 2, 0}}}, triangle));
    EXPECT_FALSE(oracle::covers(std::array{left, Box{{2, 0, 0}, {4, below, 0}}}, triangle));
    // A triangle that is a segment, and one that is a point.
    const Triangle segment{{0, 0, 0}, {4, 0, 0}, {1, 0, 0}}, point{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    EXPECT_TRUE(oracle::covers(boxes, segment));
    EXPECT_FALSE(oracle::covers(std::array{left, Box{{above, 0, 0}, {4, 2, 0}}}, segment));
    EXPECT_TRUE(oracle::covers(boxes, point));
    EXPECT_FALSE(oracle::covers(std::span(boxes).last(1), point));
}

/// Random triangles, slivers and needles, scaled and moved as rounded.
Mesh subdivided_mesh(uint64_t seed, float offset, float scale) {
    Mesh mesh = random_triangles(12, 1.0f, seed);
    Rng rng(seed);
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        Vec3 *a = &mesh.positions[3 * i], *b = a + 1, *c = a + 2;
        if (i % 3 == 1) *c = *a + (*b - *a) * rng.next();           // off the line by a rounding
        if (i % 3 == 2) *b = *a + 1e-6f * random_point(rng, 1.0f);  // a short edge
    }
    for (Vec3& p : mesh.positions) p = p * scale + Vec3(offset);
    return mesh;
}

/// Faces that, moved inward by one float, leave some of the triangle outside all of its boxes.
int needed_faces(std::vector<Box> boxes, const Triangle& triangle) {
    int needed = 0;
    for (Box& box : boxes)
        for (int axis = 0; axis < 3; ++axis)
            for (float* face : {&box.lower[axis], &box.upper[axis]}) {
                const float was = *face;
                *face = std::nextafter(was, face == &box.lower[axis] ? box.upper[axis] : box.lower[axis]);
                needed += *face != was && !oracle::covers(boxes, triangle);
                *face = was;
            }
    return needed;
}

TEST(OraclePolygon, ARoundingTurnedInwardLeavesAGap) {
    const Mesh mesh = random_triangles(6, 1.0f, 3);
    for (const char* method : {"evh", "esc"}) {
        Task task;
        const References references =
            method == std::string("evh")
                ? EdgeVolume{.t = 7}.make(mesh, task)
                : EarlySplitClipping{.limit = {.absolute = false, .value = 5.0}}.make(mesh, task);
        int face_count = 0, needed = 0;
        for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
            std::vector<Box> boxes;
            for (const PrimRef& ref : references.refs)
                if (ref.prim == prim) boxes.push_back(ref.bounds);
            face_count += 6 * static_cast<int>(boxes.size());
            needed += needed_faces(boxes, mesh.triangle(prim));
        }
        // Disjoint boxes that are as small as can be need every face; those of edge volume overlap.
        if (method == std::string("esc")) {
            EXPECT_EQ(needed, face_count);
        } else {
            EXPECT_GT(needed, face_count / 10);
        }
    }
}

template <class Method>
void expect_cover(const Method& method, const Mesh& mesh, size_t least_refs) {
    Task task;
    const References references = method.make(mesh, task);
    EXPECT_GE(references.refs.size(), least_refs);
    std::vector<std::vector<Box>> boxes(mesh.triangle_count());
    for (const PrimRef& ref : references.refs) boxes[ref.prim].push_back(ref.bounds);
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        ASSERT_TRUE(oracle::covers(boxes[prim], mesh.triangle(prim))) << "primitive " << prim;
        // Without any one of several boxes that are needed something is left: the check can fail.
        if (boxes[prim].size() > 4) {
            EXPECT_FALSE(oracle::covers(std::span(boxes[prim]).subspan(2), mesh.triangle(prim)));
        }
    }
}

template <class Method>
void expect_covers(const Method& method, size_t least_refs) {
    for (uint64_t seed = 1; seed <= 3; ++seed)
        expect_cover(method, subdivided_mesh(seed, 0.0f, 1.0f), least_refs);
    for (const float offset : {3.0f, 1e3f, -1e5f, 1e7f})
        expect_cover(method, subdivided_mesh(5, offset, offset > 1e6f ? 100.0f : 1.0f), 12);
    for (const float scale : {0x1p-100f, 0x1p-30f, 0x1p70f, 0x1p100f})
        expect_cover(method, subdivided_mesh(6, 0.0f, scale), least_refs);
}

TEST(EdgeVolume, TheUnionOfBoxesContainsTheTriangleExactly) { expect_covers(EdgeVolume{.t = 9}, 30); }

TEST(EarlySplitClipping, TheUnionOfBoxesContainsTheTriangleExactly) {
    expect_covers(EarlySplitClipping{.limit = {.absolute = false, .value = 7.0}}, 30);
}

}  // namespace
}  // namespace boxwood
