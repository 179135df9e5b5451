#include "core/render/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace boxwood {
namespace {

TEST(Image, BeginsOpaqueBlackWithRowZeroFirst) {
    Image image(3, 2);
    ASSERT_EQ(image.rgba.size(), 24u);
    image.pixel(1, 1)[0] = 7;
    EXPECT_EQ(image.rgba[4 * 4], 7);
    EXPECT_EQ(image.pixel(0, 0)[3], 255);
    EXPECT_EQ(image.pixel(0, 0)[0], 0);
}

TEST(SrgbByte, IsTheNearestByteOfTheStandardsFormula) {
    for (int i = 0; i <= 100000; ++i) {
        const double linear = i / 100000.0;
        const double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        const double scaled = encoded * 255.0;
        if (std::abs(scaled - std::floor(scaled) - 0.5) < 1e-3) continue;  // too near to the border to tell
        ASSERT_EQ(srgb_byte(static_cast<float>(linear)), static_cast<int>(std::lround(scaled))) << linear;
    }
}

TEST(SrgbByte, ComesBackFromEveryByte) {
    for (int i = 0; i < 256; ++i) EXPECT_EQ(srgb_byte(linear_from_srgb(static_cast<uint8_t>(i))), i);
}

TEST(SrgbByte, TakesWhatIsOutsideOfTheRange) {
    EXPECT_EQ(srgb_byte(-1.0f), 0);
    EXPECT_EQ(srgb_byte(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(srgb_byte(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(srgb_byte(std::nextafter(1.0f, 0.0f)), 255);
    EXPECT_EQ(linear_from_srgb(Vec3(0.0f, 1.0f, 2.0f)), Vec3(0.0f, 1.0f, 1.0f));
}

}  // namespace
}  // namespace boxwood
