#include "core/catalog/pipeline.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
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

std::shared_ptr<const Scene> opened(const std::string& spec) {
    Task task;
    return open_scene(spec, task);
}

std::string refusal_of(const std::string& recipe, const std::string& spec) {
    StageCache cache;
    Task task;
    try {
        run_recipe(parse_recipe(recipe), opened(spec), cache, task);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage);
        return error.what();
    }
    return "";
}

TEST(InputOfAnotherFrame, IsKeptUnderBothFrames) {
    StageCache cache;
    Task task;
    const auto four = opened("kitchen@frame=4"), five = opened("kitchen@frame=5");
    const Recipe from_0 = parse_recipe("bvh-spatial-median > refit"),
                 from_1 = parse_recipe("bvh-spatial-median > refit(from=1)");
    const auto first = run_recipe(from_0, four, cache, task, true);
    EXPECT_EQ(cache.run_count(), 6u);  // frame 0, both frames' references, builder, refit, levels
    EXPECT_EQ(run_recipe(from_0, four, cache, task, true)->levels, first->levels);
    EXPECT_EQ(cache.run_count(), 6u);
    const auto later = run_recipe(from_0, five, cache, task, true);  // the tree of frame 0 is there
    EXPECT_EQ(cache.run_count(), 9u);
    EXPECT_NE(later->levels, first->levels);
    const auto other = run_recipe(from_1, four, cache, task, true);
    EXPECT_EQ(cache.run_count(), 14u);  // frame 1, its references, builder, refit, levels
    EXPECT_NE(other->levels, first->levels);
    EXPECT_NE(first->structure.as<Bvh2>()->nodes, later->structure.as<Bvh2>()->nodes);
    EXPECT_NE(first->structure.as<Bvh2>()->nodes, other->structure.as<Bvh2>()->nodes);
    run_recipe(from_0, four, cache, task, true);
    EXPECT_EQ(cache.run_count(), 14u);
    // Another builder before it is another tree.
    const auto swept = run_recipe(parse_recipe("bvh-binned-sah > refit"), four, cache, task, true);
    EXPECT_EQ(cache.run_count(), 17u);  // builder, refit, levels
    EXPECT_NE(swept->levels, first->levels);
    // A plain build of the frame shares the builder's result with a refit to that frame.
    const auto plain = run_recipe(parse_recipe("bvh-spatial-median"), opened("kitchen"), cache, task);
    EXPECT_EQ(cache.run_count(), 17u);
    const auto same = run_recipe(from_0, opened("kitchen"), cache, task);
    EXPECT_EQ(cache.run_count(), 18u);
    EXPECT_EQ(same->structure.as<Bvh2>()->nodes, plain->structure.as<Bvh2>()->nodes);
}

TEST(InputOfAnotherFrame, GoesThroughSeveralFrames) {
    StageCache cache;
    Task task;
    const auto scene = opened("kitchen@frame=9");
    const auto twice =
        run_recipe(parse_recipe("bvh-spatial-median > refit > refit(from=5)"), scene, cache, task);
    const auto once = run_recipe(parse_recipe("bvh-spatial-median > refit"), scene, cache, task);
    EXPECT_EQ(twice->structure.as<Bvh2>()->nodes, once->structure.as<Bvh2>()->nodes);
    // The same run of the builder, and what comes on top.
    const auto built = run_recipe(parse_recipe("bvh-spatial-median"), opened("kitchen"), cache, task);
    EXPECT_GT(once->build_ms, built->build_ms);
    EXPECT_GT(twice->build_ms, built->build_ms);
}

TEST(InputOfAnotherFrame, KeepsTheOtherSuffixes) {
    StageCache cache;
    Task task;
    const auto scene = opened("kitchen@frame=9@scale=2@move=1,0,0");
    const auto built = run_recipe(parse_recipe("bvh-spatial-median > refit(from=3)"), scene, cache, task);
    const Bvh2::Node& root = built->structure.as<Bvh2>()->nodes[0];
    EXPECT_EQ((Box{root.lower, root.upper}), scene->mesh.bounds());
    EXPECT_NE(cache.find("scene kitchen@frame=3@scale=2@move=1,0,0"), nullptr);
}

TEST(InputOfAnotherFrame, RefusesScenesWithoutFramesAndPiecesWithASentence) {
    EXPECT_EQ(refusal_of("bvh-spatial-median > refit(from=3)", "cornell"),
              "refit(from=3): scene 'cornell' has no frames; built-in scenes that have some: kitchen");
    EXPECT_EQ(refusal_of("evh(t=3) > bvh-spatial-median > refit", "cornell"),
              "refit: whole triangles are needed, evh makes pieces, which are those of one frame");
    // So small that triangles lose their area, on each frame others.
    const std::string other = refusal_of("bvh-spatial-median > refit", "kitchen@frame=9@scale=1e-42");
    EXPECT_NE(other.find("has other triangles than"), std::string::npos) << other;
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

TEST(Pipeline, WarnsOfABuildThatTakesLong) {
    EXPECT_EQ(long_build_warning(parse_recipe("bsp"), 1000000), "takes about 55 s for 1000000 triangles");
    EXPECT_EQ(long_build_warning(parse_recipe("bsp"), 10000), "");
    EXPECT_EQ(long_build_warning(parse_recipe("bvh-binned-sah"), 100000000), "");
}

}  // namespace
}  // namespace boxwood
