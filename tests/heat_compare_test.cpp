#include "core/render/heat_compare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/bvh/object_median.h"
#include "core/render/image_compare.h"
#include "core/render/progressive_tracer.h"
#include "support/traced_scene.h"

namespace boxwood {
namespace {

/// 3 x 2 pixels that visited these nodes, tested twice as many primitives and decided none exactly.
HeatCounts picture_of(const std::vector<uint64_t>& nodes) {
    HeatCounts picture{.width = 3, .height = 2, .step = 1, .counts = {}};
    for (const uint64_t count : nodes) picture.counts.push_back({count, 2 * count, 0});
    return picture;
}

Vec3 at(const Image& image, int x, int y) {
    const uint8_t* pixel = image.pixel(x, y);
    return Vec3(pixel[0], pixel[1], pixel[2]);
}

TEST(HeatCompare, DifferencesByHand) {
    const HeatCounts a = picture_of({5, 9, 0, 7, 2, 1}), b = picture_of({5, 4, 0, 7, 12, 1});
    const HeatComparison nodes = compare_heat(a, b, {.shading = Shading::Heat});
    EXPECT_EQ(nodes.known, 6u);
    EXPECT_EQ(nodes.more_in_a, 1u);
    EXPECT_EQ(nodes.more_in_b, 1u);
    EXPECT_EQ(nodes.scale.largest, 12.0) << "of both pictures";
    EXPECT_EQ(nodes.difference_scale.largest, 10.0);
    const Vec3 zero = at(nodes.difference, 0, 0);
    for (const auto& [x, y] : {std::pair{2, 0}, std::pair{0, 1}, std::pair{2, 1}})
        EXPECT_EQ(at(nodes.difference, x, y), zero);
    EXPECT_GT(at(nodes.difference, 1, 0).x, at(nodes.difference, 1, 0).z) << "A does more: orange";
    EXPECT_LT(at(nodes.difference, 1, 1).x, at(nodes.difference, 1, 1).z) << "B does more: blue";
    const HeatComparison tests = compare_heat(a, b, {.shading = Shading::HeatTests});
    EXPECT_EQ(tests.difference_scale.largest, 20.0);
    const HeatComparison exact = compare_heat(a, b, {.shading = Shading::HeatExact});
    EXPECT_EQ(exact.more_in_a + exact.more_in_b, 0u);
}

TEST(HeatCompare, OneScaleForBothPictures) {
    const HeatComparison result =
        compare_heat(picture_of({1, 2, 3, 4, 5, 6}), picture_of({6, 50, 60, 70, 80, 90}), {});
    EXPECT_GE(result.scale.scale.upper, 80.0);
    EXPECT_EQ(at(result.images[0], 2, 1), at(result.images[1], 0, 0)) << "six nodes look alike in both";
}

TEST(HeatCompare, SwappedItsSignTurns) {
    const HeatCounts a = picture_of({5, 9, 0, 7, 2, 1}), b = picture_of({8, 4, 3, 7, 12, 0});
    const HeatComparison ab = compare_heat(a, b, {}), ba = compare_heat(b, a, {});
    EXPECT_EQ(ab.more_in_a, ba.more_in_b);
    EXPECT_EQ(ab.difference_scale, ba.difference_scale);
    for (size_t i = 0; i < a.counts.size(); ++i)
        EXPECT_EQ(heat_difference(a.counts[i], b.counts[i], Shading::Heat),
                  -heat_difference(b.counts[i], a.counts[i], Shading::Heat));
    EXPECT_EQ(ab.images[0], ba.images[1]);
}

TEST(HeatCompare, OfACoarsePictureOnlyKnownPixelsCount) {
    HeatCounts coarse = picture_of({3, 99, 99, 99, 99, 99});
    coarse.step = 4;
    const HeatComparison result = compare_heat(coarse, picture_of({3, 5, 6, 7, 8, 9}), {});
    EXPECT_EQ(result.known, 1u);
    EXPECT_EQ(result.more_in_a + result.more_in_b, 0u);
    EXPECT_EQ(at(result.difference, 2, 1), at(result.difference, 0, 0));
}

TEST(SignedScale, ZeroIsInTheMiddleAndBothSidesAreAlike) {
    for (const bool logarithmic : {false, true}) {
        const SignedScale scale{.most = 200.0, .logarithmic = logarithmic};
        EXPECT_EQ(scale.position(0.0), 0.0f);
        EXPECT_EQ(scale.position(200.0), 1.0f);
        EXPECT_EQ(scale.position(-999.0), -1.0f);
        for (const double value : {0.5, 3.0, 77.0}) {
            EXPECT_EQ(scale.position(value), -scale.position(-value));
            EXPECT_NEAR(scale.value(double(scale.position(value))), value, 1e-3);
        }
    }
    EXPECT_FLOAT_EQ(SignedScale{.most = 200.0}.position(50.0), 0.25f);
}

TEST(DivergingMap, LeavesTheMiddlesBrightnessOnBothSides) {
    const auto luminance = [](const Vec3& srgb) {
        const Vec3 linear = linear_from_srgb(srgb);
        return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z;
    };
    for (const bool dark : {false, true}) {
        const float way = dark ? 1.0f : -1.0f;
        for (int i = 0; i < 20; ++i) {
            const float near = static_cast<float>(i) / 20.0f, far = static_cast<float>(i + 1) / 20.0f;
            for (const float sign : {-1.0f, 1.0f}) {
                EXPECT_GT(way * luminance(diverging_srgb(sign * far, dark)),
                          way * luminance(diverging_srgb(sign * near, dark)))
                    << sign * near;
            }
        }
        const Vec3 middle = diverging_srgb(0.0f, dark);
        EXPECT_LT(std::abs(middle.x - middle.z), 0.02f) << "grey";
        EXPECT_EQ(diverging_srgb(std::nanf(""), dark), middle);
        EXPECT_EQ(diverging_srgb(-7.0f, dark), diverging_srgb(-1.0f, dark));
    }
}

TEST(ProgressiveTracer, HandsOverTheCountsOfThePixelCentres) {
    const std::shared_ptr<Scene> scene = random_scene(200, 0.3f);
    const Structure structure = structure_by(ObjectMedian{}, *scene);
    const TraceSettings settings = settings_of(33, 21, Shading::HeatTests, 2);
    ProgressiveTracer tracer(2);
    std::vector<Count> counts;
    EXPECT_EQ(tracer.snapshot_counts(counts), 0) << "nothing is known";
    tracer.start(scene, structure, settings);
    ASSERT_TRUE(tracer.wait(60000.0));
    ASSERT_EQ(tracer.snapshot_counts(counts), 1);
    ASSERT_EQ(counts.size(), 33u * 21u);
    const CameraFrame frame = camera_frame(settings.camera, 33.0 / 21.0);
    for (int y = 0; y < 21; ++y) {
        for (int x = 0; x < 33; ++x) {
            const Ray ray = camera_ray(frame, x + 0.5, y + 0.5, 33, 21);
            Hit hit;
            Count count;
            structure.closest_hits_counted(scene->mesh, std::span(&ray, 1), std::span(&hit, 1),
                                           std::span(&count, 1), settings.mode, Task{});
            const Count& found = counts[static_cast<size_t>(y) * 33 + static_cast<size_t>(x)];
            ASSERT_EQ(found.nodes, count.nodes);
            ASSERT_EQ(found.tests, count.tests);
            ASSERT_EQ(found.exact, count.exact);
        }
    }
    tracer.start(scene, structure, settings_of(33, 21, Shading::Primary, 1));
    ASSERT_TRUE(tracer.wait(60000.0));
    EXPECT_EQ(tracer.snapshot_counts(counts), 0) << "no heat";
}

}  // namespace
}  // namespace boxwood
