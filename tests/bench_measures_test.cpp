#include "bench/measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/correlation.h"

namespace boxwood::bench {
namespace {

MeasuredStructure measured(const std::string& family, double sah_cost, double epo, double ns) {
    MeasuredStructure s;
    s.recipe = s.family = family;
    s.is_built = true;
    s.sah_cost = sah_cost;
    s.measures = {.epo = epo,
                  .leaf_count_deviation = 1.0,
                  .sibling_overlap = 0.0,
                  .empty_volume = 0.5,
                  .leaf_size_variation = 0.1 * sah_cost,
                  .primary_steps = 1.0 / sah_cost,
                  .diffuse_steps = sah_cost};
    s.primary = {.rays = 1000, .ms = {ns * 1e-3}};
    s.diffuse = s.primary;
    return s;
}

const Prediction& find(const std::vector<Prediction>& all, Group group, TimedRays kind, Measure measure) {
    return *std::ranges::find_if(
        all, [&](const Prediction& p) { return p.group == group && p.kind == kind && p.measure == measure; });
}

TEST(Predictions, AreOfLogarithmsWithinAScene) {
    // In both scenes time doubles with the cost; the second one is a hundred times as fast for its costs,
    // which between scenes would hide it.
    const std::vector<MeasuredScene> scenes{
        {"a",
         {measured("binary BVH", 1, 3, 800), measured("binary BVH", 2, 2, 1600),
          measured("binary BVH", 4, 1, 3200)}},
        {"b",
         {measured("binary BVH", 8, 1, 64), measured("binary BVH", 16, 4, 128),
          measured("binary BVH", 32, 2, 256)}}};
    const std::vector<Prediction> all = predictions(scenes);
    EXPECT_EQ(all.size(), 3 * 2 * kMeasureCount);
    const auto of = [&](Measure measure, TimedRays kind = TimedRays::Primary) {
        return find(all, Group::BinaryBvh, kind, measure);
    };
    EXPECT_NEAR(of(Measure::SahCost).pearson, 1.0, 1e-12);
    EXPECT_NEAR(of(Measure::SahCost).spearman, 1.0, 1e-12);
    EXPECT_EQ(of(Measure::SahCost).scenes, 2u);
    EXPECT_EQ(of(Measure::SahCost).points, 6u);
    EXPECT_NEAR(of(Measure::Epo).spearman, 0.5 * (-1.0 + 0.5), 1e-12);
    EXPECT_NEAR(of(Measure::Epo).spearman_worst, -1.0, 1e-12);
    EXPECT_NEAR(of(Measure::Steps).pearson, -1.0, 1e-12);
    EXPECT_NEAR(of(Measure::Steps, TimedRays::Diffuse).pearson, 1.0, 1e-12);
    EXPECT_TRUE(std::isnan(of(Measure::LeafCounts).pearson));  // it does not vary
    EXPECT_EQ(of(Measure::Overlap).points, 0u);                // no logarithm of 0
    EXPECT_EQ(of(Measure::SahAndEpo).alpha, 0.0);
    EXPECT_NEAR(of(Measure::SahAndEpo).pearson, 1.0, 1e-12);
}

TEST(Predictions, TheWeightOfAnySceneComesFromTheOthers) {
    // In scene a the time is the SAH cost, in b and c it is EPO: a gets the weight 1 that b and c ask for.
    const auto scene = [](const char* name, const std::vector<double>& times) {
        return MeasuredScene{name,
                             {measured("binary BVH", 1, 2, times[0]), measured("binary BVH", 2, 7, times[1]),
                              measured("binary BVH", 9, 1, times[2])}};
    };
    const std::vector<MeasuredScene> scenes{scene("a", {1, 2, 9}), scene("b", {2, 7, 1}),
                                            scene("c", {2, 7, 1})};
    const std::vector<Prediction> all = predictions(scenes);
    const Prediction& p = find(all, Group::BinaryBvh, TimedRays::Primary, Measure::SahAndEpo);
    EXPECT_GT(p.alpha, 0.5);
    EXPECT_NEAR(p.spearman_worst, spearman(std::vector<double>{2, 7, 1}, std::vector<double>{1, 2, 9}),
                1e-12);
}

TEST(Predictions, OfFastTreesLeaveOutThoseThatTakeMoreThanHalfAsLongAgain) {
    const std::vector<MeasuredScene> scenes{
        {"a",
         {measured("binary BVH", 1, 1, 100), measured("binary BVH", 2, 2, 140),
          measured("binary BVH", 3, 3, 149), measured("binary BVH", 4, 4, 151)}}};
    const std::vector<Prediction> all = predictions(scenes);
    EXPECT_EQ(find(all, Group::FastBvh, TimedRays::Primary, Measure::SahCost).points, 3u);
    EXPECT_EQ(find(all, Group::BinaryBvh, TimedRays::Primary, Measure::SahCost).points, 4u);
}

TEST(Predictions, LeaveOutOtherLayoutsListsAndWhatHasNoMeasureAndTakeEachTreeOnce) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<MeasuredStructure> structures{
        measured("binary BVH", 1, 1, 10), measured("binary BVH", 2, 2, 20),
        measured("binary BVH", 3, 3, 30), measured("binary BVH", 3, 3, 35),
        measured("kd-tree", 4, 4, 5),     measured("sphere BVH", 5, kNone, 1),
        measured("list", 6, 6, 1)};
    structures.back().is_list = true;
    const std::vector<Prediction> all = predictions(std::vector<MeasuredScene>{{"a", structures}});
    const auto points = [&](Group group) {
        return find(all, group, TimedRays::Diffuse, Measure::SahCost).points;
    };
    EXPECT_EQ(points(Group::BinaryBvh), 3u);
    EXPECT_EQ(points(Group::Boxes), 4u);
}

TEST(RecipesToMeasure, TakeEveryRowOfTheCatalogButListsSlowBuildersAndFrames) {
    const std::vector<Recipe> recipes = recipes_to_measure(1000000);
    const auto has = [&](const char* id) {
        return std::ranges::any_of(recipes, [&](const Recipe& r) {
            const std::string text = print(r);
            return (" " + text + " ").find(std::string(" ") + id + " ") != std::string::npos;
        });
    };
    for (const char* id : {"bvh-sweep-sah", "grid", "kd-sah", "esc", "evh", "refine", "ropes", "lsc"})
        EXPECT_TRUE(has(id)) << id;
    for (const char* id : {"none", "bsp", "refit"}) EXPECT_FALSE(has(id)) << id;
}

TEST(MeasureStructures, MeasuresTreesAndCountsStepsWhereAskedTo) {
    Task task;
    const auto scene = open_scene("cornell", task);
    StructureSettings settings;
    settings.camera = scene->camera.value_or(fit_camera(scene->mesh.bounds()));
    settings.ray_count = 100;
    settings.builds = 1;
    settings.rates = {.rounds = 1, .round_ms = 0.2};
    settings.recipes = {parse_recipe("bvh-sweep-sah"), parse_recipe("bvh-sweep-sah > spheres")};
    settings.with_measures = true;
    const std::vector<MeasuredStructure> rows = measure_structures(scene, settings, task);
    EXPECT_GT(rows[0].measures.epo, 0.0);
    EXPECT_GT(rows[0].measures.leaf_count_deviation, 0.0);
    EXPECT_GT(rows[0].measures.primary_steps, 1.0);
    EXPECT_GT(rows[0].measures.diffuse_steps, 1.0);
    EXPECT_TRUE(std::isnan(rows[1].measures.epo));
}

}  // namespace
}  // namespace boxwood::bench
