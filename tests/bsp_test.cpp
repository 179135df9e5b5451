#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/bsp/bsp_build.h"
#include "core/bsp/bsp_piece.h"
#include "core/bsp/convex_cell.h"
#include "oracle/oracle.h"
#include "oracle/polygon.h"
#include "support/all_recipes.h"
#include "support/lattice.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

using Polygon = std::vector<oracle::ExactPoint>;

BspTree build(const Mesh& mesh, const BspSah& params = {}) {
    Task task;
    return params.build(mesh, whole_refs(mesh), task);
}

Polygon polygon_of(const Triangle& t) {
    return {oracle::exact_point(t.a), oracle::exact_point(t.b), oracle::exact_point(t.c)};
}

/// A plane's function without error.
class ExactPlane {
public:
    explicit ExactPlane(const BspPlane& plane) {
        if (plane.axis >= 0) {
            normal_[static_cast<size_t>(plane.axis)] = 1;
            origin_[static_cast<size_t>(plane.axis)] = mpq_class(double(plane.position));
        } else {
            origin_ = oracle::exact_point(plane.points.a);
            normal_ = oracle::area_vector(polygon_of(plane.points));
        }
    }
    mpq_class at(const oracle::ExactPoint& p) const {
        mpq_class sum = 0;
        for (size_t k = 0; k < 3; ++k) sum += normal_[k] * (p[k] - origin_[k]);
        return sum;
    }
    /// The part of a polygon on one side, -1 or 1.
    Polygon part(const Polygon& polygon, int side) const {
        Polygon kept;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const oracle::ExactPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            const mpq_class h_p = at(p), h_q = at(q);
            if (sgn(h_p) * side >= 0) kept.push_back(p);
            if (sgn(h_p) * sgn(h_q) >= 0) continue;
            oracle::ExactPoint crossing;
            for (size_t k = 0; k < 3; ++k) crossing[k] = p[k] + h_p / (h_p - h_q) * (q[k] - p[k]);
            kept.push_back(crossing);
        }
        return kept;
    }

private:
    oracle::ExactPoint origin_, normal_;
};

TEST(BspPlane, SideIsExact) {
    Rng rng(1);
    size_t in_plane = 0;
    const auto point = [&] {  // on whole numbers in x + y + z = 0, or off another plane by rounding
        if (rng.next_index(2) == 0) {
            const float x = static_cast<float>(rng.next_index(4)), y = static_cast<float>(rng.next_index(4));
            return Vec3(x, y, -x - y);
        }
        const float x = rng.next(-1, 1), y = rng.next(-1, 1);
        return Vec3(x, y, 0.3f * x + 0.7f * y);
    };
    for (int i = 0; i < 4000; ++i) {
        const Vec3 a = point(), b = point(), c = point(), p = point();
        const BspPlane plane = BspPlane::through({a, b, c});
        const int expected = sgn(ExactPlane(plane).at(oracle::exact_point(p)));
        ASSERT_EQ(side_of(plane, PlaneValue(plane), p), expected);
        in_plane += expected == 0;
    }
    EXPECT_GT(in_plane, 100u);
    EXPECT_LT(in_plane, 3000u);
}

/// Twelve coordinates: three points of a plane, and a point or a direction.
using Coordinates = std::array<float, 12>;

/// How much of its error bound h uses up, at a point or along a direction.
double used_bound(const Coordinates& x, bool along) {
    const BspPlane plane = BspPlane::through({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}});
    const Vec3 v(x[9], x[10], x[11]);
    const PlaneValue value(plane);
    const double h = along ? value.along(DVec3(v)) : value.at(DVec3(v));
    const double bound = along ? value.error_along(DVec3(v)) : value.error_at(DVec3(v));
    mpq_class exact = ExactPlane(plane).at(oracle::exact_point(v));
    if (along) exact -= ExactPlane(plane).at(oracle::exact_point(Vec3(0)));
    const mpq_class error = abs(mpq_class(h) - exact);
    return bound > 0.0 ? error.get_d() / bound : sgn(error) == 0 ? 0.0 : 2.0;
}

TEST(BspPlane, ErrorStaysWithinItsBoundAndHalfOfThatWouldNotDo) {
    // Climbs towards the largest error from coordinates that round much: just above a power of two, some of
    // them so small that differences lose their last bits.
    Rng rng(12);
    const auto coordinate = [&] {
        const float size = 1.0f + 0.03f * rng.next(), sign = rng.next() < 0.5f ? -1.0f : 1.0f;
        const int exponent = rng.next() < 0.5f ? 0 : -24 - static_cast<int>(rng.next_index(20));
        return std::ldexp(size * sign, exponent);
    };
    for (const bool along : {false, true}) {
        double largest = 0.0;
        for (int start = 0; start < 8; ++start) {
            Coordinates x;
            for (float& value : x) value = coordinate();
            double used = used_bound(x, along);
            for (int step = 0; step < 1200; ++step) {
                Coordinates changed = x;
                const size_t place = rng.next_index(12);
                const bool is_small_step = rng.next() < 0.5f;
                const float factor = 1.0f + rng.next(-1e-3f, 1e-3f);
                changed[place] = is_small_step ? changed[place] * factor : coordinate();
                const double other = used_bound(changed, along);
                ASSERT_LE(other, 1.0);
                if (other < used) continue;
                used = other;
                x = changed;
            }
            largest = std::max(largest, used);
        }
        EXPECT_GT(largest, 0.5) << (along ? "along a direction" : "at a point");
    }
}

TEST(BspPlane, OnAnEdgeHoldsItsEndsAndIsPerpendicular) {
    Rng rng(2);
    for (int i = 0; i < 500; ++i) {
        const float scale = std::ldexp(1.0f, static_cast<int>(rng.next_index(180)) - 90);
        const Vec3 a = scale * random_point(rng, 1.0f), b = scale * random_point(rng, 1.0f),
                   c = scale * random_point(rng, 1.0f);
        const std::optional<BspPlane> plane = plane_on_edge(a, b, c);
        ASSERT_TRUE(plane.has_value());
        const PlaneValue value(*plane);
        EXPECT_EQ(side_of(*plane, value, a), 0);
        EXPECT_EQ(side_of(*plane, value, b), 0);
        EXPECT_NE(side_of(*plane, value, c), 0);
        const DVec3 n = glm::normalize(value.normal() / glm::length(value.normal()));
        const DVec3 e = (DVec3(b) - DVec3(a)) / double(scale), f = (DVec3(c) - DVec3(a)) / double(scale);
        EXPECT_LT(std::abs(glm::dot(n, glm::normalize(glm::cross(e, f)))), 1e-4);
    }
    EXPECT_FALSE(plane_on_edge(Vec3(0), Vec3(1), Vec3(2)).has_value());
}

bool contains(const Box& box, const oracle::ExactPoint& p) {
    for (int axis = 0; axis < 3; ++axis) {
        const mpq_class& x = p[static_cast<size_t>(axis)];
        if (x < mpq_class(double(box.lower[axis])) || x > mpq_class(double(box.upper[axis]))) return false;
    }
    return true;
}

/// In exact arithmetic: no leaf holds a triangle that does not reach its cell, the parts of a triangle in the
/// leaves that hold it sum to all of it, and each lies in the leaf's box.
void expect_exact_references(const BspTree& tree, const Mesh& mesh) {
    struct Visit {
        uint32_t node;
        Polygon part;
    };
    const NodeList list = tree.list_nodes();
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        oracle::ExactPoint sum;
        std::vector<Visit> stack{{0, polygon_of(mesh.triangle(prim))}};
        while (!stack.empty()) {
            const Visit visit = std::move(stack.back());
            stack.pop_back();
            const BspTree::Node& node = tree.nodes[visit.node];
            if (!node.is_leaf()) {
                const ExactPlane plane(tree.plane_of(node));
                stack.push_back({visit.node + 1, plane.part(visit.part, -1)});
                stack.push_back({node.right(), plane.part(visit.part, 1)});
                continue;
            }
            const auto begin = tree.prims.begin() + node.first(), end = begin + node.count();
            if (std::find(begin, end, prim) == end) continue;
            ASSERT_FALSE(visit.part.empty()) << "superfluous: primitive " << prim;
            for (const oracle::ExactPoint& corner : visit.part)
                ASSERT_TRUE(contains(list.nodes[visit.node].bounds, corner));
            const oracle::ExactPoint area = oracle::area_vector(visit.part);
            for (size_t k = 0; k < 3; ++k) sum[k] += area[k];
        }
        ASSERT_EQ(sum, oracle::area_vector(polygon_of(mesh.triangle(prim)))) << "missed: primitive " << prim;
    }
}

TEST(Bsp, LeavesHoldTheTrianglesThatReachThemAndMissNone) {
    Mesh far = random_triangles(40, 0.3f, 4);
    for (Vec3& position : far.positions) position += Vec3(1e6f, -1e6f, 1e5f);
    for (const Mesh& mesh : {random_triangles(50, 0.5f, 3), lattice_mesh(40, 4), far})
        for (const int planes : {0, 1, 2})
            expect_exact_references(build(mesh, {.planes = planes, .traversal_cost = 0.1f, .leaf_size = 1}),
                                    mesh);
}

TEST(Bsp, FindsTheSameHitsAsBruteForceThroughWallsEdgesAndCornersOfCells) {
    Task task;
    const Mesh mesh = lattice_mesh(150, 5);
    const std::vector<Ray> rays = lattice_rays(1500, 6);
    const Structure reference = run("none", mesh).structure;
    for (const char* recipe :
         {"bsp(traversal-cost=0, leaf-size=1)", "bsp(planes=triangles, traversal-cost=0)"}) {
        const Structure structure = run(recipe, mesh).structure;
        ASSERT_GT(structure.list_nodes().nodes.size(), 20u);
        for (const Mode mode : {Mode::Exact, Mode::Fast}) {
            std::vector<Hit> hits(rays.size()), expected(rays.size());
            structure.closest_hits(mesh, rays, hits, mode, task);
            reference.closest_hits(mesh, rays, expected, mode, task);
            for (size_t i = 0; i < rays.size(); ++i)
                ASSERT_EQ(hits[i], expected[i]) << recipe << " ray " << i;
        }
    }
}

TEST(BspPiece, ATriangleInThePlaneHasNoSideAndOneThatTouchesHasOne) {
    const BspPlane plane = BspPlane::through({{0, 0, 0}, {1, 0, 1}, {0, 1, 0}});  // x = z, left where x < z
    const PlaneValue value(plane);
    const auto sides = [&](const Triangle& t) { return sides_of(plane, value, t, {}); };
    EXPECT_TRUE(sides({{2, 5, 2}, {3, 1, 3}, {4, 4, 4}}).is_in_plane());
    const BspSides touching = sides({{2, 5, 2}, {3, 1, 3}, {4, 4, 5}}),
                   other = sides({{2, 5, 2}, {3, 1, 3}, {4, 4, 3}});
    EXPECT_NE(touching.left, touching.right);
    EXPECT_EQ(touching.left, other.right);
    const BspSides both = sides({{2, 5, 2}, {3, 1, 4}, {4, 4, 3}});
    EXPECT_TRUE(both.left && both.right);
    // The triangle is on both sides, its part in the cell on one.
    const std::vector<DVec3> part = {{2, 5, 2.5}, {3, 1, 4}, {3, 3, 3.5}};
    const BspSides cut = sides_of(plane, value, {{2, 5, 2}, {3, 1, 4}, {4, 4, 3}}, part);
    EXPECT_NE(cut.left, cut.right);
}

TEST(BspPiece, NoSideIsLostWhereACornerOfAPieceIsWithinRoundingOfThePlane) {
    // Edge ab crosses y = 0 close to the origin, where floats are finer than the roundings of the crossing;
    // the second plane is the float next to it, so that the exact part beyond it may be narrower than these.
    Rng rng(11);
    size_t narrow = 0;
    for (int i = 0; i < 1500; ++i) {
        const float ax = rng.next(1.0f, 2.0f), ay = rng.next(1.0f, 2.0f), bend = rng.next(-1e-6f, 1e-6f);
        const Triangle triangle{{-ax, -ay, rng.next()}, {ax + bend, ay, rng.next()}, {-ax, ay, 0.0f}};
        const BspPlane first = BspPlane::across(1, 0.0f);
        const PlaneValue first_value(first);
        std::vector<DVec3> part;
        const int side = i % 2 == 0 ? -1 : 1;
        cut_piece(first_value, triangle,
                  std::vector<DVec3>{DVec3(triangle.a), DVec3(triangle.b), DVec3(triangle.c)}, side, part);
        const Polygon exact_part = ExactPlane(first).part(polygon_of(triangle), side);
        // The crossing is the corner with y = 0 that has the larger x.
        mpq_class crossing = -10;
        for (const oracle::ExactPoint& p : exact_part)
            if (sgn(p[1]) == 0 && p[0] > crossing) crossing = p[0];
        const float nearest = oracle::round_to_float(crossing);
        for (const float position :
             {nearest, std::nextafter(nearest, -1.0f), std::nextafter(nearest, 1.0f)}) {
            const BspPlane second = BspPlane::across(0, position);
            const BspSides sides = sides_of(second, PlaneValue(second), triangle, part);
            for (const int second_side : {-1, 1}) {
                const Polygon beyond = ExactPlane(second).part(exact_part, second_side);
                const oracle::ExactPoint area = oracle::area_vector(beyond);
                if (sgn(area[0]) == 0 && sgn(area[1]) == 0 && sgn(area[2]) == 0) continue;
                ASSERT_TRUE(second_side < 0 ? sides.left : sides.right);
                narrow += abs(mpq_class(double(position)) - crossing) < mpq_class(0x1p-54);
            }
        }
    }
    EXPECT_GT(narrow, 500u);
}

TEST(ConvexCell, ACubeCutDiagonallyAsComputedByHand) {
    const ConvexCell cube(Box{{0, 0, 0}, {1, 1, 1}});
    EXPECT_DOUBLE_EQ(cube.half_area(), 3.0);
    EXPECT_DOUBLE_EQ(cube.volume(), 1.0);
    // The plane x + y = 1 leaves two prisms: two halves of squares, two squares, and the cut of area sqrt 2.
    const PlaneValue diagonal(BspPlane::through({{1, 0, 0}, {0, 1, 0}, {0, 1, 1}}));
    const double expected = 0.5 * (3.0 + std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(cube.cut_areas(diagonal).left, expected);
    EXPECT_DOUBLE_EQ(cube.cut_areas(diagonal).right, expected);
    const auto [left, right] = cube.cut(diagonal);
    for (const ConvexCell& half : {left, right}) {
        EXPECT_EQ(half.faces().size(), 5u);
        EXPECT_DOUBLE_EQ(half.volume(), 0.5);
        EXPECT_DOUBLE_EQ(half.half_area(), expected);
    }
    // The corner beyond x + y + z = 1: a sixth of the cube.
    const PlaneValue corner(BspPlane::through({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    const auto [small, large] = cube.cut(corner);
    EXPECT_DOUBLE_EQ(std::min(small.volume(), large.volume()), 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(std::max(small.volume(), large.volume()), 5.0 / 6.0);
    // Planes that only touch it cut nothing.
    EXPECT_EQ(cube.cut_areas(PlaneValue(BspPlane::across(0, 1.0f))).left, 0.0);
    EXPECT_EQ(cube.cut_areas(PlaneValue(BspPlane::through({{2, 0, 0}, {1, 1, 0}, {1, 1, 1}}))).left, 0.0);
}

/// Every corner is on the inner side of every face, and the corners, edges and faces satisfy Euler's formula.
void expect_convex(const ConvexCell& cell, double extent) {
    const auto less = [](const DVec3& a, const DVec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::map<DVec3, int, decltype(less)> corners(less);
    size_t edge_count = 0;
    for (const ConvexCell::Polygon& face : cell.faces()) {
        edge_count += face.size();
        DVec3 normal(0.0);
        for (size_t i = 2; i < face.size(); ++i)
            normal += glm::cross(face[i - 1] - face[0], face[i] - face[0]);
        for (const DVec3& corner : face) corners[corner] = 1;
        if (glm::length(normal) < 1e-9 * extent * extent) continue;  // a sliver has no direction
        for (const ConvexCell::Polygon& other : cell.faces())
            for (const DVec3& corner : other)
                ASSERT_LT(glm::dot(glm::normalize(normal), corner - face[0]), 1e-6 * extent);
    }
    ASSERT_EQ(corners.size() + cell.faces().size(), edge_count / 2 + 2);
}

TEST(Bsp, CellsAreConvexAndFillTheRootsBox) {
    for (const Mesh& mesh : {random_triangles(300, 0.3f, 7), lattice_mesh(60, 8)}) {
        const BspTree tree = build(mesh, {.traversal_cost = 0.2f, .leaf_size = 1});
        ASSERT_GT(tree.planes.size(), 10u);
        const double extent = glm::length(tree.bounds.extent());
        std::vector<ConvexCell> cells(tree.nodes.size());
        cells[0] = ConvexCell(tree.bounds);
        double volume = 0.0;
        for (uint32_t i = 0; i < tree.nodes.size(); ++i) {
            const BspTree::Node& node = tree.nodes[i];
            expect_convex(cells[i], extent);
            if (node.is_leaf()) {
                volume += cells[i].volume();
            } else {
                std::tie(cells[i + 1], cells[node.right()]) = cells[i].cut(PlaneValue(tree.plane_of(node)));
            }
        }
        EXPECT_NEAR(volume, tree.bounds.volume(), 1e-9 * tree.bounds.volume());
    }
}

TEST(Bsp, OutlinesAreTheEdgesOfTheCells) {
    const Mesh mesh = random_triangles(100, 0.3f, 9);
    const NodeList list = build(mesh).list_nodes();
    std::vector<size_t> edge_count(list.nodes.size(), 0);
    for (const OutlineSegment& segment : list.outlines) {
        ++edge_count[segment.node];
        Box box;
        box.extend(segment.from);
        box.extend(segment.to);
        ASSERT_TRUE(list.nodes[segment.node].bounds.contains(box));
    }
    EXPECT_EQ(edge_count[0], 12u);
    for (const size_t count : edge_count) ASSERT_GE(count, 6u);
}

TEST(Bsp, OneTriangleBehindAnotherIsDividedByItsPlane) {
    // Slanting walls one behind the other: no axis plane parts them, the plane of one does, itself on the
    // side that is smaller.
    const Mesh mesh = make_mesh({{{0, 0, 0}, {8, 8, 0}, {8, 8, 8}}, {{1, 0, 0}, {9, 8, 0}, {9, 8, 8}}});
    const BspTree tree = build(mesh, {.planes = 1, .traversal_cost = 0.0f, .leaf_size = 1});
    ASSERT_EQ(tree.nodes.size() % 2, 1u);
    ASSERT_GE(tree.nodes.size(), 3u);
    for (const BspTree::Node& node : tree.nodes) EXPECT_TRUE(!node.is_leaf() || node.count() <= 1);
    EXPECT_EQ(tree.prims.size(), 2u);
}

TEST(Bsp, KeepsToItsLimitsAndItsSeed) {
    const Mesh mesh = random_triangles(200, 1.0f, 10);
    const BspTree free = build(mesh, {.traversal_cost = 0.0f, .leaf_size = 1, .max_depth = 64, .budget = 64});
    EXPECT_GT(free.prims.size(), 600u);
    EXPECT_LE(
        build(mesh, {.traversal_cost = 0.0f, .leaf_size = 1, .max_depth = 64, .budget = 2}).prims.size(),
        400u);
    EXPECT_EQ(make_level_table(build(mesh, {.max_depth = 3}).list_nodes()).level_count(), 4u);
    EXPECT_EQ(build(mesh).nodes, build(mesh).nodes);
    EXPECT_NE(build(mesh).nodes, build(mesh, {.seed = 2}).nodes);
}

}  // namespace
}  // namespace boxwood
