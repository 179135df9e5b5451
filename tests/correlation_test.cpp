#include "bench/correlation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace boxwood::bench {
namespace {

using Values = std::vector<double>;

double pearson_of(const Values& x, const Values& y) { return pearson(x, y); }
double spearman_of(const Values& x, const Values& y) { return spearman(x, y); }

TEST(Correlation, OfFourPairsByHand) {
    // Differences to the means: -1.5 -0.5 0.5 1.5 and -2 1 0 1: products 3 - 0.5 + 0 + 1.5 = 4, squares 5 and
    // 6. Ranks of y: 1, 3.5, 2, 3.5, whose differences are -1.5 1 -0.5 1: products 3, squares 5 and 4.5.
    EXPECT_NEAR(pearson_of({1, 2, 3, 4}, {0, 3, 2, 3}), 4.0 / std::sqrt(30.0), 1e-15);
    EXPECT_NEAR(spearman_of({1, 2, 3, 4}, {0, 3, 2, 3}), 3.0 / std::sqrt(22.5), 1e-15);
}

TEST(Correlation, OfRanksSeesAnyMonotonousRelationAndOfValuesALine) {
    EXPECT_DOUBLE_EQ(spearman_of({1, 2, 3, 4}, {1, 10, 100, 1e9}), 1.0);
    EXPECT_LT(pearson_of({1, 2, 3, 4}, {1, 10, 100, 1e9}), 0.8);
    EXPECT_DOUBLE_EQ(pearson_of({1, 2, 5}, {-2, -4, -10}), -1.0);
    EXPECT_DOUBLE_EQ(spearman_of({5, 1, 2}, {-10, -2, -4}), -1.0);
}

TEST(Correlation, IsUnknownForTwoPairsAndForWhatDoesNotVary) {
    EXPECT_TRUE(std::isnan(pearson_of({1, 2}, {1, 2})));
    EXPECT_TRUE(std::isnan(pearson_of({1, 2, 3}, {4, 4, 4})));
    EXPECT_TRUE(std::isnan(spearman_of({7, 7, 7}, {1, 2, 3})));
}

TEST(Ranks, OfEqualValuesAreTheirMean) {
    EXPECT_EQ(ranks(Values{30, 10, 20, 10}), (Values{4, 1.5, 3, 1.5}));
    EXPECT_EQ(ranks(Values{2, 2, 2}), (Values{2, 2, 2}));
    EXPECT_TRUE(ranks(Values{}).empty());
}

}  // namespace
}  // namespace boxwood::bench
