#include "core/volume_bvh/volume_bvh.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>

#include "core/base/rng.h"
#include "core/volume_bvh/bounding_volumes.h"
#include "core/volume_bvh/node_content.h"
#include "oracle/polygon.h"
#include "support/all_recipes.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

using Exact = std::array<mpq_class, 3>;

Exact exact(const Vec3& v) { return oracle::exact_point(v); }
mpq_class dot(const Exact& a, const Exact& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact operator-(const Exact& a, const Exact& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct HalfUnit : VolumeBounds {
    static constexpr double kUnit = 0.5 * VolumeBounds::kUnit;
    static constexpr double kQuotientPad = 0.5 * VolumeBounds::kQuotientPad;
};
/// Above 1 the next double is 1 + 2u: there this is no pad.
struct SmallQuotientPad : VolumeBounds {
    static constexpr double kQuotientPad = 0.9 * VolumeBounds::kUnit;
};
/// Half of it is 1 + 3u, which is no double: the next two below the bound are 1 + 4u and 1 + 2u.
struct HalfPad : VolumeBounds {
    static constexpr double kDistancePad = 1.0 + 2.0 * 0x1p-53;
};

float sign(Rng& rng) { return rng.next() < 0.5f ? -1.0f : 1.0f; }
/// Just above 1: there half an ulp is the largest fraction.
float one(Rng& rng) { return 1.0f + 0.03f * rng.next(); }
float tiny(Rng& rng) {
    const float value = one(rng) * sign(rng);
    return std::ldexp(value, -24 - static_cast<int>(rng.next_index(12)));
}
Vec3 vector_of(Rng& rng, float (*x)(Rng&), float (*y)(Rng&), float (*z)(Rng&)) {
    const float vx = x(rng) * sign(rng), vy = y(rng) * sign(rng), vz = z(rng) * sign(rng);
    return {vx, vy, vz};
}

/// The smallest double whose square is at least a rational.
double root_above(const mpq_class& square) {
    double root = std::sqrt(square.get_d());
    while (mpq_class(root) * root < square) root = std::nextafter(root, 1e300);
    while (root > 0.0 && mpq_class(std::nextafter(root, 0.0)) * std::nextafter(root, 0.0) >= square)
        root = std::nextafter(root, 0.0);
    return root;
}

/// Square of the distance of a point from the ray's line, exactly.
mpq_class squared_distance(const Ray& ray, const Vec3& point) {
    const Exact l = exact(point) - exact(ray.origin), d = exact(ray.direction);
    const mpq_class along = dot(l, d);
    return dot(l, l) - along * along / dot(d, d);
}

/// Spheres that a ray touches in one point, or all but, and that are reported as missed.
template <class Bounds>
int missed_tangents(int case_count) {
    Rng rng(1);
    int missed = 0;
    for (int i = 0; i < case_count; ++i) {
        Ray ray;
        ray.origin = vector_of(rng, one, one, tiny);
        const Vec3 center = vector_of(rng, tiny, tiny, tiny);
        ray.direction = center - ray.origin;
        ray.direction.x += 1e-3f * rng.next();
        const Sphere sphere{center, root_above(squared_distance(ray, center))};
        double near, far;
        missed += !typename Sphere::Test<Bounds>(ray, 0.0).meets(sphere, near, far);
    }
    return missed;
}

TEST(Sphere, TangentsMeetItAndWithHalfTheBoundSomeDoNot) {
    EXPECT_EQ(missed_tangents<VolumeBounds>(3000), 0);
    EXPECT_GT(missed_tangents<HalfUnit>(3000), 0);
}

/// Points of spheres on rays whose parameter is outside the interval: the ray ends at an exact point of the
/// sphere, t = 1.
template <class Bounds>
int points_outside_the_interval(int case_count) {
    Rng rng(2);
    int outside = 0;
    for (int i = 0; i < case_count; ++i) {
        Ray ray;
        const Vec3 center = vector_of(rng, one, tiny, one);
        const Vec3 point =
            center + std::ldexp(1.0f, -static_cast<int>(rng.next_index(30))) * random_point(rng, 1.0f);
        ray.direction = vector_of(rng, one, one, tiny);
        ray.origin = point - ray.direction;
        const Exact end = {mpq_class(ray.origin.x) + mpq_class(ray.direction.x),
                           mpq_class(ray.origin.y) + mpq_class(ray.direction.y),
                           mpq_class(ray.origin.z) + mpq_class(ray.direction.z)};
        const Exact v = end - exact(center);
        const Sphere sphere{center, root_above(dot(v, v))};
        double near, far;
        const bool is_met = typename Sphere::Test<Bounds>(ray, 0.0).meets(sphere, near, far);
        outside += !(is_met && near <= 1.0 && 1.0 <= far);
    }
    return outside;
}

TEST(Sphere, ThePointsOfTheRayInsideAreInItsInterval) {
    EXPECT_EQ(points_outside_the_interval<VolumeBounds>(3000), 0);
}

TEST(Sphere, LengthsAreRoundedUpAndWithHalfTheBoundSomeAreNot) {
    const auto too_short = []<class Bounds>(Bounds, int case_count) {
        Rng rng(3);
        int count = 0;
        for (int i = 0; i < case_count; ++i) {
            const Vec3 a = vector_of(rng, one, tiny, tiny), b = vector_of(rng, tiny, tiny, tiny);
            const double length = length_above<Bounds>(DVec3(a) - DVec3(b));
            const Exact v = exact(a) - exact(b);
            count += mpq_class(length) * length < dot(v, v);
        }
        return count;
    };
    EXPECT_EQ(too_short(VolumeBounds{}, 5000), 0);
    EXPECT_GT(too_short(HalfPad{}, 5000), 0);
}

TEST(Sphere, HitsAndMissesAsComputedByHand) {
    const Sphere sphere{Vec3(3, 0, 0), 2.0};
    double near, far;
    const auto meets = [&](const Vec3& origin, const Vec3& direction, double margin = 0.0) {
        return Sphere::Test<VolumeBounds>({.origin = origin, .direction = direction}, margin)
            .meets(sphere, near, far);
    };
    ASSERT_TRUE(meets(Vec3(0), Vec3(1, 0, 0)));
    EXPECT_NEAR(near, 1.0, 1e-14);
    EXPECT_NEAR(far, 5.0, 1e-14);
    ASSERT_TRUE(meets(Vec3(0, 1.2f, 0), Vec3(2, 0, 0)));  // 1.6 beside the middle, at twice the speed
    EXPECT_NEAR(near, 0.7, 1e-7);
    EXPECT_NEAR(far, 2.3, 1e-7);
    EXPECT_TRUE(meets(Vec3(0, 2, 0), Vec3(1, 0, 0)));
    EXPECT_FALSE(meets(Vec3(0, 2.0001f, 0), Vec3(1, 0, 0)));
    EXPECT_TRUE(meets(Vec3(0, 2.0001f, 0), Vec3(1, 0, 0), 0.0001));
    EXPECT_DOUBLE_EQ(sphere.half_area(), 8.0 * std::numbers::pi);
    EXPECT_TRUE(sphere.bounds().contains(Box{Vec3(1, -2, -2), Vec3(5, 2, 2)}));
    EXPECT_LT(sphere.bounds().upper.x, 5.00001f);
}

/// Its axes are any vectors; roundings of scalar products with the others of this test are large.
OrientedBox endless_box(Rng& rng) {
    OrientedBox box;
    for (Vec3& axis : box.axis) axis = vector_of(rng, one, tiny, tiny);
    box.lower.fill(-1e30);
    box.upper.fill(1e30);
    return box;
}

/// Whether the ray's exact parameter on one plane of a box of axis k is outside the interval.
template <class Bounds>
bool is_slab_wrong(const Ray& ray, const OrientedBox& box, size_t k, double plane) {
    const Exact axis = exact(box.axis[k]);
    const mpq_class distance = mpq_class(plane) - dot(axis, exact(ray.origin));
    const mpq_class t = distance / dot(axis, exact(ray.direction));
    double near, far;
    const bool is_met = typename OrientedBox::Test<Bounds>(ray, 0.0).meets(box, near, far);
    if (!is_met) return true;
    return (std::isfinite(near) && mpq_class(near) > t) || (std::isfinite(far) && mpq_class(far) < t);
}

/// Slabs that end within a rounding of the ray's point at t = `at`, and whose interval does not hold it.
template <class Bounds>
int slabs_without_the_point(int case_count, float at) {
    Rng rng(4);
    int wrong = 0;
    for (int i = 0; i < case_count; ++i) {
        Ray ray;
        ray.origin = vector_of(rng, one, one, one);
        ray.direction = vector_of(rng, one, one, one);
        OrientedBox box = endless_box(rng);
        const size_t k = rng.next_index(3);
        const Exact axis = exact(box.axis[k]);
        const mpq_class place =
            dot(axis, exact(ray.origin)) + mpq_class(at) * dot(axis, exact(ray.direction));
        double& plane = rng.next() < 0.5f ? box.upper[k] : box.lower[k];
        plane = place.get_d();
        wrong += is_slab_wrong<Bounds>(ray, box, k, plane);
    }
    return wrong;
}

/// At t = 0 the roundings of the origin's scalar product are all there is.
TEST(OrientedBox, ThePointsOfTheRayInsideAreInItsIntervalAndWithHalfTheBoundSomeAreNot) {
    for (const float at : {0.0f, 1.0f, 3.9f, 1e4f})
        EXPECT_EQ(slabs_without_the_point<VolumeBounds>(1500, at), 0);
    EXPECT_GT(slabs_without_the_point<HalfUnit>(1500, 0.0f), 0);
}

/// A slab that is open on one side.
struct HalfSpace {
    Vec3 axis, origin, direction;
    bool is_lower;
    double plane;
};
template <class Bounds>
int wrong_slabs(std::span<const HalfSpace> cases) {
    int wrong = 0;
    for (const HalfSpace& one_case : cases) {
        Rng rng(6);
        OrientedBox box = endless_box(rng);
        box.axis[0] = one_case.axis;
        (one_case.is_lower ? box.lower : box.upper)[0] = one_case.plane;
        const Ray ray{.origin = one_case.origin, .direction = one_case.direction};
        wrong += is_slab_wrong<Bounds>(ray, box, 0, one_case.plane);
    }
    return wrong;
}

/// Origins so close to 0 that only the roundings of the distance, of the direction's scalar product and of
/// the quotient count. Found by a search that changes single bits. Half of all their bounds is wrong. The pad
/// of the quotient alone has more room: sums and bounds are rounded to the same doubles, so that the other
/// bounds often cover some of its four roundings too. With less than u some answers are wrong; with more,
/// from u, which is 2u above 1, up to the 5u of the derivation, a search over 10^7 cases found none.
TEST(OrientedBox, QuotientsNeedTheirBound) {
    const HalfSpace of_all[] = {{{-0x1.a01ad4p+0f, 0x1.8da23ap-20f, -0x1.9a906ep-19f},
                                 {-0x1.3afc0ep-53f, 0x1.d37d08p-68f, -0x1.58de12p-52f},
                                 {0x1.b9544ep-1f, 0x1.6d22a2p-12f, 0x1.0810ep-25f},
                                 true,
                                 -0x1.09c4772f6e36bp+1},
                                {{0x1.8a81ep-11f, -0x1.c302dcp+0f, -0x1.489ae8p+0f},
                                 {0x1.5f1194p-55f, 0x1.bf1f84p-63f, -0x1.900476p-53f},
                                 {0x1.cf39e4p+0f, -0x1.98bf78p+0f, -0x1.7eff8ep-8f},
                                 false,
                                 0x1.05c62df6e9c2dp+1},
                                {{0x1.7f23bep-26f, 0x1.eb8008p+0f, -0x1.49cbf6p+0f},
                                 {-0x1.39ceep-47f, 0x1.cee538p-49f, -0x1.cfcd1ap-42f},
                                 {0x1.ec37e2p-5f, -0x1.6b4a48p-14f, -0x1.d14852p-20f},
                                 true,
                                 -0x1.0197c395a22d7p-12}};
    EXPECT_EQ(wrong_slabs<VolumeBounds>(of_all), 0);
    EXPECT_GT(wrong_slabs<HalfUnit>(of_all), 0);
    const HalfSpace of_quotients[] = {{{0x1.40a26p+0f, -0x1.5eda24p+0f, -0x1.9b73bcp-15f},
                                       {-0x1.4b9694p-43f, 0x1.eea73ep-40f, 0x1.3bac92p-47f},
                                       {-0x1.947ab2p-11f, 0x1.16ddfap+0f, 0x1.81911ep+0f},
                                       true,
                                       -0x1.827f31306a098p+0},
                                      {{-0x1.b6388p-12f, -0x1.c8dfd2p+0f, 0x1.d353c6p-14f},
                                       {-0x1.ae963cp-53f, -0x1.287abep-53f, -0x1.2f340ap-44f},
                                       {-0x1.c71b1ap+0f, 0x1.a884eep+0f, -0x1.a8152cp+0f},
                                       true,
                                       -0x1.8a2eab1f70cedp+1},
                                      {{0x1.bb2068p+0f, 0x1.67432cp+0f, -0x1.58240ep-8f},
                                       {-0x1.a5462ap-20f, -0x1.d4fde8p-8f, 0x1.4d0876p-8f},
                                       {-0x1.ca5b1p-13f, -0x1.aaed62p+0f, -0x1.03c42cp-12f},
                                       true,
                                       -0x1.d79e5f57085f7p-6}};
    EXPECT_EQ(wrong_slabs<VolumeBounds>(of_quotients), 0);
    EXPECT_GT(wrong_slabs<SmallQuotientPad>(of_quotients), 0);
}

TEST(OrientedBox, HitsAndMissesAsComputedByHand) {
    // The square |x| + |y| <= 1 between z = 0 and 1, its axes not of unit length.
    const OrientedBox box{{Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(0, 0, 1)}, {-1, -1, 0}, {1, 1, 1}};
    double near, far;
    const auto meets = [&](const Vec3& origin, const Vec3& direction, double margin = 0.0) {
        return OrientedBox::Test<VolumeBounds>({.origin = origin, .direction = direction}, margin)
            .meets(box, near, far);
    };
    ASSERT_TRUE(meets(Vec3(-3, 0.5f, 0.5f), Vec3(1, 0, 0)));
    EXPECT_NEAR(near, 2.5, 1e-14);
    EXPECT_NEAR(far, 3.5, 1e-14);
    EXPECT_TRUE(meets(Vec3(-3, 1, 0), Vec3(1, 0, 0)));  // a corner
    EXPECT_FALSE(meets(Vec3(-3, 1.0001f, 0), Vec3(1, 0, 0)));
    EXPECT_TRUE(meets(Vec3(-3, 1.0001f, 0), Vec3(1, 0, 0), 0.0001));
    EXPECT_FALSE(meets(Vec3(-3, 0, 1.0001f), Vec3(1, 0, 0)));  // beside a slab that the ray is parallel to
    EXPECT_TRUE(meets(Vec3(-3, 0, 1), Vec3(1, -0.0f, 0)));     // in its wall
    EXPECT_TRUE(meets(Vec3(1, 0, 0.5f), Vec3(1, -1, 0)));      // in a slanting wall
    EXPECT_TRUE(meets(Vec3(0, 0, -1), Vec3(0, 0, 0x1p-140f)));
    EXPECT_TRUE(box.bounds().contains(Box{Vec3(-1, -1, 0), Vec3(1, 1, 1)}));
    EXPECT_LT(box.bounds().upper.x, 1.00001f);
}

TEST(OrientedBox, ContainsItsVerticesAndWithHalfTheBoundSomeStickOut) {
    const auto outside = []<class Bounds>(Bounds, int case_count) {
        Rng rng(5);
        int count = 0;
        for (int i = 0; i < case_count; ++i) {
            const Vec3 axis = endless_box(rng).axis[0], point = vector_of(rng, one, one, one);
            const BoundedDot place = bounded_dot<Bounds>(DVec3(axis), DVec3(point));
            const mpq_class exact_place = dot(exact(axis), exact(point));
            count += mpq_class(place.value) - mpq_class(place.error) > exact_place ||
                     mpq_class(place.value) + mpq_class(place.error) < exact_place;
        }
        return count;
    };
    EXPECT_EQ(outside(VolumeBounds{}, 5000), 0);
    EXPECT_GT(outside(HalfUnit{}, 5000), 0);
}

bool contains(const Sphere& sphere, const Exact& p) {
    const Exact v = p - exact(sphere.center);
    return dot(v, v) <= mpq_class(sphere.radius) * sphere.radius;
}
bool contains(const OrientedBox& box, const Exact& p) {
    for (size_t k = 0; k < 3; ++k) {
        const mpq_class place = dot(exact(box.axis[k]), p);
        if (place < mpq_class(box.lower[k]) || place > mpq_class(box.upper[k])) return false;
    }
    return true;
}

/// By exact arithmetic: every corner of every triangle's part in a leaf is in the leaf's volume and in those
/// above it.
template <class Method>
void expect_every_part_inside(const std::string& base, const Method& method, const Mesh& mesh) {
    const Built built = run(base, mesh);
    const Bvh2& input = *built.structure.as<Bvh2>();
    Task task;
    const auto bvh = method.apply(mesh, built.references->refs, input, task);
    ASSERT_EQ(bvh.nodes.size(), input.nodes.size());
    EXPECT_EQ(bvh.prims, input.prims);
    const NodeList list = bvh.list_nodes();
    EXPECT_EQ(check_nodes(list, mesh.triangle_count()), "");
    for (uint32_t i = 0; i < input.nodes.size(); ++i) {
        const Bvh2::Node& leaf = input.nodes[i];
        ASSERT_EQ(bvh.nodes[i].first, leaf.first);
        for (uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k)
            for (const Exact& corner : oracle::clip(mesh.triangle(bvh.prims[k]), {leaf.lower, leaf.upper}))
                for (uint32_t above = i; above != kNoIndex; above = list.nodes[above].parent)
                    ASSERT_TRUE(contains(bvh.nodes[above].volume, corner))
                        << "leaf " << i << " in node " << above;
    }
}

TEST(VolumeBvh, EachVolumeContainsThePartsBelowItExactly) {
    const Mesh mesh = random_triangles(60, 0.5f, 1);
    for (const char* base : {"bvh-object-median", "esc(s=5) > bvh-binned-sah", "evh(t=9) > bvh-binned-sah"}) {
        expect_every_part_inside(base, Spheres{.center = Spheres::Mean}, mesh);
        expect_every_part_inside(base, Spheres{}, mesh);
        expect_every_part_inside(base, OrientedBoxes{}, mesh);
    }
    Mesh far = random_triangles(40, 0.5f, 2);
    for (Vec3& position : far.positions) position += 1e7f;
    expect_every_part_inside("bvh-object-median", OrientedBoxes{}, far);
    expect_every_part_inside("bvh-object-median", Spheres{}, far);
}

TEST(Spheres, TheCentreIsTheMeanVertexOrThatOfTheBox) {
    // Corners (0,0,0), (6,0,0), (0,3,0): the mean is (2, 1, 0), the farthest corner (6,0,0); the box's centre
    // (3, 1.5, 0).
    Mesh mesh = random_triangles(1, 1.0f, 1);
    mesh.positions = {Vec3(0), Vec3(6, 0, 0), Vec3(0, 3, 0)};
    Task task;
    const Bvh2 bvh = *run("bvh-object-median", mesh).structure.as<Bvh2>();
    const auto mean = Spheres{.center = Spheres::Mean}.apply(mesh, {}, bvh, task);
    EXPECT_EQ(mean.nodes[0].volume.center, Vec3(2, 1, 0));
    EXPECT_NEAR(mean.nodes[0].volume.radius, std::sqrt(17.0), 1e-14);
    const auto of_box = Spheres{}.apply(mesh, {}, bvh, task);
    EXPECT_EQ(of_box.nodes[0].volume.center, Vec3(3, 1.5f, 0));
    EXPECT_NEAR(of_box.nodes[0].volume.radius, std::sqrt(11.25), 1e-14);
}

TEST(OrientedBoxes, ATurnedPlateGetsItsOwnBoxAndAnUprightOneKeepsIts) {
    // A 4 x 1 rectangle, turned by 45 degrees in x and y: 4 as half area instead of (5 / sqrt 2)^2 = 12.5.
    Mesh mesh = random_triangles(2, 1.0f, 1);
    const float c = std::sqrt(0.5f);
    const Vec3 u = 4.0f * Vec3(c, c, 0), v = Vec3(-c, c, 0);
    mesh.positions = {Vec3(0), u, u + v, Vec3(0), u + v, v};
    Task task;
    const auto turned =
        OrientedBoxes{}.apply(mesh, {}, *run("bvh-object-median", mesh).structure.as<Bvh2>(), task);
    EXPECT_NEAR(turned.nodes[0].volume.half_area(), 4.0, 1e-5);
    mesh.positions = {Vec3(0), Vec3(4, 0, 0), Vec3(4, 1, 2), Vec3(0), Vec3(4, 1, 2), Vec3(0, 1, 2)};
    mesh.positions[2] = Vec3(4, 1, 0);
    mesh.positions[4] = Vec3(4, 1, 0);
    mesh.positions[5] = Vec3(0, 1, 0);
    const auto upright =
        OrientedBoxes{}.apply(mesh, {}, *run("bvh-object-median", mesh).structure.as<Bvh2>(), task);
    EXPECT_EQ(upright.nodes[0].volume.axis[0], Vec3(1, 0, 0));
    EXPECT_EQ(upright.nodes[0].volume.half_area(), 4.0);
}

TEST(VolumeBvh, ListsItsOutlinesAndItsOwnAreas) {
    const Mesh mesh = random_triangles(50, 0.3f, 3);
    for (const std::string transform : {"spheres", "oriented-boxes"}) {
        const NodeList list = run("bvh-object-median > " + transform, mesh).structure.list_nodes();
        ASSERT_EQ(list.half_areas.size(), list.nodes.size());
        EXPECT_FALSE(list.is_nested);
        std::vector<int> segments(list.nodes.size(), 0);
        for (const OutlineSegment& segment : list.outlines) {
            ++segments[segment.node];
            Box ends;
            ends.extend(segment.from);
            ends.extend(segment.to);
            ASSERT_TRUE(list.nodes[segment.node].bounds.contains(ends));
        }
        for (size_t i = 0; i < segments.size(); ++i) {
            ASSERT_GE(segments[i], 12) << transform;
            ASSERT_GT(list.half_areas[i], 0.0);
            if (transform == "oriented-boxes") continue;
            const double of_box = list.nodes[i].bounds.half_area();
            ASSERT_NEAR(list.half_areas[i], std::numbers::pi / 6.0 * of_box, 1e-5 * of_box);
        }
    }
}

}  // namespace
}  // namespace boxwood
