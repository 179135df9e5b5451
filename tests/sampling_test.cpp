#include "core/base/sampling.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace boxwood {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(SinCosOfTurn, AgreesWithTheLibrary) {
    for (int i = 0; i <= 20000; ++i) {
        const double turns = i / 20000.0;
        const SinCos own = sin_cos_of_turn(turns);
        ASSERT_NEAR(own.sine, std::sin(2.0 * kPi * turns), 1e-12) << turns;
        ASSERT_NEAR(own.cosine, std::cos(2.0 * kPi * turns), 1e-12) << turns;
    }
}

TEST(SinCosOfTurn, QuartersAreExact) {
    EXPECT_EQ(sin_cos_of_turn(0.25).sine, 1.0);
    EXPECT_EQ(sin_cos_of_turn(0.25).cosine, 0.0);
    EXPECT_EQ(sin_cos_of_turn(0.5).cosine, -1.0);
    EXPECT_EQ(sin_cos_of_turn(0.75).sine, -1.0);
}

// Every compiler must give these bits: pictures are compared with those of other machines.
TEST(Sampling, BitsArePinned) {
    EXPECT_EQ(std::bit_cast<uint64_t>(sin_cos_of_turn(0.1).sine), 0x3fe2cf2304755a64ull);
    EXPECT_EQ(std::bit_cast<uint64_t>(sin_cos_of_turn(0.1).cosine), 0x3fe9e3779b97f4a8ull);
    const Vec2 point = sequence_point(12345, 6, 1);
    EXPECT_EQ(std::bit_cast<uint32_t>(point.x), 0x3ecd9fe8u);
    EXPECT_EQ(std::bit_cast<uint32_t>(point.y), 0x3f54cdb2u);
    const DVec3 direction = cosine_direction(DVec3(0.6, 0.0, 0.8), Vec2(0.25f, 0.4f));
    EXPECT_EQ(std::bit_cast<uint64_t>(direction.x), 0x3fc916cdee91afaeull);
    EXPECT_EQ(std::bit_cast<uint64_t>(direction.z), 0x3fedefd305b30ee4ull);
}

TEST(PixelOffset, BeginsAtTheCentreAndCoversThePixel) {
    double sum_x = 0.0, sum_y = 0.0;
    int cells[4][4] = {};
    for (uint32_t sample = 0; sample < 64; ++sample) {
        const Vec2 offset = pixel_offset(77, sample);
        ASSERT_GE(std::min(offset.x, offset.y), 0.0f);
        ASSERT_LT(std::max(offset.x, offset.y), 1.0f);
        ++cells[static_cast<int>(offset.y * 4.0f)][static_cast<int>(offset.x * 4.0f)];
        sum_x += static_cast<double>(offset.x);
        sum_y += static_cast<double>(offset.y);
    }
    EXPECT_EQ(pixel_offset(77, 0), Vec2(0.5f));
    EXPECT_NEAR(sum_x / 64.0, 0.5, 0.02);
    EXPECT_NEAR(sum_y / 64.0, 0.5, 0.02);
    for (const auto& row : cells)
        for (const int count : row) EXPECT_TRUE(count >= 2 && count <= 6) << count;
}

TEST(SequencePoint, DiffersByPixelAndBounce) {
    EXPECT_NE(sequence_point(1, 3, 1), sequence_point(2, 3, 1));
    EXPECT_NE(sequence_point(1, 3, 1), sequence_point(1, 3, 2));
}

TEST(CosineDirection, HasUnitLengthOnTheNormalsSideAndTheRightMoments) {
    const DVec3 normals[] = {{0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}, {-0.36, 0.48, -0.8}};
    for (const DVec3& normal : normals) {
        constexpr uint32_t kCount = 10000;
        DVec3 sum(0.0);
        double sum_of_squares = 0.0;
        for (uint32_t i = 0; i < kCount; ++i) {
            const DVec3 d = cosine_direction(normal, sequence_point(5, i, 1));
            ASSERT_NEAR(glm::length(d), 1.0, 1e-9);
            ASSERT_GE(glm::dot(d, normal), 0.0);
            sum += d;
            sum_of_squares += glm::dot(d, normal) * glm::dot(d, normal);
        }
        // With density cosine / pi the mean direction is 2/3 normal, and the mean squared cosine 1/2.
        EXPECT_LT(glm::distance(sum / double{kCount}, normal * (2.0 / 3.0)), 2e-3);
        EXPECT_NEAR(sum_of_squares / kCount, 0.5, 2e-3);
    }
}

}  // namespace
}  // namespace boxwood
