#include "app/viewer/build_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace boxwood {
namespace {

BuildRequest request(const std::string& recipe, const std::string& scene = "cornell") {
    return {.scene = scene, .recipes = {recipe, ""}};
}

TEST(BuildJob, AnswersWithTheWholeStructure) {
    BuildJob job(std::make_shared<StageCache>());
    EXPECT_FALSE(job.progress().running);
    job.request(request("bvh-sweep-sah"));
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->error, "");
    ASSERT_TRUE(result->sides[0].built);
    EXPECT_EQ(print(result->sides[0].built->recipe), "bvh-sweep-sah");
    ASSERT_TRUE(result->sides[0].built->levels);
    EXPECT_EQ(result->sides[0].values->references.size(), result->sides[0].built->levels->list.nodes.size());
    EXPECT_EQ(result->sides[0].tree->nodes, result->sides[0].built->levels->list.nodes.size());
    EXPECT_FALSE(job.take()) << "a result is handed over once";
}

TEST(BuildJob, ARefusedRecipeOfOneSideLeavesTheOther) {
    BuildJob job(std::make_shared<StageCache>());
    job.request({.scene = "cornell", .recipes = {"bvh-sweep-sah", "bvh-swoop-sah"}});
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result && result->sides[0].built);
    EXPECT_EQ(result->sides[0].error, "");
    EXPECT_FALSE(result->sides[1].built);
    EXPECT_NE(result->sides[1].error.find("bvh-sweep-sah"), std::string::npos) << result->sides[1].error;
}

TEST(BuildJob, WhatOneSideHadIsHandedOverAgain) {
    BuildJob job(std::make_shared<StageCache>());
    const auto built = [&](const std::string& a, const std::string& b) {
        job.request({.scene = "cornell", .recipes = {a, b}});
        job.wait();
        return job.take()->sides;
    };
    const auto first = built("bvh-sweep-sah", "bvh-binned-sah");
    const auto swapped = built("bvh-binned-sah", "bvh-sweep-sah");
    EXPECT_EQ(first[0].built, swapped[1].built);
    EXPECT_EQ(first[1].built, swapped[0].built);
    const auto twice = built("bvh-sweep-sah", "bvh-sweep-sah");
    EXPECT_EQ(twice[0].built, twice[1].built);
    EXPECT_EQ(twice[0].built, first[0].built);
    EXPECT_FALSE(built("bvh-sweep-sah", "")[1].built);
}

TEST(BuildJob, ASecondVisitRunsNothingAgain) {
    BuildJob job(std::make_shared<StageCache>());
    const auto visit = [&](const std::string& recipe) {
        job.request(request(recipe));
        job.wait();
        EXPECT_TRUE(job.take()->sides[0].built);
        return job.cache().run_count();
    };
    const uint64_t first = visit("evh(t=6) > bvh-binned-sah");
    EXPECT_GT(first, 0u);
    const uint64_t second = visit("evh(t=12) > bvh-binned-sah");
    EXPECT_GT(second, first);
    EXPECT_EQ(visit("evh(t=6) > bvh-binned-sah"), second);
    EXPECT_EQ(visit("evh(t=12) > bvh-binned-sah"), second);
}

TEST(BuildJob, AChangeOfTheBuilderKeepsTheReferences) {
    BuildJob job(std::make_shared<StageCache>());
    job.request(request("evh(t=6) > bvh-binned-sah"));
    job.wait();
    const auto before = job.take()->sides[0].built;
    job.request(request("evh(t=6) > bvh-sweep-sah"));
    job.wait();
    EXPECT_EQ(job.take()->sides[0].built->references, before->references);
}

TEST(BuildJob, OfSeveralRequestsTheNewestIsAnswered) {
    BuildJob job(std::make_shared<StageCache>());
    for (int t = 4; t <= 16; ++t)
        job.request(request("evh(t=" + std::to_string(t) + ") > bvh-sweep-sah", "spaceship"));
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result && result->sides[0].built);
    EXPECT_EQ(print(result->sides[0].built->recipe), "evh(t=16) > bvh-sweep-sah");
    EXPECT_FALSE(job.take());
}

TEST(BuildJob, AStandInIsThereBeforeTheStructure) {
    BuildJob job(std::make_shared<StageCache>());
    const auto next = [&] {
        std::optional<BuildResult> result = job.take();
        while (!result) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            result = job.take();
        }
        return *result;
    };
    BuildRequest wanted = request("evh(t=6) > best", "spaceship");
    wanted.stand_in = true;
    job.request(wanted);
    const BuildResult first = next();
    EXPECT_TRUE(first.is_stand_in);
    EXPECT_EQ(print(first.sides[0].built->recipe), "evh(t=6) > preview");
    EXPECT_TRUE(job.progress().running);
    const BuildResult last = next();
    EXPECT_FALSE(last.is_stand_in);
    EXPECT_EQ(print(last.sides[0].built->recipe), "evh(t=6) > best");
    EXPECT_EQ(last.sides[0].built->references, first.sides[0].built->references);

    // What is known already needs none; nor does a request that wants none.
    job.request(request("preview"));
    job.wait();
    job.request(wanted);
    EXPECT_FALSE(next().is_stand_in);
    job.request(request("best", "terrain@tris=20k"));
    EXPECT_FALSE(next().is_stand_in);
}

TEST(BuildJob, CancelEndsTheWorkWithoutAResult) {
    BuildJob job(std::make_shared<StageCache>());
    job.request(request("bvh-sweep-sah", "terrain@tris=300k"));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(job.progress().running);
    const Timer timer;
    job.cancel();
    job.wait();
    EXPECT_LT(timer.milliseconds(), 1500.0);
    EXPECT_FALSE(job.take());
    EXPECT_FALSE(job.progress().running);
    job.request(request("bvh-sweep-sah"));
    job.wait();
    EXPECT_TRUE(job.take()->sides[0].built) << "it works on after a cancel";
}

TEST(BuildJob, SaysWhyASceneOrARecipeIsRefused) {
    BuildJob job(std::make_shared<StageCache>());
    job.request(request("bvh-sweep-sah", "./there-is-no-such-file.glb"));
    job.wait();
    std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->scene);
    EXPECT_EQ(result->exit_code, ExitCode::BadInput);
    EXPECT_NE(result->error.find("there-is-no-such-file.glb"), std::string::npos);

    job.request(request("bvh-swep-sah"));
    job.wait();
    result = job.take();
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->scene);
    EXPECT_FALSE(result->sides[0].built);
    EXPECT_NE(result->sides[0].error.find("bvh-sweep-sah"), std::string::npos);
}

TEST(BuildJob, BuildsNoStructureThatNothingShows) {
    BuildJob job(std::make_shared<StageCache>());
    job.request({.scene = "cornell", .recipes = {"bvh-sweep-sah", ""}, .structure = false});
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result && result->scene);
    EXPECT_FALSE(result->sides[0].built);
    EXPECT_EQ(job.cache().run_count(), 0u);
}

}  // namespace
}  // namespace boxwood
