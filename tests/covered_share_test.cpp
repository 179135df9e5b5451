#include "core/measure/covered_share.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/rng.h"

namespace boxwood {
namespace {

const Box kCube{Vec3(0), Vec3(4)};  // volume 64

double share(const Box& box, const std::vector<Box>& parts) { return covered_share(box, parts); }

TEST(CoveredShare, OfTwoBoxesCountsWhatTheyShareOnce) {
    // 2 x 4 x 4 and 3 x 4 x 4 with 1 x 4 x 4 in common: all of it; then 2^3 and 2^3 with 1 in common.
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(0), {2, 4, 4}}, {{1, 0, 0}, {4, 4, 4}}}), 1.0);
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(0), Vec3(2)}, {Vec3(1), Vec3(3)}}), 15.0 / 64.0);
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(0), Vec3(1)}, {Vec3(3), Vec3(4)}}), 2.0 / 64.0);
}

TEST(CoveredShare, OfOneThreeAndNoBoxes) {
    EXPECT_EQ(share(kCube, {}), 0.0);
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(1), Vec3(2)}}), 1.0 / 64.0);
    // Three cubes of 8 along the diagonal, each sharing 1 with the next: 24 - 2.
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(0), Vec3(2)}, {Vec3(1), Vec3(3)}, {Vec3(2), Vec3(4)}}), 22.0 / 64.0);
    EXPECT_DOUBLE_EQ(share(kCube, {kCube, kCube, kCube}), 1.0);
}

TEST(CoveredShare, LeavesOutWhatSticksOut) {
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(3), Vec3(9)}}), 1.0 / 64.0);
    EXPECT_DOUBLE_EQ(share(kCube, {{Vec3(5), Vec3(9)}, {Vec3(-9), {9, 9, -8}}}), 0.0);
}

TEST(CoveredShare, OfAFlatBoxIsOfItsAreaOfASegmentOfItsLength) {
    const Box square{{0, 7, 0}, {4, 7, 4}}, segment{{1, 1, 0}, {1, 1, 8}}, point{Vec3(2), Vec3(2)};
    EXPECT_DOUBLE_EQ(share(square, {{{0, 7, 0}, {4, 7, 1}}}), 0.25);
    EXPECT_DOUBLE_EQ(share(square, {{{0, 7, 0}, {4, 7, 1}}, {{0, 7, 0}, {2, 7, 2}}, {{0, 7, 0}, {1, 7, 1}}}),
                     6.0 / 16.0);
    EXPECT_DOUBLE_EQ(share({{0, 0, 7}, {4, 4, 7}}, {{{0, 0, 7}, {4, 1, 7}}}), 0.25);
    EXPECT_DOUBLE_EQ(share({{7, 0, 0}, {7, 4, 4}}, {{{7, 0, 0}, {7, 1, 4}}}), 0.25);
    EXPECT_DOUBLE_EQ(share(segment, {{{1, 1, 2}, {1, 1, 6}}}), 0.5);
    EXPECT_DOUBLE_EQ(share({{0, 1, 1}, {8, 1, 1}}, {{{2, 1, 1}, {6, 1, 1}}}), 0.5);
    EXPECT_EQ(share(point, {point}), 1.0);
    EXPECT_EQ(share(point, {point, point}), 1.0);
    EXPECT_EQ(share(point, {}), 0.0);
    EXPECT_EQ(share(Box{}, {kCube}), 0.0);
}

TEST(CoveredShare, OfEightRandomBoxesIsTheShareOfLatticeCellsInOne) {
    Rng rng(8);
    for (int round = 0; round < 50; ++round) {
        std::vector<Box> parts;
        for (int i = 0; i < 8; ++i) {
            Box box;
            for (int corner = 0; corner < 2; ++corner) {
                const auto x = rng.next_index(5), y = rng.next_index(5), z = rng.next_index(5);
                box.extend(Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
            }
            parts.push_back(box);
        }
        int inside = 0;
        for (int cell = 0; cell < 64; ++cell) {
            const Vec3 corner(static_cast<float>(cell % 4), static_cast<float>(cell / 4 % 4),
                              static_cast<float>(cell / 16));
            bool is_inside = false;
            for (const Box& part : parts)
                is_inside = is_inside || part.contains(Box{corner, corner + Vec3(1)});
            inside += is_inside ? 1 : 0;
        }
        EXPECT_NEAR(share(kCube, parts), inside / 64.0, 1e-12);
    }
}

}  // namespace
}  // namespace boxwood
