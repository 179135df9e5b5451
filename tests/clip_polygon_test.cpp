#include "core/refs/clip_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "oracle/polygon.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The face must be the float next to the exact extreme: not inside it, less than an ulp outside.
void expect_smallest_box(const Triangle& triangle, const Box& box) {
    const std::vector<oracle::ExactPoint> part = oracle::clip(triangle, box);
    const Box result = clip_bounds(triangle, box);
    ASSERT_EQ(result.is_empty(), part.empty());
    if (part.empty()) return;
    for (int axis = 0; axis < 3; ++axis) {
        const size_t k = static_cast<size_t>(axis);
        const auto [least, largest] = std::minmax_element(
            part.begin(), part.end(),
            [&](const oracle::ExactPoint& a, const oracle::ExactPoint& b) { return a[k] < b[k]; });
        const mpq_class lower = (*least)[k], upper = (*largest)[k];
        const float next = std::nextafter(result.lower[axis], kInfinity);
        const float previous = std::nextafter(result.upper[axis], -kInfinity);
        ASSERT_LE(mpq_class(double(result.lower[axis])), lower);
        ASSERT_TRUE(std::isinf(next) || mpq_class(double(next)) > lower);
        ASSERT_GE(mpq_class(double(result.upper[axis])), upper);
        ASSERT_TRUE(std::isinf(previous) || mpq_class(double(previous)) < upper);
    }
}

/// A whole number of -2 to 2 on each axis: corners on planes, edges in faces, through edges and corners.
Vec3 lattice_point(Rng& rng) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
    return p;
}

TEST(ClipBounds, HandComputed) {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    // Cut at x = 1: the part has the corners (0,0), (1,0), (1,3), (0,4).
    EXPECT_EQ(clip_bounds(triangle, {{0, 0, 0}, {1, 4, 0}}), (Box{{0, 0, 0}, {1, 4, 0}}));
    EXPECT_EQ(clip_bounds(triangle, {{1, 0, 0}, {4, 4, 0}}), (Box{{1, 0, 0}, {4, 3, 0}}));
    // The box's edge along z at (1, 1) passes through the inside.
    EXPECT_EQ(clip_bounds(triangle, {{1, 1, -1}, {9, 9, 1}}), (Box{{1, 1, 0}, {3, 3, 0}}));
    EXPECT_TRUE(clip_bounds(triangle, {{3, 3, 0}, {4, 4, 0}}).is_empty());
    EXPECT_TRUE(clip_bounds(triangle, {{0, 0, 1}, {4, 4, 2}}).is_empty());
    // A common point, and no more.
    EXPECT_EQ(clip_bounds(triangle, {{2, 2, 0}, {4, 4, 0}}), (Box{{2, 2, 0}, {2, 2, 0}}));
    // x = 1/3 is no float, its nearest float lies above: the faces are the floats around it.
    const Triangle slope{{0, 0, 0}, {1, 3, 0}, {0, 3, 0}};
    EXPECT_EQ(clip_bounds(slope, {{0, 0, 0}, {1, 1, 0}}).upper.x, 1.0f / 3.0f);
    const Triangle mirrored{{0, 0, 0}, {-1, 3, 0}, {0, 3, 0}};
    EXPECT_EQ(clip_bounds(mirrored, {{-1, 0, 0}, {0, 1, 0}}).lower.x, -1.0f / 3.0f);
}

TEST(ClipBounds, IsTheSmallestBoxOnRandomTriangles) {
    Rng rng(1);
    for (int i = 0; i < 1500; ++i) expect_smallest_box(random_triangle(rng, -1, 1), random_box(rng, -1, 1));
}

TEST(ClipBounds, IsTheSmallestBoxWhereCornersAndEdgesLieInPlanes) {
    Rng rng(2);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 a = lattice_point(rng), b = lattice_point(rng), c = lattice_point(rng);
        Box box;
        box.extend(lattice_point(rng));
        box.extend(lattice_point(rng));
        expect_smallest_box({a, b, c}, box);  // also triangles and boxes without area
    }
}

TEST(ClipBounds, IsTheSmallestBoxWhereEdgesAlmostPassThroughTheBoxsEdges) {
    Rng rng(3);
    for (int i = 0; i < 1500; ++i) {
        const Box box = random_box(rng, -1, 1);
        Triangle triangle = random_triangle(rng, -1, 1);
        const Vec3 corner(rng.next() < 0.5f ? box.lower.x : box.upper.x,
                          rng.next() < 0.5f ? box.lower.y : box.upper.y, rng.next(-1, 1));
        triangle.b = corner + (corner - triangle.a);  // ab passes the corner at the distance of a rounding
        expect_smallest_box(triangle, box);
    }
}

TEST(ClipBounds, IsTheSmallestBoxOnSlivers) {
    Rng rng(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a = random_point(rng, -1, 1), b = random_point(rng, -1, 1);
        Vec3 c = a + (b - a) * rng.next();  // off the line by a rounding
        if (i % 2 == 0) c.x = std::nextafter(c.x, 9.0f);
        expect_smallest_box({a, b, c}, random_box(rng, -1, 1));
    }
}

TEST(ClipBounds, IsTheSmallestBoxFarFromTheOrigin) {
    Rng rng(5);
    for (int i = 0; i < 1000; ++i) {
        const float offset = i % 2 == 0 ? 1e7f : -1e7f;
        expect_smallest_box(random_triangle(rng, offset - 20, offset + 20),
                            random_box(rng, offset - 20, offset + 20));
    }
}

TEST(ClipBounds, IsTheSmallestBoxAcrossTheOriginAndForAllMagnitudes) {
    Rng rng(6);
    const auto any_float = [&] {
        const float mantissa = rng.next(-1, 1);
        return rng.next() < 0.1f ? 0.0f : std::ldexp(mantissa, static_cast<int>(rng.next_index(278)) - 149);
    };
    const auto any_point = [&](int i) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = i % 2 == 0 ? any_float()
                                 : std::ldexp(rng.next(-1, 1), static_cast<int>(rng.next_index(60)) - 60);
        return p;
    };
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a = any_point(i), b = any_point(i), c = any_point(i);
        Box box;
        box.extend(any_point(i));
        box.extend(any_point(i));
        expect_smallest_box({a, b, c}, box);
        expect_smallest_box({a, -a, c}, {-glm::abs(b), glm::abs(b)});  // ab passes the origin
    }
}

TEST(ClipBounds, TheEndsOfFloatDoNotOverflow) {
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    const Triangle huge{{-most, -most, -most}, {most, most, -most}, {most, -most, most}};
    expect_smallest_box(huge, {{-1, -1, -1}, {1, 1, 1}});
    expect_smallest_box(huge, {{-most, -most, -most}, {0, most, most}});
    expect_smallest_box(huge, {{0, -most, 1e30f}, {most, most, most}});
    const Triangle tiny{{-least, 0, least}, {3 * least, -0.0f, 2 * least}, {least, 7 * least, 0}};
    expect_smallest_box(tiny, {{0, 0, -0.0f}, {2 * least, 3 * least, least}});
}

TEST(ClipBounds, DoesNotDependOnTheOrderOfCorners) {
    Rng rng(7);
    for (int i = 0; i < 500; ++i) {
        const Triangle t = random_triangle(rng, -1, 1);
        const Box box = random_box(rng, -1, 1);
        const Box first = clip_bounds(t, box);
        EXPECT_EQ(first, clip_bounds({t.b, t.c, t.a}, box));
        EXPECT_EQ(first, clip_bounds({t.b, t.a, t.c}, box));
    }
}

/// Boxes that cut off some of the part, where an edge crosses the plane z = K so that x is very close to a
/// float: x = m + K x0 / z0 for ends at m +- x0 and +- z0; K x0 / z0 is a multiple of 2^-36, the distance of
/// floats near m, but for 2^-24 of it.
int boxes_too_small(double bound_scale, int case_count) {
    Rng rng(8);
    int too_small = 0;
    for (int i = 0; i < case_count; ++i) {
        const float x = 1.0f + 0.03f * rng.next(), z = 1.0f + 0.03f * rng.next();
        const float middle = std::ldexp(1.0f + static_cast<float>(rng.next_index(256)) / 256.0f, -13);
        const double step = std::ldexp(1.0 + static_cast<double>(rng.next_index(31)), -36);
        const float plane = static_cast<float>(step * double(z) / double(x));
        const Triangle triangle{{x + middle, 0, z}, {middle - x, 0, -z}, {4, 1, z}};
        const Box box{{-2, -1, plane}, {6, 2, 2}};
        const std::vector<oracle::ExactPoint> part = oracle::clip(triangle, box);
        const float lower = clip_bounds(triangle, box, bound_scale).lower.x;
        for (const oracle::ExactPoint& p : part)
            if (p[0] < double(lower)) {
                ++too_small;
                break;
            }
    }
    return too_small;
}

TEST(ClipBounds, TheErrorBoundHoldsAndHalfOfItDoesNot) {
    EXPECT_EQ(boxes_too_small(1.0, 6000), 0);
    EXPECT_GT(boxes_too_small(0.5, 6000), 0);
}

/// A sliver along (y, z) = (1, 1), close to whose long side ab an edge of the box along x passes. There x is
/// that of a and b but for a small share of c's, and the farthest of the part. The distances in y and z from
/// the box's edge round, and so do their products, whose difference is 2^-17 of them.
struct PastBoxEdge {
    Triangle triangle;
    Box box;
};
PastBoxEdge past_box_edge(const Vec3& a, const Vec3& b, const Vec3& c, float y, float z) {
    return {{a, b, c}, {{-2, -2, z}, {2, y, 2}}};
}
PastBoxEdge past_box_edge(Rng& rng) {
    const auto one = [&] { return 1.0f + 0.03f * rng.next(); };
    const auto tiny = [&] {
        const float value = rng.next() < 0.5f ? -one() : one();
        return std::ldexp(value, -36 - static_cast<int>(rng.next_index(9)));
    };
    const float ay = one(), az = one(), bx = one(), scale = one(), offset = std::ldexp(one(), -17);
    const Vec3 a(-one(), ay, az), b(-bx, -ay * scale, -az * scale + offset);
    const float cx = one(), cy = std::ldexp(one(), -16), y = tiny(), z = tiny();
    return past_box_edge(a, b, {cx, cy, -cy}, y, z);
}

/// The cases were found among 50000 slivers, by trying thousands of c.x where the areas round far.
TEST(ClipBounds, TheErrorBoundAtTheBoxsEdgesHoldsAndHalfOfItDoesNot) {
    Rng rng(9);
    for (int i = 0; i < 2000; ++i) {
        const PastBoxEdge test = past_box_edge(rng);
        expect_smallest_box(test.triangle, test.box);
    }
    const PastBoxEdge found[] = {
        past_box_edge({-0x1.07108cp+0f, 0x1.015034p+0f, 0x1.0636f4p+0f},
                      {-0x1.07406ap+0f, -0x1.081f28p+0f, -0x1.0d2698p+0f},
                      {0x1.07888ap+0f, 0x1.055aaap-16f, -0x1.055aaap-16f}, 0x1.001d16p-42f, -0x1.053dap-43f),
        past_box_edge({-0x1.02695p+0f, 0x1.03d71ap+0f, 0x1.00fa9cp+0f},
                      {-0x1.04e4e8p+0f, -0x1.086d22p+0f, -0x1.058332p+0f},
                      {0x1.0718d6p+0f, 0x1.03c934p-16f, -0x1.03c934p-16f}, 0x1.01dd6p-42f, -0x1.044b22p-41f),
        past_box_edge({-0x1.010ae4p+0f, 0x1.0402b6p+0f, 0x1.04c13cp+0f},
                      {-0x1.079304p+0f, -0x1.081e46p+0f, -0x1.08df4cp+0f},
                      {0x1.062764p+0f, 0x1.012e88p-16f, -0x1.012e88p-16f}, -0x1.040c6ep-39f, 0x1.00303p-41f)};
    for (const PastBoxEdge& test : found) {
        expect_smallest_box(test.triangle, test.box);
        const float right = clip_bounds(test.triangle, test.box).upper.x;
        EXPECT_LT(clip_bounds(test.triangle, test.box, 0.5).upper.x, right);
    }
}

}  // namespace
}  // namespace boxwood
