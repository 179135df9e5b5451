#include "app/viewer/tree_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "app/viewer/level_report.h"
#include "tests/support/all_recipes.h"
#include "tests/support/random_mesh.h"

namespace boxwood {
namespace {

std::shared_ptr<const Built> built_of(const std::string& recipe) {
    return std::make_shared<const Built>(run(recipe, random_triangles(200, 0.3f, 11)));
}

Measure find(const std::vector<Measure>& measures, const std::string& key) {
    return *std::ranges::find_if(measures, [&](const Measure& m) { return m.key == key; });
}

TEST(TreeWork, MeasuresWhatIsShownOnceItMayAndForgetsItWithTheStructure) {
    const auto built = built_of("bvh-binned-sah");
    TreeWork work;
    work.update(built, /*may_start=*/false);
    EXPECT_TRUE(work.busy());
    EXPECT_FALSE(work.progress().running);
    work.update(built, true);
    work.wait();
    work.update(built, true);
    EXPECT_FALSE(work.busy());
    ASSERT_NE(work.measures(), nullptr);
    Task task;
    EXPECT_EQ(work.measures()->end_points.total,
              end_point_overlap(built->levels->list, built->scene->mesh, task).total);
    EXPECT_EQ(work.measures()->leaf_counts.deviation,
              count_leaves_on_lines(built->levels->list, task).deviation);
    const auto measures = work.measures();
    work.update(built, true);
    EXPECT_EQ(work.measures(), measures);  // not done again
    work.update(nullptr, true);
    EXPECT_EQ(work.measures(), nullptr);
    EXPECT_FALSE(work.busy());
}

TEST(TreeQualities, SayWhatIsKnownAndWhyTheRestIsNot) {
    const TreeStats tree = tree_stats(*built_of("bvh-binned-sah")->levels);
    SlowMeasures slow;
    slow.end_points = {.total = 2.5, .levels = {0.5, 2.0}};
    slow.leaf_counts = {.mean = 7.0, .deviation = 3.25};
    const std::vector<Measure> known = tree_qualities(tree, &slow, {});
    EXPECT_EQ(find(known, "epo").value, 2.5);
    EXPECT_NE(find(known, "epo").tip.find("Here 2.5"), std::string::npos);
    EXPECT_EQ(find(known, "lcv").value, 3.25);
    EXPECT_EQ(find(known, "overlap").value, tree.sibling_overlap);
    EXPECT_EQ(find(known, "empty_volume").value, tree.empty_volume);
    EXPECT_EQ(find(known, "leaf_size_variation").value, tree.leaf_size_variation);

    const auto tip_of_unknown = [&](const SlowMeasures* of, const WorkProgress& progress) {
        const Measure epo = find(tree_qualities(tree, of, progress), "epo");
        EXPECT_FALSE(epo.value);
        return epo.tip;
    };
    EXPECT_NE(tip_of_unknown(nullptr, {}).find("once the ray-traced picture is done"), std::string::npos);
    EXPECT_NE(tip_of_unknown(nullptr, {.running = true, .share = 0.25}).find("25"), std::string::npos);
    const SlowMeasures undefined;
    EXPECT_NE(tip_of_unknown(&undefined, {}).find("Not defined"), std::string::npos);
}

TEST(LevelReport, HoldsEndPointOverlapAndEmptyVolumeOfEachLevel) {
    TreeStats tree;
    tree.levels.resize(2);
    tree.levels[1].empty_volume = 0.125;
    SlowMeasures slow;
    slow.end_points = {.total = 2.5, .levels = {0.5, 2.0}};
    EXPECT_EQ(level_tsv(tree, &slow),
              "level\tnodes\tleaves\treferences\tcost_share\tepo\toverlap\tempty_volume\n"
              "0\t0\t0\t0\t0\t0.5\t0\t0\n1\t0\t0\t0\t0\t2\t0\t0.125\n");
    EXPECT_NE(level_json(tree, nullptr).find("\"epo\": null"), std::string::npos);
}

}  // namespace
}  // namespace boxwood
