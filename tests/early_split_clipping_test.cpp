#include "core/refs/early_split_clipping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/refs/subdivision.h"
#include "oracle/polygon.h"
#include "support/skipped.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

EarlySplitClipping relative(double s) { return {.limit = {.absolute = false, .value = s}}; }
EarlySplitClipping absolute(double sa) { return {.limit = {.absolute = true, .value = sa}}; }

References make(const Mesh& mesh, const EarlySplitClipping& method) {
    Task task;
    return method.make(mesh, task);
}

/// The boxes of a triangle have disjoint interiors, and the parts of the triangle in them make up all of it:
/// in exact arithmetic their areas sum to the triangle's. (Where the triangle lies in a plane between two
/// boxes, a part would count twice; the inputs avoid it.)
void expect_a_partition(const Mesh& mesh, std::span<const PrimRef> refs) {
    size_t next = 0;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const Triangle triangle = mesh.triangle(prim);
        const size_t first = next;
        oracle::ExactPoint sum;
        for (; next < refs.size() && refs[next].prim == prim; ++next) {
            const Box& box = refs[next].bounds;
            ASSERT_TRUE(triangle.bounds().contains(box));
            const oracle::ExactPoint part = oracle::area_vector(oracle::clip(triangle, box));
            for (size_t k = 0; k < 3; ++k) sum[k] += part[k];
            for (size_t other = first; other < next; ++other) {
                const Box& b = refs[other].bounds;
                const bool are_apart = glm::any(glm::lessThanEqual(box.upper, b.lower)) ||
                                       glm::any(glm::lessThanEqual(b.upper, box.lower));
                ASSERT_TRUE(are_apart) << "primitive " << prim;
            }
        }
        const oracle::ExactPoint whole =
            oracle::area_vector({oracle::exact_point(triangle.a), oracle::exact_point(triangle.b),
                                 oracle::exact_point(triangle.c)});
        ASSERT_EQ(sum, whole) << "primitive " << prim;
    }
    ASSERT_EQ(next, refs.size());
}

TEST(EarlySplitClipping, SplitsAsComputedByHand) {
    // Box 8 x 4 x 0, area 64. sa = 63: cut at x = 4; the line from (8, 0) to (0, 4) is at y = 2 there.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 0, 0}, {0, 4, 0}}});
    EXPECT_EQ(make(mesh, absolute(64)).refs.size(), 1u);  // the limit itself is not split
    const References two = make(mesh, absolute(63));
    ASSERT_EQ(two.refs.size(), 2u);
    EXPECT_EQ(two.split_count, 1u);
    EXPECT_EQ(two.refs[0], (PrimRef{{{0, 0, 0}, {4, 4, 0}}, 0}));
    EXPECT_EQ(two.refs[1], (PrimRef{{{4, 0, 0}, {8, 2, 0}}, 0}));
    // sa = 16: the left half, area 32, is cut at x = 2 (of equal extents the first axis): 2 x 4 and 2 x 3.
    const References three = make(mesh, absolute(16));
    ASSERT_EQ(three.refs.size(), 3u);
    EXPECT_EQ(three.refs[0], (PrimRef{{{0, 0, 0}, {2, 4, 0}}, 0}));
    EXPECT_EQ(three.refs[1], (PrimRef{{{2, 0, 0}, {4, 3, 0}}, 0}));
    EXPECT_EQ(three.refs[2], (PrimRef{{{4, 0, 0}, {8, 2, 0}}, 0}));
    // The same limits as fractions of the scene's area of 64.
    EXPECT_EQ(make(mesh, relative(0)).refs.size(), 1u);
    EXPECT_EQ(make(mesh, relative(2)).refs, three.refs);
}

TEST(EarlySplitClipping, MakesFourDisjointBoxesOfEachSlantingTriangleAsInThePapersFigure2) {
    // A slanting strip of two triangles, each the other turned by 180 degrees. The first: its box of area 512
    // is cut at x = 8, the left half (8 x 8, area 128) at x = 4, the right one (8 x 10, area 160) at y = 11,
    // where the edge y = 3/4 x is at x = 44/3. The largest of the four has an area below 67.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {16, 12, 0}, {16, 16, 0}}, {{0, 0, 0}, {16, 16, 0}, {0, 4, 0}}});
    const References references = make(mesh, absolute(100));
    ASSERT_EQ(references.refs.size(), 8u);
    EXPECT_EQ(references.split_count, 2u);
    const float third = std::nextafter(44.0f / 3.0f, 0.0f);  // the nearest float lies above 44/3
    EXPECT_LT(double(third) * 3.0, 44.0);
    EXPECT_EQ(references.refs[0], (PrimRef{{{0, 0, 0}, {4, 4, 0}}, 0}));
    EXPECT_EQ(references.refs[1], (PrimRef{{{4, 3, 0}, {8, 8, 0}}, 0}));
    EXPECT_EQ(references.refs[2], (PrimRef{{{8, 6, 0}, {std::nextafter(third, 16.0f), 11, 0}}, 0}));
    EXPECT_EQ(references.refs[3], (PrimRef{{{11, 11, 0}, {16, 16, 0}}, 0}));
    expect_a_partition(mesh, references.refs);
}

TEST(EarlySplitClipping, BoxesAreDisjointAndCoverTheTriangle) {
    const Mesh mesh = make_mesh(random_triangles(25, -1, 1, 1));
    expect_a_partition(mesh, make(mesh, relative(5)).refs);
    const Mesh far = make_mesh(random_triangles(25, 1e7f - 50, 1e7f + 50, 2));
    expect_a_partition(far, make(far, relative(5)).refs);
}

TEST(EarlySplitClipping, NoBoxExceedsTheLimit) {
    const Mesh mesh = make_mesh(random_triangles(200, -1, 1, 3));
    const double limit = mesh.bounds().surface_area() / 64.0;
    const References references = make(mesh, relative(6));
    EXPECT_GT(references.refs.size(), 2000u);
    for (const PrimRef& ref : references.refs) ASSERT_LE(ref.bounds.surface_area(), limit);
}

TEST(EarlySplitClipping, CoversDenseSamplesOfATriangle) {
    const Mesh mesh = make_mesh(random_triangles(20, -1, 1, 4));
    const References references = make(mesh, relative(7));
    Rng rng(5);
    for (uint32_t prim = 0; prim < 20; ++prim) {
        const Triangle t = mesh.triangle(prim);
        for (int i = 0; i < 200; ++i) {
            double u = double(rng.next()), v = double(rng.next());
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const DVec3 p = DVec3(t.a) + u * (DVec3(t.b) - DVec3(t.a)) + v * (DVec3(t.c) - DVec3(t.a));
            // A sample is off the plane by rounding; the boxes are exact.
            const bool is_covered =
                std::any_of(references.refs.begin(), references.refs.end(), [&](const PrimRef& ref) {
                    return ref.prim == prim &&
                           glm::all(glm::lessThanEqual(DVec3(ref.bounds.lower) - 1e-14, p)) &&
                           glm::all(glm::lessThanEqual(p, DVec3(ref.bounds.upper) + 1e-14));
                });
            ASSERT_TRUE(is_covered);
        }
    }
}

TEST(EarlySplitClipping, EndsAtTheEndsOfFloat) {
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    const Mesh huge = make_mesh({{{-most, -most, -most}, {most, most, most}, {most, -most, 0}}});
    expect_a_partition(huge, make(huge, relative(4)).refs);
    const Mesh tiny =
        make_mesh({{{-0.0f, 0, 0}, {5 * least, 7 * least, 9 * least}, {3 * least, -least, least}}});
    expect_a_partition(tiny, make(tiny, relative(3)).refs);
    // No float between the faces: the limit is out of reach, and the recursion ends all the same.
    EXPECT_LE(make(tiny, relative(40)).refs.size(), 1000u);
    EarlySplitClipping method = absolute(1e-30);
    method.budget = {.per_triangle = 1, .at_least = 500};
    EXPECT_LE(make(huge, method).refs.size(), 500u);
}

TEST(EarlySplitClipping, TightTrianglesAreCountedAndFlatOnesAreSplitByAreaAlone) {
    std::vector<Triangle> triangles = random_triangles(50, -0.01f, 0.01f, 6);
    triangles.push_back({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}});
    Task task;
    const References references = relative(6).make(make_mesh(triangles), task);
    EXPECT_EQ(skipped(task, "tight"), 50u);
    EXPECT_EQ(references.split_count, 1u);
    EXPECT_EQ(references.refs[49].prim, 49u);
}

TEST(EarlySplitClipping, StaysInsideItsBudgetAndSaysSo) {
    const Mesh mesh = make_mesh(random_triangles(3, -1, 1, 7));
    Task task;
    EarlySplitClipping method = absolute(1e-12);
    method.budget = {.per_triangle = 100, .at_least = 0};
    const References references = method.make(mesh, task);
    EXPECT_LE(references.refs.size(), 300u);
    EXPECT_GT(references.refs.size(), 60u);
    EXPECT_EQ(skipped(task, "over the reference budget"), 3u);
}

TEST(EarlySplitClipping, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = make_mesh(random_triangles(3000, -1, 1, 8));
    const Array<PrimRef> many = make(mesh, relative(4)).refs;
    const ThreadLimit limit(1);
    EXPECT_EQ(many, make(mesh, relative(4)).refs);
}

TEST(EarlySplitClipping, AnEmptyMeshHasNoReferences) { EXPECT_TRUE(make(Mesh{}, relative(10)).refs.empty()); }

TEST(AreaLimit, IsRelativeToTheScenesAreaOrAbsolute) {
    EXPECT_EQ((AreaLimit{false, 10.0}).max_area(1024.0), 1.0);
    EXPECT_EQ((AreaLimit{false, 0.0}).max_area(5.0), 5.0);
    EXPECT_EQ((AreaLimit{true, 2.5}).max_area(1024.0), 2.5);
    EXPECT_EQ((AreaLimit{false, 40.0}).max_area(0x1p240), 0x1p200);
}

}  // namespace
}  // namespace boxwood
