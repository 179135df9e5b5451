#include "core/scene/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/scene/mesh_check.h"
#include "support/processor_time.h"

namespace boxwood {
namespace {

/// Sum of the areas of the triangles that a polygon in the plane z = x is cut into, seen from +z.
double cut_area(const std::vector<Vec2>& outline, size_t& triangle_count) {
    std::vector<Vec3> positions;
    for (const Vec2& p : outline) positions.push_back({p.x, p.y, p.x});
    std::vector<uint32_t> corners(outline.size());
    std::iota(corners.begin(), corners.end(), 0u);
    Array<UVec3> triangles;
    cut_polygon(positions, corners, triangles);
    triangle_count = triangles.size();
    double area = 0.0;
    for (const UVec3& t : triangles) {
        const DVec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
        area += std::abs(0.5 * glm::cross(b - a, c - a).z);
    }
    return area;
}

double outline_area(const std::vector<Vec2>& outline) {
    double sum = 0.0;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a(outline[i]), b(outline[(i + 1) % outline.size()]);
        sum += a.x * b.y - b.x * a.y;
    }
    return std::abs(0.5 * sum);
}

std::vector<Vec2> star(size_t points, bool is_clockwise) {
    std::vector<Vec2> outline;
    for (size_t i = 0; i < 2 * points; ++i) {
        const double angle = 3.14159265358979 * static_cast<double>(i) / static_cast<double>(points);
        const double radius = i % 2 == 0 ? 1.0 : 0.3;
        const double y = radius * std::sin(angle) * (is_clockwise ? -1.0 : 1.0);
        outline.push_back({static_cast<float>(radius * std::cos(angle)), static_cast<float>(y)});
    }
    return outline;
}

TEST(Polygon, TrianglesCoverConcaveOutlinesOfBothTurns) {
    const std::vector<std::vector<Vec2>> outlines = {
        {{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}},                                          // M
        {{0, 0}, {5, 0}, {5, 1}, {1, 1}, {1, 2}, {5, 2}, {5, 3}, {0, 3}},                  // C
        {{0, 0}, {2, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}, {0, 2}},  // U, with straight
                                                                                           // corners
        star(5, false),
        star(5, true),
        star(500, false)};
    for (const std::vector<Vec2>& outline : outlines) {
        size_t count = 0;
        EXPECT_NEAR(cut_area(outline, count), outline_area(outline), 1e-5);
        EXPECT_EQ(count, outline.size() - 2);
    }
}

TEST(Polygon, DegenerateOnesStillGiveTwoTrianglesLess) {
    const std::vector<std::vector<Vec2>> outlines = {
        {{0, 0}, {0, 0}, {0, 0}, {0, 0}},
        {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}},
        {{0, 0}, {1, 1}, {1, 0}, {0, 1}},  // crosses itself
    };
    for (const std::vector<Vec2>& outline : outlines) {
        size_t count = 0;
        cut_area(outline, count);
        EXPECT_EQ(count, outline.size() - 2);
    }
}

TEST(Polygon, TimeIsBoundedForManyDents) {
    const ProcessorTimer timer;
    size_t count = 0;
    cut_area(star(10000, false), count);
    EXPECT_EQ(count, 19998u);
    EXPECT_LT(timer.milliseconds(), 2000.0);
}

TEST(Polygon, FanStartsAtTheFirstCornerThatMakesNoFlatTriangle) {
    std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const std::vector<uint32_t> corners = {0, 1, 2, 3, 4};
    Array<UVec3> triangles;
    cut_polygon(positions, corners, triangles);
    EXPECT_EQ(triangles, (Array<UVec3>{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST(Polygon, RoundedCircleIsAFanWithoutFlatTriangles) {
    std::vector<Vec3> positions;
    for (int i = 0; i < 20000; ++i) {
        const double angle = 6.28318530717958 * i / 20000.0;
        const double x = std::round(1e6 * std::cos(angle)) / 1e6, y = std::round(1e6 * std::sin(angle)) / 1e6;
        positions.push_back({static_cast<float>(x), static_cast<float>(y), 0.0f});
    }
    std::vector<uint32_t> corners(positions.size());
    std::iota(corners.begin(), corners.end(), 0u);
    Array<UVec3> triangles;
    cut_polygon(positions, corners, triangles);
    ASSERT_EQ(triangles.size(), 19998u);
    const uint32_t center = triangles[0].x;
    EXPECT_NE(center, 0u);  // the corners beside the first have the same x
    for (const UVec3& t : triangles) {
        ASSERT_EQ(t.x, center);
        ASSERT_FALSE(has_zero_area({positions[t.x], positions[t.y], positions[t.z]}));
    }
}

}  // namespace
}  // namespace boxwood
