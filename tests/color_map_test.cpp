#include "core/render/color_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/render/image.h"

namespace boxwood {
namespace {

float luminance(const Vec3& linear) { return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z; }

TEST(ColorMap, EndsAndMiddleAreThePublishedColours) {
    EXPECT_EQ(map_srgb(ColorMap::Viridis, 0.0f) * 255.0f, Vec3(68, 1, 84));
    EXPECT_EQ(map_srgb(ColorMap::Viridis, 1.0f) * 255.0f, Vec3(253, 231, 37));
    EXPECT_EQ(map_srgb(ColorMap::Cividis, 0.0f) * 255.0f, Vec3(0, 34, 78));
    EXPECT_EQ(map_srgb(ColorMap::Batlow, 1.0f) * 255.0f, Vec3(250, 204, 250));
    EXPECT_LT(glm::distance(map_srgb(ColorMap::Viridis, 0.5f) * 255.0f, Vec3(33, 145, 140)), 2.0f);
}

TEST(ColorMap, ClampsAndTakesNan) {
    for (const ColorMap map : {ColorMap::Viridis, ColorMap::Cividis, ColorMap::Batlow}) {
        EXPECT_EQ(map_srgb(map, -1.0f), map_srgb(map, 0.0f));
        EXPECT_EQ(map_srgb(map, 2.0f), map_srgb(map, 1.0f));
        EXPECT_EQ(map_srgb(map, std::numeric_limits<float>::quiet_NaN()), map_srgb(map, 0.0f));
    }
}

TEST(ColorMap, BrightnessRisesAllAlong) {
    for (const ColorMap map : {ColorMap::Viridis, ColorMap::Cividis, ColorMap::Batlow}) {
        for (int i = 0; i < 100; ++i) {
            const float from = static_cast<float>(i) / 100.0f, to = static_cast<float>(i + 1) / 100.0f;
            EXPECT_LE(luminance(map_linear(map, from)), luminance(map_linear(map, to)) + 1e-3f)
                << kColorMapNames[static_cast<size_t>(map)] << " at " << from;
        }
    }
}

TEST(Palette, NeighboursDiffer) {
    for (uint32_t i = 0; i < 40; ++i) {
        EXPECT_GT(glm::distance(palette_srgb(i), palette_srgb(i + 1)), 0.3f) << i;
        EXPECT_GT(glm::distance(palette_srgb(i), palette_srgb(i + 8)), 0.15f) << i;
    }
}

TEST(ValueScale, LinearAndLogarithmic) {
    const ValueScale linear{10.0, 30.0, false};
    EXPECT_FLOAT_EQ(linear.position(15.0), 0.25f);
    EXPECT_DOUBLE_EQ(linear.value(0.25), 15.0);
    EXPECT_EQ(linear.position(9.0), 0.0f);
    EXPECT_EQ(linear.position(31.0), 1.0f);
    EXPECT_EQ(linear.position(std::nan("")), 0.0f);
    const ValueScale logarithmic{1.0, 10000.0, true};
    EXPECT_FLOAT_EQ(logarithmic.position(10.0), 0.25f);
    EXPECT_NEAR(logarithmic.value(0.5), 100.0, 1e-9);
    EXPECT_EQ(logarithmic.position(0.0), 0.0f);
}

TEST(ValueScale, WithoutExtentStillAnswers) {
    const ValueScale flat{5.0, 5.0, false};
    EXPECT_EQ(flat.position(5.0), 0.0f);
    EXPECT_EQ(flat.position(6.0), 1.0f);
}

}  // namespace
}  // namespace boxwood
