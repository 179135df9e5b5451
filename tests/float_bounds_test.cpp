#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/float_bounds_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <span>
#include <vector>

#include "core/wide_bvh/float_tests-inl.h"
#include "support/float_cases.h"

// What floats decide for sure is compared with rational arithmetic, for every instruction set of this
// machine. Every bound is needed: with half of it some answer is wrong. Where only fused operations need a
// bound that large, that is asked for only on a machine that has them.

#ifndef BOXWOOD_TESTS_FLOAT_BOUNDS
#define BOXWOOD_TESTS_FLOAT_BOUNDS
namespace boxwood {

/// Two thirds: half is not a float.
struct LessNear : FloatBounds {
    static constexpr float kNear = 1.0f - 2.0f * kUnit;
};
struct HalfFar : FloatBounds {
    static constexpr float kFar = 1.0f + 2.0f * kUnit;
};
struct HalfSlab : FloatBounds {
    static constexpr float kSlab = 0.5f * FloatBounds::kSlab;
};
struct ThirdSlab : FloatBounds {
    static constexpr float kSlab = 0.3f * FloatBounds::kSlab;
};
struct HalfMoved : FloatBounds {
    static constexpr float kMoved = 0.5f * FloatBounds::kMoved;
};
struct NoMargin : FloatBounds {
    static constexpr float kMargin = 0.0f;
};
struct HalfEdge : FloatBounds {
    static constexpr float kEdge = 0.5f * FloatBounds::kEdge;
};
struct HalfFarEdge : FloatBounds {
    static constexpr float kFarEdge = 0.5f * FloatBounds::kFarEdge;
};
struct HalfTerm : FloatBounds {
    static constexpr float kTermUnit = 0.5f * FloatBounds::kTermUnit;
};
struct HalfFastEdge : FloatBounds {
    static constexpr float kFastEdge = 0.5f * FloatBounds::kFastEdge;
};
struct HalfFastRange : FloatBounds {
    static constexpr float kFastRange = 0.5f * FloatBounds::kFastRange;
};
struct HalfFastZ : FloatBounds {
    static constexpr float kFastZ = 0.5f * FloatBounds::kFastZ;
};
struct NoUnderflow : FloatBounds {
    static constexpr float kUnderflow = 0.0f;
};

enum class Variant {
    Derived,
    LessNear,
    HalfFar,
    HalfSlab,
    ThirdSlab,
    HalfMoved,
    NoMargin,
    HalfEdge,
    HalfFarEdge,
    HalfTerm,
    HalfFastEdge,
    HalfFastRange,
    HalfFastZ,
    NoUnderflow
};

/// What floats tell of one triangle and of one box.
struct FloatAnswer {
    bool is_usable = false, is_open = true, is_sure = false;
    bool is_plane_sure = false;  ///< [lower, upper] holds for the plane, hit or not
    float lower = 0.0f, upper = 0.0f;
    float entry = 0.0f, exit = 0.0f;  ///< of the box, up to the ray's end
};

}  // namespace boxwood
#endif

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

void answer_cases(std::span<const FloatCase>, Mode, Variant, std::span<FloatAnswer>) {}

#else

template <Mode mode, class Bounds>
HWY_NOINLINE void answer_with(std::span<const FloatCase> cases, std::span<FloatAnswer> answers) {
    const PackTag<4> d;
    for (size_t i = 0; i < cases.size(); ++i) {
        const FloatCase& one_case = cases[i];
        FloatAnswer& answer = answers[i];
        answer = {};
        const FloatRays<mode, Bounds> rays({&one_case.ray, 1}, FloatScene(one_case.box));
        answer.is_usable = rays.usable[0] != 0;
        if (!answer.is_usable) continue;
        const FloatRay<mode, 4, Bounds> ray(rays, 0);
        TrianglePack<4> pack{};
        WideBvh<8>::Node node;
        HWY_ALIGN float entries[8], exits[8];
        const Vec3 corners[3] = {one_case.triangle.a, one_case.triangle.b, one_case.triangle.c};
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 3; ++corner)
                hn::Store(hn::Set(d, corners[corner][axis]), d, pack.corners[corner][axis]);
            std::ranges::fill(node.lower[axis], one_case.box.lower[axis]);
            std::ranges::fill(node.upper[axis], one_case.box.upper[axis]);
        }
        PackHits<4> hits;
        answer.is_open = test_pack(pack, ray, one_case.ray.t_max, hits);
        answer.is_sure = answer.is_open && (hits.sure & 1) != 0;
        const PlaneHits<4> plane(pack, 0, ray, Sheared<4>(pack, 0, ray));
        answer.is_plane_sure = (mask_bits(d, plane.is_sure) & 1) != 0;
        answer.lower = hn::GetLane(plane.lower);
        answer.upper = hn::GetLane(plane.upper);
        const BoxRay<8> box_ray(rays, 0, Planes<8>(rays.octant[0]), &node);
        const typename BoxRay<8>::D d8;
        hn::Store(box_ray.entry(0), d8, entries);
        hn::Store(box_ray.exit(0, one_case.ray.t_max), d8, exits);
        answer.entry = entries[0];
        answer.exit = exits[0];
    }
}

void answer_cases(std::span<const FloatCase> cases, Mode mode, Variant variant,
                  std::span<FloatAnswer> answers) {
    const bool is_exact = mode == Mode::Exact;
    switch (variant) {
        case Variant::Derived:
            return is_exact ? answer_with<Mode::Exact, FloatBounds>(cases, answers)
                            : answer_with<Mode::Fast, FloatBounds>(cases, answers);
        case Variant::NoUnderflow:
            return answer_with<Mode::Exact, NoUnderflow>(cases, answers);
        case Variant::LessNear:
            return answer_with<Mode::Exact, LessNear>(cases, answers);
        case Variant::HalfFar:
            return answer_with<Mode::Exact, HalfFar>(cases, answers);
        case Variant::HalfSlab:
            return answer_with<Mode::Exact, HalfSlab>(cases, answers);
        case Variant::ThirdSlab:
            return answer_with<Mode::Exact, ThirdSlab>(cases, answers);
        case Variant::HalfMoved:
            return answer_with<Mode::Exact, HalfMoved>(cases, answers);
        case Variant::HalfEdge:
            return answer_with<Mode::Exact, HalfEdge>(cases, answers);
        case Variant::HalfFarEdge:
            return answer_with<Mode::Exact, HalfFarEdge>(cases, answers);
        case Variant::HalfTerm:
            return answer_with<Mode::Exact, HalfTerm>(cases, answers);
        case Variant::NoMargin:
            return answer_with<Mode::Fast, NoMargin>(cases, answers);
        case Variant::HalfFastEdge:
            return answer_with<Mode::Fast, HalfFastEdge>(cases, answers);
        case Variant::HalfFastRange:
            return answer_with<Mode::Fast, HalfFastRange>(cases, answers);
        case Variant::HalfFastZ:
            return answer_with<Mode::Fast, HalfFastZ>(cases, answers);
    }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <gtest/gtest.h>

#include <functional>

#include "oracle/oracle.h"
#include "support/exact_entry.h"
#include "support/simd_targets.h"

namespace boxwood {
namespace {

HWY_EXPORT(answer_cases);

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Make = std::function<FloatCase(Rng&)>;

/// Every box of a case without one becomes the triangle's.
std::vector<FloatCase> make_cases(const Make& make, int count, uint64_t seed) {
    Rng rng(seed);
    std::vector<FloatCase> cases;
    for (int i = 0; i < count; ++i) {
        cases.push_back(make(rng));
        if (cases.back().box.is_empty()) cases.back().box = cases.back().triangle.bounds();
    }
    return cases;
}

/// Cases of the given seeds: found by a search over millions.
std::vector<FloatCase> found_cases(const Make& make, std::initializer_list<uint64_t> seeds) {
    std::vector<FloatCase> cases;
    for (const uint64_t seed : seeds) cases.push_back(make_cases(make, 1, seed).front());
    return cases;
}

std::vector<FloatAnswer> answers_of(const std::vector<FloatCase>& cases, Mode mode, Variant variant) {
    std::vector<FloatAnswer> answers(cases.size());
    HWY_DYNAMIC_DISPATCH(answer_cases)(cases, mode, variant, answers);
    return answers;
}

using IsWrong = std::function<bool(const FloatCase&, const FloatAnswer&)>;

bool is_box_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    if (!oracle::meets(one_case.ray, one_case.box)) return false;
    if (!(answer.entry <= answer.exit) || exact(answer.entry) > entry_of(one_case.ray, one_case.box))
        return true;
    const std::optional<mpq_class> exit = exit_of(one_case.ray, one_case.box);
    return std::isfinite(answer.exit) && exit && exact(answer.exit) < *exit;
}

/// Exact mode: a lane that is neither open nor hit; sure and not hit; or an interval without t.
bool is_triangle_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    if (!answer.is_open) return oracle::intersect(one_case.ray, one_case.triangle).has_value();
    return answer.is_sure && !oracle::hits_line(one_case.ray, one_case.triangle);
}
bool is_line_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    if (!answer.is_open || answer.is_sure)
        return oracle::hits_line(one_case.ray, one_case.triangle) != answer.is_sure;
    return false;
}
bool is_t_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    if (!answer.is_plane_sure || !std::isfinite(answer.lower) || !std::isfinite(answer.upper)) return false;
    const std::optional<mpq_class> t = oracle::plane_parameter(one_case.ray, one_case.triangle);
    return !t || *t < exact(answer.lower) || *t > exact(answer.upper);
}

/// The t that fast mode compares; infinity for a miss.
float searched_t(Ray ray, const Triangle& triangle) {
    NoCount count;
    ClosestHit<Mode::Fast> closest(ray);
    closest.test(triangle, 0, count);
    return closest.searched_t();
}
/// The same of fast mode's own hits, in and out of range.
bool is_fast_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    const float t = searched_t(one_case.ray, one_case.triangle);
    if (!answer.is_open) return t != kInfinity;
    if (!answer.is_sure) return false;
    if (t != kInfinity) return !(answer.lower <= t) || !(answer.upper >= t);
    return answer.lower >= one_case.ray.t_min && answer.upper <= one_case.ray.t_max;
}
/// Whether a hit of fast mode is outside the widened box. To be asked with the hit's t as the ray's end.
bool is_fast_box_wrong(const FloatCase& one_case, const FloatAnswer& answer) {
    const float t = searched_t(one_case.ray, one_case.triangle);
    return t != kInfinity && !(answer.entry <= t && answer.entry <= answer.exit);
}

int wrong_count(const std::vector<FloatCase>& cases, Mode mode, Variant variant, const IsWrong& is_wrong) {
    const std::vector<FloatAnswer> answers = answers_of(cases, mode, variant);
    int wrong = 0;
    for (size_t i = 0; i < cases.size(); ++i)
        wrong += answers[i].is_usable && is_wrong(cases[i], answers[i]) ? 1 : 0;
    return wrong;
}

/// Which kind of arithmetic rounds enough to need the whole bound.
enum class Needs { Any, Fused, Plain };

/// No answer with the derived bounds is wrong, and with the variant's on some instruction set some are.
void expect_needed(const std::vector<FloatCase>& cases, Mode mode, Variant variant, const IsWrong& is_wrong,
                   Needs needs = Needs::Any) {
    int wrong = 0;
    bool is_tried = false;
    for_each_vector_target(HWY_TARGETS, [&](const std::string& name, bool is_fused) {
        EXPECT_EQ(wrong_count(cases, mode, Variant::Derived, is_wrong), 0) << name;
        if (needs != Needs::Any && is_fused != (needs == Needs::Fused)) return;
        wrong += wrong_count(cases, mode, variant, is_wrong);
        is_tried = true;
    });
    EXPECT_TRUE(wrong > 0 || !is_tried);
}

TEST(FloatBounds, ParametersNeedTheirFactors) {
    const std::vector<FloatCase> cases = make_cases(from_zero, 20000, 15);
    expect_needed(cases, Mode::Exact, Variant::LessNear, is_box_wrong);
    expect_needed(cases, Mode::Exact, Variant::HalfFar, is_box_wrong);
}

/// Where products round by themselves, half of the pad is rounded up to the whole in these cases.
TEST(FloatBounds, SlabRoundingsNeedTheirPad) {
    const std::vector<FloatCase> cases = make_cases(beside_plane, 4000, 1);
    expect_needed(cases, Mode::Exact, Variant::HalfSlab, is_box_wrong, Needs::Fused);
    expect_needed(cases, Mode::Exact, Variant::ThirdSlab, is_box_wrong, Needs::Plain);
}

/// As leaving_ray moves the origin of a ray that starts on a flat box, in a scene far larger than that.
TEST(FloatBounds, RaysThatLeaveAFlatBoxDoNotMeetIt) {
    Rng rng(16);
    std::vector<FloatCase> cases;
    for (int i = 0; i < 1000; ++i) {
        FloatCase one_case;
        const float plane = one(rng), end = rng.next(100.0f, 200.0f);
        one_case.box = {{plane, -end, -end}, {plane, end, end}};
        one_case.ray.origin = {plane - 0x1p-22f * plane, rng.next(), rng.next()};
        one_case.ray.direction = {-rng.next(0.01f, 1.0f), rng.next(), rng.next()};
        cases.push_back(one_case);
    }
    for_each_vector_target(HWY_TARGETS, [&](const std::string& name, bool is_fused) {
        if (!is_fused) return;
        for (const FloatAnswer& answer : answers_of(cases, Mode::Exact, Variant::Derived))
            EXPECT_GT(answer.entry, answer.exit) << name;
    });
}

TEST(FloatBounds, ReplacedComponentsNeedTheirPad) {
    expect_needed(make_cases(in_flat_box, 500, 2), Mode::Exact, Variant::HalfMoved, is_box_wrong);
}

TEST(FloatBounds, BoxesAreMetAtTheirCorners) {
    const std::vector<FloatCase> cases = make_cases(at_corner, 6000, 3);
    EXPECT_TRUE(oracle::meets(cases[0].ray, cases[0].box));
    for_each_vector_target(HWY_TARGETS, [&](const std::string& name, bool) {
        EXPECT_EQ(wrong_count(cases, Mode::Exact, Variant::Derived, is_box_wrong), 0) << name;
    });
}

/// Every ray ends at its hit.
std::vector<FloatCase> fast_hits(const Make& make, int count, uint64_t seed) {
    std::vector<FloatCase> hits;
    for (FloatCase& one_case : make_cases(make, count, seed)) {
        one_case.ray.t_max = searched_t(one_case.ray, one_case.triangle);
        if (one_case.ray.t_max != kInfinity) hits.push_back(one_case);
    }
    return hits;
}

/// Without the margin boxes are missed. That half of it is too small is seen where nothing else is added
/// (FastMode.MarginHoldsAndHalfOfItDoesNot): here the factors of both planes, 7u of the parameter, cover what
/// fast mode's own roundings do near a corner, and edges need 2u of the reach in these cases.
TEST(FloatBounds, BoxesNeedFastModesMargin) {
    const std::vector<FloatCase> hits = fast_hits(past_edge, 50000, 4);
    EXPECT_GT(hits.size(), 2000u);
    expect_needed(hits, Mode::Fast, Variant::NoMargin, is_fast_box_wrong);
}

TEST(FloatBounds, EdgeFunctionsNeedTheirBound) {
    const Make make = [](Rng& rng) { return aimed_at_edge(rng, false); };
    const std::vector<FloatCase> cases =
        found_cases(make, {235712, 695972, 933105, 1041236, 1082220, 2497228, 2872638});
    expect_needed(cases, Mode::Exact, Variant::HalfEdge, is_line_wrong, Needs::Plain);
}

TEST(FloatBounds, EdgeFunctionsNeedTheirBoundByTheScene) {
    const Make make = [](Rng& rng) { return aimed_at_edge(rng, true); };
    const std::vector<FloatCase> cases = found_cases(
        make, {152091, 236215, 329939, 352094, 367971, 397378, 519392, 620933, 766256, 778493, 1303158});
    expect_needed(cases, Mode::Exact, Variant::HalfFarEdge, is_line_wrong, Needs::Plain);
}

TEST(FloatBounds, TNeedsItsBound) {
    const std::vector<FloatCase> cases =
        found_cases(with_large_roundings_of_t, {10385, 29291, 34969, 44466, 51741, 86710});
    expect_needed(cases, Mode::Exact, Variant::HalfTerm, is_t_wrong, Needs::Plain);
}

/// However the mantissas fall, no answer is wrong.
TEST(FloatBounds, HoldWhereRoundingsAreLarge) {
    const Make near = [](Rng& rng) { return aimed_at_edge(rng, false); };
    const Make far = [](Rng& rng) { return aimed_at_edge(rng, true); };
    const std::vector<FloatCase> near_edge = make_cases(near, 20000, 5), far_edge = make_cases(far, 20000, 6),
                                 planes = make_cases(with_large_roundings_of_t, 4000, 7),
                                 corners = make_cases(along_z_inside_corner, 20000, 10);
    for_each_vector_target(HWY_TARGETS, [&](const std::string& name, bool) {
        SCOPED_TRACE(name);
        EXPECT_EQ(wrong_count(near_edge, Mode::Exact, Variant::Derived, is_line_wrong), 0);
        EXPECT_EQ(wrong_count(far_edge, Mode::Exact, Variant::Derived, is_line_wrong), 0);
        EXPECT_EQ(wrong_count(planes, Mode::Exact, Variant::Derived, is_t_wrong), 0);
        EXPECT_EQ(wrong_count(corners, Mode::Fast, Variant::Derived, is_fast_wrong), 0);
    });
}

/// t is 3 2^-152: not a float, and the float next to it is an ulp away.
TEST(FloatBounds, TThatUnderflowsNeedsItsBound) {
    FloatCase one_case;
    one_case.triangle = {{-1.0f, -1.0f, 0.0f}, {2.0f, -1.0f, 0.0f}, {-1.0f, 2.0f, 0.0f}};
    one_case.box = one_case.triangle.bounds();
    one_case.ray.origin = {0.0f, 0.0f, -3.0f * 0x1p-140f};
    one_case.ray.direction = {0.0f, 0.0f, 0x1p12f};
    expect_needed({one_case}, Mode::Exact, Variant::NoUnderflow, is_t_wrong);
}

TEST(FloatBounds, FusedEdgeFunctionsOfFastModeNeedTheirBound) {
    expect_needed(make_cases(along_z_at_edge, 20000, 8), Mode::Fast, Variant::HalfFastEdge, is_fast_wrong,
                  Needs::Fused);
}

TEST(FloatBounds, FastModesTNeedsTheBoundOfItsEdgeFunctions) {
    expect_needed(make_cases(along_z_through_sliver, 20000, 9), Mode::Fast, Variant::HalfFastRange,
                  is_fast_wrong, Needs::Plain);
}

/// Found by a search that changes single bits of a ray along z past a corner of a triangle across it.
TEST(FloatBounds, FastModesTNeedsItsBound) {
    FloatCase one_case;
    constexpr float kZ = 0x1.2076e4p+0f;
    one_case.triangle = {{0x1.07e912p+0f, 0x1.c1e9a2p-10f, kZ},
                         {0x1.0eaa72p-10f, 0x1.f0ff26p-1f, kZ},
                         {-0x1.d1f4cp-7f, -0x1.b9ad64p-7f, kZ}};
    one_case.box = one_case.triangle.bounds();
    one_case.ray.direction.z = 0x1.9973b8p+0f;
    expect_needed({one_case}, Mode::Fast, Variant::HalfFastZ, is_fast_wrong, Needs::Plain);
}

TEST(FloatBounds, HoldOnRaysOfAllSizes) {
    std::vector<FloatCase> cases = make_cases(anywhere, 2000, 11);
    for (const FloatCase& one_case : make_cases(past_sliver, 500, 12)) cases.push_back(one_case);
    const std::vector<FloatCase> hits = fast_hits(anywhere, 5000, 13),
                                 slivers = fast_hits(past_sliver, 40000, 14);
    EXPECT_GT(hits.size(), 500u);
    EXPECT_GT(slivers.size(), 100u);
    for_each_vector_target(HWY_TARGETS, [&](const std::string& name, bool) {
        SCOPED_TRACE(name);
        size_t usable = 0, sure = 0, closed = 0;
        for (const FloatAnswer& answer : answers_of(cases, Mode::Exact, Variant::Derived)) {
            usable += answer.is_usable ? 1 : 0;
            sure += answer.is_sure ? 1 : 0;
            closed += answer.is_open ? 0 : 1;
        }
        EXPECT_GT(usable, cases.size() / 2);
        EXPECT_GT(sure, cases.size() / 20);
        EXPECT_GT(closed, cases.size() / 20);
        EXPECT_EQ(wrong_count(cases, Mode::Exact, Variant::Derived, is_box_wrong), 0);
        EXPECT_EQ(wrong_count(cases, Mode::Exact, Variant::Derived, is_triangle_wrong), 0);
        EXPECT_EQ(wrong_count(cases, Mode::Exact, Variant::Derived, is_t_wrong), 0);
        EXPECT_EQ(wrong_count(cases, Mode::Fast, Variant::Derived, is_fast_wrong), 0);
        for (const auto* ended : {&hits, &slivers})
            EXPECT_EQ(wrong_count(*ended, Mode::Fast, Variant::Derived, is_fast_box_wrong), 0);
    });
}

}  // namespace
}  // namespace boxwood
#endif
