#include "bench/lecture.h"

#include <gtest/gtest.h>

#include "support/random_mesh.h"

namespace boxwood::bench {
namespace {

/// A structure whose rates are `mrays` for both kinds of rays.
MeasuredStructure lecture_row(const std::string& family, uint64_t bytes, double build_ms, double mrays) {
    MeasuredStructure s;
    s.recipe = family;
    s.family = family;
    s.is_list = family == "list";
    s.is_built = true;
    s.bytes = bytes;
    s.build_ms = build_ms;
    s.primary = {.rays = 1000, .ms = {1.0 / mrays, 1.0 / mrays, 1.0 / mrays}};
    s.diffuse = s.primary;
    return s;
}

/// By hand, for 100 triangles: 3600 bytes of corners, the fastest build takes 10 ms, the best rate is 10.
TEST(Lecture, WordsComeFromRatiosToTheTrianglesTheFastestBuildAndTheBestRate) {
    const std::vector<MeasuredStructure> structures = {
        lecture_row("list", 400, 1.0, 0.1),  // 0.11 of the corners, 0.1 of the build, 0.01 of the rate
        lecture_row("uniform grid", 10800, 10.0, 3.0),  // 3 times, 1, 0.3
        lecture_row("kd-tree", 36000, 90.0, 7.0),       // 10 times, 9 times, 0.7
        lecture_row("binary BVH", 3600, 40.0, 10.0),    // 1, 4 times, 1
        lecture_row("something else", 3600, 40.0, 1.0)};
    const std::vector<LectureRow> rows = judge_lecture(structures, 100, /*is_uniform=*/false);
    ASSERT_EQ(rows.size(), 5u);
    const auto expect = [](const LectureWord& word, const char* measured, const char* lecture,
                           const char* verdict) {
        EXPECT_EQ(word.measured, measured);
        EXPECT_EQ(word.lecture, lecture);
        EXPECT_EQ(word.verdict, verdict);
    };
    expect(rows[0].memory, "none", "none", "yes");
    expect(rows[0].build, "none", "none", "yes");
    expect(rows[0].traversal, "abysmal", "abysmal", "yes");
    expect(rows[1].memory, "low", "low - high (resolution)", "yes");
    expect(rows[1].build, "low", "low", "yes");
    expect(rows[1].traversal, "ok", "poor (otherwise)", "better");
    expect(rows[2].memory, "high", "low - high (overlap)", "yes");
    expect(rows[2].build, "high", "low - high", "yes");
    expect(rows[2].traversal, "good", "good - excellent", "yes");
    expect(rows[3].memory, "low", "low", "yes");
    expect(rows[3].build, "low", "low - high", "yes");
    expect(rows[3].traversal, "excellent", "good - excellent", "yes");
    expect(rows[4].memory, "low", "", "");
    expect(rows[4].traversal, "poor", "", "");
    expect(judge_lecture(structures, 100, true)[1].traversal, "ok", "ok (uniform)", "yes");
}

TEST(Lecture, WordsThatNumbersDoNotBearOutAreWorseOrBetter) {
    const std::vector<MeasuredStructure> structures = {lecture_row("list", 40000, 1.0, 0.5),
                                                       lecture_row("binary BVH", 36000, 10.0, 10.0),
                                                       lecture_row("octree", 100, 41.0, 1.0)};
    const std::vector<LectureRow> rows = judge_lecture(structures, 100, true);
    EXPECT_EQ(rows[0].memory.verdict, "worse");      // not none but high
    EXPECT_EQ(rows[0].traversal.verdict, "better");  // 0.05: poor, not abysmal
    EXPECT_EQ(rows[1].memory.verdict, "worse");      // not low
    EXPECT_EQ(rows[2].memory.verdict, "better");     // none for low - high
    EXPECT_EQ(rows[2].build.verdict, "worse");       // 4.1 times the fastest that is no list
    EXPECT_EQ(rows[2].traversal.verdict, "worse");   // 0.1: poor, not good
}

TEST(Lecture, AStructureThatWasNotBuiltHasNoWordsAndCountsForNone) {
    std::vector<MeasuredStructure> structures = {lecture_row("binary BVH", 3600, 10.0, 1.0),
                                                 lecture_row("kd-tree", 3600, 0.1, 99.0)};
    structures[1].is_built = false;
    const std::vector<LectureRow> rows = judge_lecture(structures, 100, true);
    EXPECT_EQ(rows[0].traversal.measured, "excellent");
    EXPECT_EQ(rows[0].build.measured, "low");
    EXPECT_EQ(rows[1].memory.measured, "");
    EXPECT_EQ(rows[1].traversal.verdict, "");
}

TEST(Lecture, ClusteringIsAboutOneForASurfaceAndLargeForATeapotInAStadium) {
    Task task;
    EXPECT_EQ(clustering(Mesh{}), 0.0);
    const double surface = clustering(open_scene("terrain@tris=20k", task)->mesh);
    EXPECT_LT(surface, kUniformClustering);
    EXPECT_GT(surface, 0.05);
    // The same for any number of triangles, roughly.
    EXPECT_NEAR(clustering(open_scene("terrain@tris=80k", task)->mesh) / surface, 1.0, 0.35);
    EXPECT_LT(clustering(random_triangles(8000, 0.01f, 1)), kUniformClustering);
    Mesh stadium = random_triangles(8000, 0.01f, 1);
    for (size_t i = 3; i < stadium.positions.size(); ++i) stadium.positions[i] *= 0.001f;
    EXPECT_GT(clustering(stadium), 100.0);
    EXPECT_GT(clustering(open_scene("kitchen", task)->mesh), kUniformClustering);
}

TEST(Lecture, TheRuleIsPrintedWithItsNumbers) {
    LectureRule rule;
    rule.low_memory = 7.25;
    rule.excellent = 0.875;
    EXPECT_NE(rule_text(rule).find("low up to 7.25"), std::string::npos) << rule_text(rule);
    EXPECT_NE(rule_text(rule).find("good up to 0.875"), std::string::npos) << rule_text(rule);
}

}  // namespace
}  // namespace boxwood::bench
