#include "core/refs/triangle_touches_box.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/rng.h"
#include "oracle/polygon.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

/// A whole number of -2 to 2 on each axis: corners on planes, edges in faces, through edges and corners.
Vec3 lattice_point(Rng& rng) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
    return p;
}

/// Returns whether they touch, so that a test can see that both answers occur.
bool expect_exact(const Triangle& triangle, const Box& box) {
    const bool expected = oracle::touches(triangle, box);
    EXPECT_EQ(touches(triangle, box), expected);
    return expected;
}

TEST(TriangleTouchesBox, HandComputed) {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    EXPECT_TRUE(touches(triangle, {{1, 1, -1}, {2, 2, 1}}));  // a face of the box cuts the inside
    EXPECT_TRUE(touches(triangle, {{2, 2, 0}, {3, 3, 1}}));   // one common point, on the edge
    EXPECT_FALSE(touches(triangle, {{2, 2.001f, 0}, {3, 3, 1}}));
    EXPECT_FALSE(touches(triangle, {{3, 3, -1}, {4, 4, 1}}));   // inside the triangle's box
    EXPECT_TRUE(touches(triangle, {{-1, -1, -1}, {0, 0, 0}}));  // one corner
    EXPECT_FALSE(touches(triangle, {{1, 1, 0.001f}, {2, 2, 1}}));
    EXPECT_TRUE(touches(triangle, {{-9, -9, -9}, {9, 9, 9}}));
    // Three faces of the unit cube cut the plane x + y + z = 3 in one point, the corner (1, 1, 1).
    const Triangle corner{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
    EXPECT_TRUE(touches(corner, {{0, 0, 0}, {1, 1, 1}}));
    EXPECT_FALSE(touches(corner, {{0, 0, 0}, {1, 1, std::nextafter(1.0f, 0.0f)}}));
}

TEST(TriangleTouchesBox, IsExactOnRandomTriangles) {
    Rng rng(1);
    int touching = 0;
    for (int i = 0; i < 3000; ++i)
        touching += expect_exact(random_triangle(rng, -1, 1), random_box(rng, -1, 1)) ? 1 : 0;
    EXPECT_GT(touching, 300);
    EXPECT_LT(touching, 2700);
}

TEST(TriangleTouchesBox, IsExactWhereCornersAndEdgesLieInPlanes) {
    Rng rng(2);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 a = lattice_point(rng), b = lattice_point(rng), c = lattice_point(rng);
        Box box;
        box.extend(lattice_point(rng));
        box.extend(lattice_point(rng));
        expect_exact({a, b, c}, box);  // also triangles and boxes without area
    }
}

TEST(TriangleTouchesBox, IsExactWhereEdgesAndPlanesAlmostTouchTheBox) {
    Rng rng(3);
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
        const Box box = random_box(rng, -1, 1);
        Vec3 corner;
        for (int axis = 0; axis < 3; ++axis)
            corner[axis] = rng.next() < 0.5f ? box.lower[axis] : box.upper[axis];
        if (i % 2 == 0) corner[i % 3] = rng.next(-1, 1);  // a point of an edge, perhaps beyond its ends
        // Edge ab passes the corner at the distance of a rounding; or the plane does.
        Triangle triangle = random_triangle(rng, -1, 1);
        triangle.b = corner + (corner - triangle.a);
        if (i % 4 < 2) triangle.c = corner + (corner - 0.5f * (triangle.a + random_point(rng, -1, 1)));
        touching += expect_exact(triangle, box) ? 1 : 0;
    }
    EXPECT_GT(touching, 200);
    EXPECT_LT(touching, 1800);
}

TEST(TriangleTouchesBox, IsExactOnSlivers) {
    Rng rng(4);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a = random_point(rng, -1, 1), b = random_point(rng, -1, 1);
        Vec3 c = a + (b - a) * rng.next();  // off the line by a rounding
        if (i % 2 == 0) c.x = std::nextafter(c.x, 9.0f);
        expect_exact({a, b, c}, random_box(rng, -1, 1));
    }
}

TEST(TriangleTouchesBox, IsExactWhereTheNormalsSignIsLostInRounding) {
    // Two corners and the box are close to the origin, the third corner is far: its edges are parallel in
    // double, but near the short edge the triangle is as wide as the box.
    Rng rng(8);
    int touching = 0;
    for (int i = 0; i < 2000; ++i) {
        const float size = std::ldexp(1.0f, -48 - i % 8);
        Triangle triangle = random_triangle(rng, -size, size);
        triangle.b = random_point(rng, -1, 1);
        touching += expect_exact(triangle, random_box(rng, -size, size)) ? 1 : 0;
    }
    EXPECT_GT(touching, 200);
    EXPECT_LT(touching, 1800);
}

TEST(TriangleTouchesBox, IsExactFarFromTheOriginAndForAllMagnitudes) {
    Rng rng(5);
    const auto any_float = [&] {
        const float mantissa = rng.next(-1, 1);
        return rng.next() < 0.1f ? 0.0f : std::ldexp(mantissa, static_cast<int>(rng.next_index(278)) - 149);
    };
    const auto any_point = [&] {
        const float x = any_float(), y = any_float();
        return Vec3(x, y, any_float());
    };
    for (int i = 0; i < 1500; ++i) {
        const float offset = i % 2 == 0 ? 1e7f : -1e7f;
        expect_exact(random_triangle(rng, offset - 20, offset + 20),
                     random_box(rng, offset - 20, offset + 20));
        const Vec3 a = any_point(), b = any_point();
        Box box;
        box.extend(any_point());
        box.extend(any_point());
        expect_exact({a, b, any_point()}, box);
    }
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    const Triangle huge{{-most, -most, -most}, {most, most, -most}, {most, -most, most}};
    EXPECT_TRUE(expect_exact(huge, {{-1, -most, -1}, {1, 1, 1}}));
    EXPECT_FALSE(expect_exact(huge, {{-1, 1, 2}, {1, 2, 3}}));
    const Triangle tiny{{-least, 0, least}, {3 * least, -0.0f, 2 * least}, {least, 7 * least, 0}};
    EXPECT_TRUE(expect_exact(tiny, {{0, 0, -0.0f}, {2 * least, 3 * least, least}}));
}

/// 2^11 and a bit more: products of two have 23 to 24 bits, and mantissas just above a power of two, where
/// half an ulp is the largest fraction.
float number(Rng& rng) { return 2048.0f + static_cast<float>(rng.next_index(64)); }

/// Boxes that touch a triangle in a corner alone, and are said not to. The corner, and both ends of an edge,
/// lie on a line through the origin, one end so close to it that every difference rounds.
int missed_at_edges(double bound_scale, int case_count) {
    Rng rng(6);
    int missed = 0;
    for (int n = 0; n < case_count; ++n) {
        const float i = number(rng), j = number(rng), m = number(rng), k = number(rng) / 2.0f;
        const float rest = std::ldexp(2048.0f + static_cast<float>(rng.next_index(2048)), -48);
        const Triangle triangle{{i * rest, -j * rest, 0}, {i * m, -j * m, 0}, {i * m, j * m, 0}};
        const Box box{{0.0f, -2.0f * j * k, -1}, {i * k, -j * k, 1}};
        missed += TriangleBoxTest(triangle, bound_scale).touches(box) ? 0 : 1;
    }
    return missed;
}

/// Boxes that touch a triangle in a corner alone, in its inside: (a + b) / 4 + c / 2. The differences with a,
/// which is close to the origin, and all products round; the normal is nearly that of b and c.
int missed_at_planes(double bound_scale, int case_count) {
    Rng rng(7);
    const auto one = [&] { return 1.0f + 0.002f * rng.next(); };
    int missed = 0;
    for (int n = 0; n < case_count; ++n) {
        const float sign = rng.next() < 0.5f ? -1.0f : 1.0f;
        const float ay = std::ldexp(1.0f + rng.next(), -32), az = std::ldexp(sign + sign * rng.next(), -32);
        const float bx = one(), cy = one(), cz = one();
        const float cx = std::ldexp(1.0f + static_cast<float>(rng.next_index(64)), -22);
        const float x = 0.25f * bx + 0.5f * cx;
        if (double(x) != 0.25 * double(bx) + 0.5 * double(cx)) continue;
        const Triangle triangle{{0, ay, az}, {bx, -ay, -az}, {cx, cy, cz}};
        const Box box{{x, 0.4999f * cy, 0.5f * cz}, {x, 0.5f * cy, 0.5001f * cz}};
        missed += TriangleBoxTest(triangle, bound_scale).touches(box) ? 0 : 1;
    }
    return missed;
}

TEST(TriangleTouchesBox, TheErrorBoundsHoldAndHalfOfThemDoesNot) {
    EXPECT_EQ(missed_at_edges(1.0, 10000), 0);
    EXPECT_GT(missed_at_edges(0.5, 10000), 0);
    EXPECT_EQ(missed_at_planes(1.0, 80000), 0);
    EXPECT_GT(missed_at_planes(0.5, 80000), 0);
}

}  // namespace
}  // namespace boxwood
