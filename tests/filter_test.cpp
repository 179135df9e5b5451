#include "core/structure/filter.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/rng.h"
#include "core/structure/closest.h"
#include "oracle/oracle.h"

// Every bound is needed: with the derived one no answer is wrong, with half of it some are. Inputs are made
// so that roundings are large (mantissas just above a power of two, where half an ulp is the largest
// fraction) and so that each operation rounds (terms of very different size).

namespace boxwood {
namespace {

struct HalfEdge : FilterBounds {
    static constexpr double kEdge = 0.5 * FilterBounds::kEdge;
};
struct HalfTerm : FilterBounds {
    static constexpr double kTermUnit = 0.5 * FilterBounds::kTermUnit;
};
/// The next smaller double.
struct SmallerPad : FilterBounds {
    static constexpr double kSlabPad = 1.0 + 4.0 * kUnit;
};
/// So large a unit that every t is estimated from exact terms.
struct Estimated : FilterBounds {
    static constexpr double kTermUnit = 1.0;
};
struct HalfEstimate : Estimated {
    static constexpr double kEstimateError = 0.5 * FilterBounds::kEstimateError;
};

/// Just above 1.
float one(Rng& rng) { return 1.0f + 0.03f * rng.next(); }
float sign(Rng& rng) { return rng.next() < 0.5f ? -1.0f : 1.0f; }
/// Between 2^-44 and 2^-36, either sign: a sum with 1 rounds, and differences of it matter to double.
float tiny(Rng& rng) {
    const float value = one(rng) * sign(rng);
    return std::ldexp(value, -36 - static_cast<int>(rng.next_index(9)));
}

struct Aimed {
    Ray ray;
    Triangle triangle;
};

/// A ray through the middle of edge bc to within 2^-62, its origin almost in the triangle's plane.
Aimed aimed_at_edge(Rng& rng) {
    const float bx = one(rng) * sign(rng), by = one(rng) * sign(rng), bz = std::ldexp(one(rng), -20);
    const float dx = std::ldexp(one(rng) * sign(rng), -10), dy = std::ldexp(one(rng) * sign(rng), -10);
    const float oy = tiny(rng), oz = tiny(rng);
    Aimed result;
    result.ray.direction = {dx, dy, one(rng)};
    result.triangle.b = {bx, by, bz};
    result.triangle.c = -result.triangle.b;
    result.triangle.a = {-by, bx, 0.0f};
    // The sheared b and c are opposite but for the sheared origin, which must be parallel to them.
    const double sx = double(dx) / double(result.ray.direction.z);
    const double sy = double(dy) / double(result.ray.direction.z);
    const double ratio = (double(bx) - sx * double(bz)) / (double(by) - sy * double(bz));
    const double ox = (double(oy) - sy * double(oz)) * ratio + sx * double(oz);
    result.ray.origin = {static_cast<float>(ox), oy, oz};
    return result;
}

/// Certain answers of the filter that rational arithmetic contradicts.
template <class Bounds>
int wrong_edge_answers(int case_count, int& unknown_count) {
    Rng rng(1);
    int wrong = 0;
    for (int i = 0; i < case_count; ++i) {
        Aimed aimed = aimed_at_edge(rng);
        aimed.ray.direction *= sign(rng);
        const EdgeFilter<Bounds> filter(aimed.ray);
        const auto answer = filter.decide(filter.functions(aimed.triangle));
        unknown_count += answer == EdgeFilter<Bounds>::Answer::Unknown;
        if (answer == EdgeFilter<Bounds>::Answer::Unknown) continue;
        wrong += oracle::hits_line(aimed.ray, aimed.triangle) != (answer == EdgeFilter<Bounds>::Answer::Hit);
    }
    return wrong;
}

TEST(FilterBounds, EdgeBoundHoldsAndHalfOfItDoesNot) {
    int unknown = 0, ignored = 0;
    EXPECT_EQ(wrong_edge_answers<FilterBounds>(20000, unknown), 0);
    EXPECT_GT(unknown, 10000) << "the rays do not come close to the edge: the test shows nothing";
    EXPECT_GT(wrong_edge_answers<HalfEdge>(20000, ignored), 0);
}

/// N = A.n is nearly A_x e1_y e2_z, D = d.n nearly d_y e1_z e2_x, and the signs are such that the roundings
/// of A_x and e2_x, and of e1_z and e2_z, which come from the same coordinate of a, add up in N / D.
Aimed with_large_roundings_of_t(Rng& rng) {
    const float ax = tiny(rng), ay = tiny(rng), az = tiny(rng);
    const float by = one(rng) + 0.03f, bz = -one(rng), cx = one(rng), cz = one(rng);
    Aimed result;
    result.triangle.a = {ax, ay, az};
    result.triangle.b = {tiny(rng), by, bz};
    result.triangle.c.x = cx;
    result.triangle.c.y = tiny(rng);
    result.triangle.c.z = cz;
    result.ray.origin.x = -one(rng) - 0.03f;
    result.ray.origin.y = tiny(rng);
    result.ray.origin.z = tiny(rng);
    result.ray.direction.x = tiny(rng);
    result.ray.direction.y = one(rng);
    result.ray.direction.z = tiny(rng);
    return result;
}

/// Cases whose exact t is outside the interval.
template <class Bounds>
int intervals_without_t(int case_count) {
    Rng rng(2);
    int wrong = 0;
    for (int i = 0; i < case_count; ++i) {
        const Aimed aimed = with_large_roundings_of_t(rng);
        const Interval interval = interval_of_t<Bounds>(aimed.ray, aimed.triangle);
        const std::optional<mpq_class> t = oracle::plane_parameter(aimed.ray, aimed.triangle);
        wrong += *t < interval.lower || *t > interval.upper;
    }
    return wrong;
}

TEST(FilterBounds, BoundOfTHoldsAndHalfOfItDoesNot) {
    EXPECT_EQ(intervals_without_t<FilterBounds>(8000), 0);
    EXPECT_GT(intervals_without_t<HalfTerm>(8000), 0);
}

TEST(FilterBounds, BoundOfTheEstimateHoldsAndHalfOfItDoesNot) {
    EXPECT_EQ(intervals_without_t<Estimated>(2000), 0);
    EXPECT_GT(intervals_without_t<HalfEstimate>(2000), 0);
}

/// A ray that enters a box in its x plane and leaves it in its y plane at the same exact t = n / m: extents
/// and direction are i, j times n and m.
struct AtCorner {
    Ray ray;
    Box box;
};
AtCorner at_corner(Rng& rng) {
    const auto number = [&] { return 2048.0f + static_cast<float>(rng.next_index(64)); };  // 12 bits
    const float i = number(), j = number(), n = number();
    const float m = 3300.0f + static_cast<float>(rng.next_index(64));  // the pad rounds too
    const float rest =
        std::ldexp(2048.0f + static_cast<float>(rng.next_index(2048)), -50);  // n + rest rounds
    AtCorner result;
    result.ray.origin = {-i * rest, -j * rest, 0.0f};
    result.ray.direction = {i * m, j * m, 0.0f};
    result.box.lower = {i * n, -j * n, -1.0f};
    result.box.upper = {2.0f * i * n, j * n, 1.0f};
    return result;
}

template <class Bounds>
int missed_boxes(int case_count) {
    Rng rng(3);
    int missed = 0;
    for (int i = 0; i < case_count; ++i) {
        const AtCorner test = at_corner(rng);
        double entry;
        const bool meets = BasicRaySlabs<Bounds>(test.ray).meets(
            test.box.lower, test.box.upper, std::numeric_limits<double>::infinity(), entry);
        if (!meets && oracle::meets(test.ray, test.box)) ++missed;
    }
    return missed;
}

TEST(FilterBounds, SlabPadHoldsAndTheNextSmallerDoesNot) {
    EXPECT_EQ(missed_boxes<FilterBounds>(1500000), 0);
    EXPECT_GT(missed_boxes<SmallerPad>(1500000), 0);
    Rng rng(3);
    const AtCorner test = at_corner(rng);
    EXPECT_TRUE(oracle::meets(test.ray, test.box));
}

/// A ray that passes a corner of a triangle at some units of float, on the outside. Distances are just above
/// 1, and differences with the origin round.
Aimed past_corner(Rng& rng) {
    const float ox = 0x1p-10f * one(rng) * sign(rng), oz = 0x1p-10f * one(rng) * sign(rng);
    const float dz = one(rng), dx = dz * (1.0f - 0.01f * rng.next()), bz = one(rng);
    const double offset = double(rng.next(0.0f, 6.0f)) * 0x1p-24;
    const double x = double(ox) + double(dx) / double(dz) * (double(bz) - double(oz)) + offset;
    Aimed result;
    result.ray.origin = {ox, 0.0f, oz};
    result.ray.direction = {dx, 0.0f, dz};
    result.triangle.a = {static_cast<float>(x), 0.0f, bz};
    result.triangle.b = result.triangle.a + Vec3(0.125f, 0.5f, 0.0f);
    result.triangle.c = result.triangle.a + Vec3(0.125f, -0.5f, 0.0f);
    return result;
}

/// Hits of fast mode whose ray misses the triangle's box, widened by so much of the reach, up to the hit.
int fast_hits_outside(const std::function<Aimed(Rng&)>& make, double margin, int case_count, int& hit_count) {
    Rng rng(4);
    int outside = 0;
    for (int i = 0; i < case_count; ++i) {
        const Aimed aimed = make(rng);
        ClosestHit<Mode::Fast> closest(aimed.ray);
        NoCount count;
        closest.test(aimed.triangle, 0, count);
        if (std::isinf(closest.searched_t())) continue;
        ++hit_count;
        const Box box = aimed.triangle.bounds();
        const DVec3 origin(aimed.ray.origin);
        const DVec3 reach =
            glm::max(glm::abs(DVec3(box.lower) - origin), glm::abs(DVec3(box.upper) - origin));
        RaySlabs slabs(aimed.ray);
        slabs.widen(margin * std::max({reach.x, reach.y, reach.z}));
        double entry;
        outside += !slabs.meets(box.lower, box.upper, double(closest.searched_t()) * (1.0 + 0x1p-48), entry);
    }
    return outside;
}

/// Thin, short and far triangles, with corners that differ by roundings.
Aimed past_sliver(Rng& rng) {
    const auto point = [&](float extent) {
        const float x = rng.next(-extent, extent), y = rng.next(-extent, extent),
                    z = rng.next(-extent, extent);
        return Vec3(x, y, z);
    };
    Aimed result;
    result.ray.origin = point(2.0f);
    result.triangle.a = point(1.0f);
    const float size = std::ldexp(1.0f, -static_cast<int>(rng.next_index(25)));
    result.triangle.b = result.triangle.a + point(size);
    result.triangle.c = result.triangle.b + point(std::ldexp(size, -static_cast<int>(rng.next_index(25))));
    result.ray.direction = result.triangle.a + point(size) - result.ray.origin;
    return result;
}

TEST(FastMode, MarginHoldsAndHalfOfItDoesNot) {
    constexpr double kMargin = ClosestHit<Mode::Fast>::kMargin;
    int hit_count = 0, sliver_hit_count = 0;
    EXPECT_EQ(fast_hits_outside(past_corner, kMargin, 300000, hit_count), 0);
    EXPECT_GT(hit_count, 10000);
    EXPECT_EQ(fast_hits_outside(past_sliver, kMargin, 300000, sliver_hit_count), 0);
    EXPECT_GT(sliver_hit_count, 1000);
    EXPECT_GT(fast_hits_outside(past_corner, 0.5 * kMargin, 300000, hit_count), 0);
}

}  // namespace
}  // namespace boxwood
