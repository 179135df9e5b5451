#include "core/render/image_compare.h"

#include <gtest/gtest.h>

namespace boxwood {
namespace {

TEST(CompareImages, EqualPicturesDoNotDiffer) {
    const Comparison c = compare_images(Image(20, 20), Image(20, 20));
    EXPECT_TRUE(c.same_size);
    EXPECT_EQ(c.different_pixels, 0u);
    EXPECT_EQ(c.largest_difference, 0);
    EXPECT_EQ(c.largest_tile_mean, 0.0);
}

TEST(CompareImages, AnotherSizeIsNamed) {
    EXPECT_FALSE(compare_images(Image(20, 20), Image(20, 21)).same_size);
    EXPECT_FALSE(compare_images(Image(20, 20), Image(21, 20)).same_size);
}

TEST(CompareImages, CountsPixelsBeyondTheThresholdByTheirWorstChannel) {
    const Image reference(40, 20);
    Image result = reference;
    result.pixel(1, 1)[0] = 3;    // not beyond
    result.pixel(2, 1)[1] = 4;    // beyond
    result.pixel(3, 1)[3] = 155;  // alpha counts: 100
    const Comparison c = compare_images(reference, result);
    EXPECT_EQ(c.different_pixels, 2u);
    EXPECT_EQ(c.largest_difference, 100);
    EXPECT_DOUBLE_EQ(c.largest_tile_mean, (3.0 + 4.0 + 100.0) / 256.0);
    EXPECT_EQ(compare_images(reference, result, 2).different_pixels, 3u);
}

TEST(CompareImages, AveragesATileAtTheBorderOverItsOwnPixels) {
    const Image reference(40, 20);
    Image result = reference;
    result.pixel(39, 19)[2] = 64;  // in the tile of 8 x 4 pixels at (32, 16)
    result.pixel(0, 0)[2] = 255;   // in a whole tile: 255 / 256
    const Comparison c = compare_images(reference, result);
    EXPECT_DOUBLE_EQ(c.largest_tile_mean, 64.0 / 32.0);
    EXPECT_EQ(c.worst_tile_x, 32);
    EXPECT_EQ(c.worst_tile_y, 16);
}

TEST(CompareImages, TheDifferenceImageShowsEvenOneStep) {
    const Image reference(16, 16);
    Image result = reference;
    result.pixel(5, 6)[0] = 1;
    result.pixel(7, 8)[0] = 9;
    const Comparison c = compare_images(reference, result);
    EXPECT_GT(c.difference.pixel(5, 6)[0], c.difference.pixel(4, 6)[0] + 50);
    EXPECT_EQ(c.difference.pixel(5, 6)[1], 0);   // red: within the threshold
    EXPECT_GT(c.difference.pixel(7, 8)[1], 50);  // towards yellow: counted
}

}  // namespace
}  // namespace boxwood
