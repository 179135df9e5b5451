#include "core/refs/edge_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/refs/subdivision.h"
#include "core/refs/whole_boxes.h"
#include "core/scene/load_file.h"
#include "oracle/polygon.h"
#include "support/skipped.h"
#include "support/triangle_soup.h"

namespace boxwood {
namespace {

using oracle::exact_point;
using oracle::ExactPoint;

References make(const Mesh& mesh, int t) {
    Task task;
    EdgeVolume method;
    method.t = t;
    return method.make(mesh, task);
}

/// The rule in exact arithmetic: V / 2^t, the largest edge, the middle, recursion. Counts pieces and hands
/// each piece's corners to `visit`.
using ExactTriangle = std::array<ExactPoint, 3>;
mpq_class exact_volume(const ExactPoint& a, const ExactPoint& b) {
    mpq_class volume = 1;
    for (size_t k = 0; k < 3; ++k) volume *= abs(mpq_class(a[k] - b[k]));
    return volume;
}
template <class Visit>
void subdivide_exactly(const ExactTriangle& t, const mpq_class& threshold, const Visit& visit) {
    size_t largest = 0;
    for (size_t i = 1; i < 3; ++i)
        if (exact_volume(t[i], t[(i + 1) % 3]) > exact_volume(t[largest], t[(largest + 1) % 3])) largest = i;
    const ExactPoint &a = t[largest], &b = t[(largest + 1) % 3], &c = t[(largest + 2) % 3];
    if (exact_volume(a, b) <= threshold) return visit(t);
    ExactPoint middle;
    for (size_t k = 0; k < 3; ++k) middle[k] = (a[k] + b[k]) / 2;
    subdivide_exactly({a, middle, c}, threshold, visit);
    subdivide_exactly({middle, b, c}, threshold, visit);
}

mpq_class exact_threshold(const Mesh& mesh, int t) {
    const Box box = mesh.bounds();
    mpq_class volume = exact_volume(exact_point(box.lower), exact_point(box.upper));
    for (int i = 0; i < t; ++i) volume /= 2;
    return volume;
}

ExactTriangle exact_triangle(const Triangle& t) {
    return {exact_point(t.a), exact_point(t.b), exact_point(t.c)};
}

/// Every exact piece of every triangle lies in a box of its own triangle, so that their union contains it;
/// and no box reaches beyond the triangle's. Returns the largest number of pieces of one triangle.
void expect_boxes_contain_pieces(const Mesh& mesh, int t) {
    const References references = make(mesh, t);
    const mpq_class threshold = exact_threshold(mesh, t);
    size_t next = 0;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const size_t first = next;
        while (next < references.refs.size() && references.refs[next].prim == prim) ++next;
        size_t piece_count = 0;
        subdivide_exactly(exact_triangle(mesh.triangle(prim)), threshold, [&](const ExactTriangle& piece) {
            ++piece_count;
            bool is_inside_one = false;
            for (size_t r = first; r < next && !is_inside_one; ++r) {
                const Box& box = references.refs[r].bounds;
                is_inside_one = true;
                for (const ExactPoint& p : piece)
                    for (int k = 0; k < 3; ++k)
                        is_inside_one = is_inside_one && p[static_cast<size_t>(k)] >= double(box.lower[k]) &&
                                        p[static_cast<size_t>(k)] <= double(box.upper[k]);
            }
            ASSERT_TRUE(is_inside_one) << "primitive " << prim;
        });
        ASSERT_EQ(next - first, piece_count) << "primitive " << prim;
        for (size_t r = first; r < next; ++r)
            ASSERT_TRUE(mesh.triangle(prim).bounds().contains(references.refs[r].bounds));
    }
    ASSERT_EQ(next, references.refs.size());
}

TEST(EdgeVolume, SplitsAsComputedByHand) {
    // Scene box 8 x 8 x 8, V = 512. The edges' volumes: ab 512, bc 8 * 8 * 0 = 0, ca 0.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 8, 8}, {8, 0, 0}}});
    EXPECT_EQ(edge_volume(mesh.triangle(0)), 512.0);
    EXPECT_EQ(edge_volume_threshold(mesh.bounds(), 0), 512.0);
    EXPECT_EQ(edge_volume_threshold(mesh.bounds(), 14), 0.03125);
    // t = 0: 512 is not above 512.
    EXPECT_EQ(make(mesh, 0).refs.size(), 1u);
    // t = 1: threshold 256. One cut at (4, 4, 4); its median to (8, 0, 0) has volume 64, as have the halves.
    const References one = make(mesh, 1);
    ASSERT_EQ(one.refs.size(), 2u);
    EXPECT_EQ(one.split_count, 1u);
    EXPECT_EQ(one.refs[0], (PrimRef{{{0, 0, 0}, {8, 4, 4}}, 0}));
    EXPECT_EQ(one.refs[1], (PrimRef{{{4, 0, 0}, {8, 8, 8}}, 0}));
    // t = 3: threshold 64, and 64 is not above it. t = 4, threshold 32: the half at a is cut at (2, 2, 2),
    // then its upper piece in the median of 64: 3 pieces. The half at b is cut at (6, 6, 6); the new median
    // to (8, 0, 0) has 2 * 6 * 6 = 72 and is cut from both sides, then once more the first median: 5 pieces.
    EXPECT_EQ(make(mesh, 3).refs.size(), 2u);
    EXPECT_EQ(make(mesh, 4).refs.size(), 8u);
}

TEST(EdgeVolume, CountsWhatTheNaiveRecursionCountsAndCoversItsPieces) {
    expect_boxes_contain_pieces(make_mesh(random_triangles(30, -1, 1, 1)), 10);
    expect_boxes_contain_pieces(make_mesh(random_triangles(100, -1, 1, 2)), 5);
    expect_boxes_contain_pieces(make_mesh({{{0, 0, 0}, {8, 8, 8}, {8, 0, 0}}}), 4);
}

TEST(EdgeVolume, CoversTrianglesFarFromTheOrigin) {
    expect_boxes_contain_pieces(make_mesh(random_triangles(50, 1e7f - 50, 1e7f + 50, 3)), 8);
}

TEST(EdgeVolume, CoversTrianglesWhoseCoordinatesHaveEveryMagnitude) {
    Rng rng(4);
    std::vector<Triangle> triangles = random_triangles(60, -1, 1, 5);
    for (Triangle& t : triangles)
        for (Vec3* p : {&t.a, &t.b, &t.c}) {
            const int axis = static_cast<int>(rng.next_index(3));
            (*p)[axis] = std::ldexp((*p)[axis], -static_cast<int>(rng.next_index(120)));
        }
    expect_boxes_contain_pieces(make_mesh(triangles), 8);
}

TEST(EdgeVolume, EndsAndStaysFiniteAtTheEndsOfFloat) {
    const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
    expect_boxes_contain_pieces(make_mesh({{{-most, -most, -most}, {most, most, most}, {most, -most, 0}}}),
                                8);
    expect_boxes_contain_pieces(
        make_mesh({{{-0.0f, 0, 0}, {5 * least, 7 * least, 9 * least}, {3 * least, -least, least}}}), 8);
    expect_boxes_contain_pieces(make_mesh({{{-most, 0, 0}, {most, least, 1}, {0, least, 0}}}), 5);
}

TEST(EdgeVolume, CutsATriangleOfTheLeastExtentFarFromTheOriginAsItDoesAtTheOrigin) {
    // At 2^25 floats are 4 apart: all middles lie between two of them, and none is lost.
    const float base = 33554432.0f;
    const Mesh near = make_mesh({{{0, 0, 0}, {4, 4, 4}, {4, 0, 0}}});
    const Mesh far =
        make_mesh({{{base, base, base}, {base + 4, base + 4, base + 4}, {base + 4, base, base}}});
    const References references = make(far, 18);
    EXPECT_EQ(references.refs.size(), make(near, 18).refs.size());
    for (const PrimRef& ref : references.refs) ASSERT_TRUE(far.bounds().contains(ref.bounds));
}

TEST(EdgeVolume, ASharedEdgeIsCutAtTheSameBitsFromBothSides) {
    // Two triangles at edge ab, in opposite order; of each only ab has a volume. One cut: its middle is a
    // face of the lower piece of one triangle and of the upper piece of the other.
    Rng rng(6);
    for (int i = 0; i < 200; ++i) {
        const Vec3 a = random_point(rng, 0, 1), b = a + random_point(rng, 1, 2);
        const Mesh mesh = make_mesh({{a, b, {b.x, a.y, a.z}}, {b, a, {a.x, b.y, b.z}}});
        const References references = make(mesh, 2);
        ASSERT_EQ(references.refs.size(), 4u);
        for (int axis = 1; axis < 3; ++axis) {
            float below = -1.0f, above = -1.0f;  // the floats around the middle, or twice the middle itself
            for (const PrimRef& ref : references.refs) {
                const Box& box = ref.bounds;
                if (ref.prim == 0 && box.upper[axis] != b[axis]) above = box.upper[axis];
                if (ref.prim == 1 && box.lower[axis] != a[axis]) below = box.lower[axis];
            }
            const double middle = 0.5 * (double(a[axis]) + double(b[axis]));  // exact: exponents are alike
            ASSERT_LE(double(below), middle);
            ASSERT_GE(double(above), middle);
            ASSERT_TRUE(above == below || above == std::nextafter(below, 9.0f));
            ASSERT_EQ(above == below, double(below) == middle);
        }
    }
}

TEST(EdgeVolume, TheOrderOfCornersDoesNotChangeTheBoxes) {
    const auto boxes_of = [](const Triangle& triangle) {
        const References references = make(make_mesh({triangle}), 9);
        std::vector<std::array<float, 6>> boxes;
        for (const PrimRef& ref : references.refs) {
            const Box& b = ref.bounds;
            boxes.push_back({b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z});
        }
        std::sort(boxes.begin(), boxes.end());
        return boxes;
    };
    for (const Triangle& t : random_triangles(50, -1, 1, 7)) {
        EXPECT_EQ(boxes_of(t), boxes_of({t.b, t.c, t.a}));
        EXPECT_EQ(boxes_of(t), boxes_of({t.b, t.a, t.c}));
    }
}

TEST(EdgeVolume, AFlatSceneIsNotSplit) {
    std::vector<Triangle> triangles = random_triangles(20, -1, 1, 8);
    for (Triangle& t : triangles) t.a.y = t.b.y = t.c.y = 3.0f;
    Task task;
    const References references = EdgeVolume{40}.make(make_mesh(triangles), task);
    EXPECT_EQ(references.refs.size(), 20u);
    EXPECT_EQ(skipped(task, "tight"), 20u);
}

TEST(EdgeVolume, AnEmptyMeshHasNoReferences) { EXPECT_TRUE(make(Mesh{}, 14).refs.empty()); }

TEST(EdgeVolume, TightTrianglesAreWholeBoxesAndCounted) {
    std::vector<Triangle> triangles = random_triangles(300, -0.01f, 0.01f, 9);
    triangles.push_back({{-1, -1, -1}, {1, 1, 1}, {1, 1, 0.9f}});  // a long diagonal one
    const Mesh mesh = make_mesh(triangles);
    Task task, whole_task;
    const References references = EdgeVolume{}.make(mesh, task);
    const References whole = WholeBoxes{}.make(mesh, whole_task);
    EXPECT_EQ(references.split_count, 1u);
    EXPECT_EQ(skipped(task, "tight"), 300u);
    ASSERT_GT(references.refs.size(), 400u);
    for (size_t i = 0; i < 300; ++i) EXPECT_EQ(references.refs[i], whole.refs[i]);
    const std::vector<uint8_t> flags = split_flags(references.refs, mesh.triangle_count());
    EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 1);
    EXPECT_EQ(flags[300], 1);
}

TEST(EdgeVolume, StaysInsideItsBudgetAndSaysSo) {
    const Mesh mesh = make_mesh(random_triangles(200, -1, 1, 10));
    Task task;
    const References references = EdgeVolume{40, {.per_triangle = 8, .at_least = 0}}.make(mesh, task);
    EXPECT_GT(references.refs.size(), 400u);
    EXPECT_LE(references.refs.size(), 1600u);
    EXPECT_EQ(skipped(task, "tight") + skipped(task, "over the reference budget"), 200u);
    EXPECT_GT(skipped(task, "over the reference budget"), 190u);
    // The threshold was doubled no more often than it took.
    const auto fits = [&](int t) { return make(mesh, t).refs.size() <= 1600; };
    int t = 0;
    while (fits(t + 1)) ++t;
    EXPECT_EQ(references.refs, make(mesh, t).refs);
    uint32_t last = 0;
    for (const PrimRef& ref : references.refs) {
        ASSERT_TRUE(ref.prim == last || ref.prim == last + 1);
        last = ref.prim;
    }
    EXPECT_EQ(last, 199u);
}

TEST(EdgeVolume, AddsNothingToTheBunny) {
    const std::filesystem::path file = std::filesystem::path(BOXWOOD_SHARED_DIR) / "scenes" / "bunny.obj";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no real scenes beside the source folder";
    Task load_task, task;
    const Scene bunny = load_file(file.string(), load_task);
    const References references = EdgeVolume{}.make(bunny.mesh, task);
    EXPECT_EQ(references.refs.size(), 69'451u);
    EXPECT_EQ(skipped(task, "tight"), 69'451u);
}

TEST(EdgeVolume, IsTheSameForAnyNumberOfThreads) {
    const Mesh mesh = make_mesh(random_triangles(3000, -1, 1, 11));
    const Array<PrimRef> many = make(mesh, 7).refs;
    const ThreadLimit limit(1);
    EXPECT_EQ(many, make(mesh, 7).refs);
}

TEST(EdgeVolume, AStopEndsIt) {
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    EXPECT_TRUE(EdgeVolume{30}.make(make_mesh(random_triangles(10, -1, 1, 12)), task).refs.empty());
}

TEST(EdgeVolume, BoundOfMiddlesHoldsAndHalfOfItDoesNot) {
    // (depth - 1/2) u M, as derived in edge_volume.cpp. One axis is enough: middles of random edges.
    Rng rng(9);
    double largest_ratio = 0.0;
    for (int i = 0; i < 20000; ++i) {
        std::array<double, 3> corners;
        std::array<mpq_class, 3> exact;
        double most = 0.0;
        for (size_t k = 0; k < 3; ++k) {
            const float mantissa = rng.next(1.0f, 2.0f);
            const float sign = rng.next() < 0.25f ? -1.0f : 1.0f;
            corners[k] = double(std::ldexp(sign * mantissa, -static_cast<int>(rng.next_index(3)) * 16));
            exact[k] = corners[k];
            most = std::max(most, std::abs(corners[k]));
        }
        for (int depth = 1; depth <= 6; ++depth) {
            const size_t a = rng.next_index(3), b = (a + 1) % 3;
            const size_t replaced = rng.next() < 0.5f ? a : b;
            corners[replaced] = (corners[a] + corners[b]) * 0.5;
            exact[replaced] = (exact[a] + exact[b]) / 2;
            const mpq_class error = abs(mpq_class(exact[replaced] - corners[replaced]));
            largest_ratio = std::max(largest_ratio, error.get_d() / ((depth - 0.5) * 0x1p-53 * most));
        }
    }
    EXPECT_LE(largest_ratio, 1.0);
    EXPECT_GT(largest_ratio, 0.5);
}

}  // namespace
}  // namespace boxwood
