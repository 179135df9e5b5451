#include "app/viewer/measures.h"

#include <gtest/gtest.h>

namespace boxwood {
namespace {

Measure measure(const char* key, Measure::Better better, std::optional<double> value) {
    return {.key = key, .name = key, .better = better, .value = value};
}

std::vector<MeasurePair> pairs() {
    using enum Measure::Better;
    return {{measure("sah_cost", Lower, 2.5), measure("sah_cost", Lower, 4.0)},
            {measure("rays_per_second", Higher, 100.0), measure("rays_per_second", Higher, 300.0)},
            {measure("levels", Neither, 7.0), measure("levels", Neither, 9.0)},
            {measure("nodes", Lower, 5.0), measure("nodes", Lower, 5.0)},
            {measure("build_ms", Lower, 1.0), measure("build_ms", Lower, std::nullopt)}};
}

TEST(Measures, TheBetterSideFollowsFromTheMeasure) {
    const std::vector<MeasurePair> all = pairs();
    EXPECT_EQ(all[0].difference(), -1.5);
    EXPECT_EQ(all[0].winner(), Side::A) << "lower is better";
    EXPECT_EQ(all[1].winner(), Side::B) << "higher is better";
    EXPECT_EQ(all[2].winner(), std::nullopt) << "neither is better";
    EXPECT_EQ(all[3].winner(), std::nullopt) << "equal";
    EXPECT_EQ(all[4].difference(), std::nullopt) << "not known";
    EXPECT_EQ(all[4].winner(), std::nullopt);
}

TEST(Measures, OnlyWhatBothHaveIsPaired) {
    using enum Measure::Better;
    const std::vector<MeasurePair> all =
        pairs_of({measure("nodes", Lower, 1.0), measure("bytes", Lower, 2.0)},
                 {measure("bytes", Lower, 3.0), measure("leaves", Neither, 4.0)});
    ASSERT_EQ(all.size(), 1u);
    EXPECT_STREQ(all[0].a.key, "bytes");
    EXPECT_EQ(all[0].difference(), -1.0);
}

TEST(Measures, AreCopiedForOtherPrograms) {
    EXPECT_EQ(measures_tsv(pairs()),
              "measure\ta\tb\tdifference\n"
              "sah_cost\t2.5\t4\t-1.5\n"
              "rays_per_second\t100\t300\t-200\n"
              "levels\t7\t9\t-2\n"
              "nodes\t5\t5\t0\n"
              "build_ms\t1\t\t\n");
    EXPECT_EQ(measures_markdown(pairs()).substr(0, 85),
              "| measure | a | b | difference |\n|:---|---:|---:|---:|\n| sah_cost | 2.5 | 4 | -1.5 |\n");
    const std::string json = measures_json(pairs(), "bvh-sweep-sah", "auto");
    EXPECT_NE(json.find("\"a\": \"bvh-sweep-sah\""), std::string::npos) << json;
    EXPECT_NE(json.find("\"difference\": -1.5"), std::string::npos) << json;
    EXPECT_NE(json.find("\"b\": null"), std::string::npos) << json;
}

TEST(Measures, AreShownWithTheirSign) {
    using Unit = Measure::Unit;
    EXPECT_EQ(measure_text(Unit::Count, -12345.0), "\u221212,345");
    EXPECT_EQ(measure_text(Unit::Bytes, 2048.0), "2.00 KiB");
    EXPECT_EQ(measure_text(Unit::Milliseconds, -0.25), "\u22120.2 ms");
    EXPECT_EQ(measure_text(Unit::Share, 0.5), "50.0 %");
    EXPECT_EQ(measure_text(Unit::Number, std::nullopt), "\u2013");
}

}  // namespace
}  // namespace boxwood
