#include "core/catalog/pipeline.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "tests/support/test_stages.h"

namespace boxwood {
namespace {

std::shared_ptr<const Scene> small_scene(uint64_t hash = 1) {
    auto scene = std::make_shared<Scene>();
    Rng rng(hash);
    for (uint32_t i = 0; i < 100; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const float x = rng.next(), y = rng.next(), z = rng.next();
            scene->mesh.positions.push_back({x, y, z});
        }
        scene->mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        scene->mesh.source_prim.push_back(i);
        scene->mesh.object.push_back(0);
    }
    scene->mesh.objects.push_back({"all", Vec3(0.8f)});
    scene->content_hash = hash;
    return scene;
}

Recipe test_recipe(const std::string& text) { return parse_recipe(text, kTestCatalog); }

std::shared_ptr<const StageResult> result_of_bytes(size_t byte_count) {
    auto result = std::make_shared<StageResult>();
    result->byte_count = byte_count;
    return result;
}

TEST(RunRecipe, ASecondRunOfTheSameRecipeRunsNothing) {
    StageCache cache;
    Task task;
    const auto scene = small_scene();
    const auto first = run_recipe(test_recipe("copies > bvh-binned-sah > same"), scene, cache, task, true);
    EXPECT_EQ(cache.run_count(), 4u);  // references, builder, transform, levels
    const auto second = run_recipe(test_recipe("copies(copies=2) > bvh-binned-sah(bins=16) > same"), scene,
                                   cache, task, true);
    EXPECT_EQ(cache.run_count(), 4u);
    EXPECT_EQ(first->references, second->references);
    EXPECT_EQ(first->levels, second->levels);
    EXPECT_EQ(first->structure.as<Bvh2>(), second->structure.as<Bvh2>());
    EXPECT_EQ(first->references_ms, second->references_ms);
    EXPECT_EQ(first->build_ms, second->build_ms);
}

TEST(RunRecipe, AChangeRunsTheStagesFromThereOn) {
    StageCache cache;
    Task task;
    const auto scene = small_scene();
    run_recipe(test_recipe("copies > bvh-binned-sah > same"), scene, cache, task);
    const uint64_t before = cache.run_count();
    run_recipe(test_recipe("copies > bvh-binned-sah > same(rounds=2)"), scene, cache, task);
    EXPECT_EQ(cache.run_count() - before, 1u);  // the transform
    run_recipe(test_recipe("copies > bvh-binned-sah(bins=8) > same"), scene, cache, task);
    EXPECT_EQ(cache.run_count() - before, 3u);  // builder and transform
    run_recipe(test_recipe("copies(copies=3) > bvh-binned-sah > same"), scene, cache, task);
    EXPECT_EQ(cache.run_count() - before, 6u);  // all
    run_recipe(test_recipe("copies > bvh-binned-sah > same"), scene, cache, task);
    EXPECT_EQ(cache.run_count() - before, 6u);  // back: nothing
    run_recipe(test_recipe("copies > bvh-binned-sah > same"), small_scene(2), cache, task);
    EXPECT_EQ(cache.run_count() - before, 9u);  // another scene: all
}

TEST(RunRecipe, TheSameReferencesByAnotherThresholdAreNotBuiltAgain) {
    StageCache cache;
    Task task;
    const auto scene = small_scene();
    const auto one = run_recipe(test_recipe("copies(copies=1) > bvh-binned-sah"), scene, cache, task, true);
    const uint64_t before = cache.run_count();
    const auto other =
        run_recipe(test_recipe("copies(copies=1, clip=on) > bvh-binned-sah"), scene, cache, task, true);
    EXPECT_EQ(cache.run_count() - before, 1u);  // the references
    EXPECT_EQ(one->levels, other->levels);
    EXPECT_EQ(print(other->recipe), "copies(copies=1, clip=on) > bvh-binned-sah");
}

TEST(RunRecipe, LevelsAreMadeWhenTheyAreFirstAskedFor) {
    StageCache cache;
    Task task;
    const auto scene = small_scene();
    EXPECT_EQ(run_recipe(test_recipe("bvh-binned-sah"), scene, cache, task)->levels, nullptr);
    EXPECT_EQ(cache.run_count(), 2u);
    EXPECT_NE(run_recipe(test_recipe("bvh-binned-sah"), scene, cache, task, true)->levels, nullptr);
    EXPECT_EQ(cache.run_count(), 3u);
}

TEST(RunRecipe, WhatStagesSkippedIsKeptWithTheirResults) {
    StageCache cache;
    const auto scene = small_scene();
    const std::map<std::string, uint64_t> expected = {{"weighed as light", 7}, {"already good", 6}};
    for (int run = 0; run < 2; ++run) {
        Task task;
        task.skipped.add("by another one", 5);
        const auto built =
            run_recipe(test_recipe("copies > bvh-binned-sah > same > same"), scene, cache, task);
        for (const auto& [reason, count] : expected) EXPECT_EQ(built->skipped.at(reason), count) << run;
        EXPECT_FALSE(built->skipped.contains("by another one"));
    }
}

TEST(RunRecipe, AStopGivesNothingAndKeepsNothing) {
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    StageCache cache;
    EXPECT_FALSE(run_recipe(test_recipe("copies > bvh-binned-sah"), small_scene(), cache, task).has_value());
    EXPECT_EQ(cache.run_count(), 0u);
    EXPECT_EQ(cache.byte_count(), 0u);
}

TEST(RunRecipe, ReferencesCountBeforeTheStructureRemovesDuplicates) {
    StageCache cache;
    Task task;
    const auto built = run_recipe(test_recipe("copies(copies=3) > none"), small_scene(), cache, task, true);
    EXPECT_EQ(built->references->refs.size(), 300u);
    EXPECT_EQ(built->levels->list.ref_prims.size(), 100u);
}

TEST(StageCache, TheLeastRecentlyUsedGoesFirst) {
    StageCache cache(100);
    cache.put("a", result_of_bytes(40));
    cache.put("b", result_of_bytes(40));
    EXPECT_NE(cache.find("a"), nullptr);
    cache.put("c", result_of_bytes(40));
    EXPECT_EQ(cache.find("b"), nullptr);
    EXPECT_NE(cache.find("a"), nullptr);
    EXPECT_NE(cache.find("c"), nullptr);
    EXPECT_EQ(cache.byte_count(), 80u);
}

TEST(StageCache, NeverHoldsMoreThanItsBytes) {
    StageCache cache(100);
    cache.put("a", result_of_bytes(60));
    cache.put("whole", result_of_bytes(101));
    EXPECT_EQ(cache.find("whole"), nullptr);
    EXPECT_NE(cache.find("a"), nullptr);
    cache.put("a", result_of_bytes(100));
    EXPECT_EQ(cache.byte_count(), 100u);
    cache.clear();
    EXPECT_EQ(cache.byte_count(), 0u);
    EXPECT_EQ(cache.find("a"), nullptr);
    EXPECT_EQ(cache.run_count(), 3u);
}

}  // namespace
}  // namespace boxwood
