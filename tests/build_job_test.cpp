#include "app/viewer/build_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace boxwood {
namespace {

BuildRequest request(const std::string& recipe, const std::string& scene = "cornell") {
    return {.scene = scene, .recipe = recipe};
}

TEST(BuildJob, AnswersWithTheWholeStructure) {
    BuildJob job(std::make_shared<StageCache>());
    EXPECT_FALSE(job.progress().running);
    job.request(request("bvh-sweep-sah"));
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->error, "");
    ASSERT_TRUE(result->built);
    EXPECT_EQ(print(result->built->recipe), "bvh-sweep-sah");
    ASSERT_TRUE(result->built->levels);
    EXPECT_EQ(result->values->references.size(), result->built->levels->list.nodes.size());
    EXPECT_EQ(result->tree->nodes, result->built->levels->list.nodes.size());
    EXPECT_FALSE(job.take()) << "a result is handed over once";
}

TEST(BuildJob, ASecondVisitRunsNothingAgain) {
    BuildJob job(std::make_shared<StageCache>());
    const auto visit = [&](const std::string& recipe) {
        job.request(request(recipe));
        job.wait();
        EXPECT_TRUE(job.take()->built);
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
    const auto before = job.take()->built;
    job.request(request("evh(t=6) > bvh-sweep-sah"));
    job.wait();
    EXPECT_EQ(job.take()->built->references, before->references);
}

TEST(BuildJob, OfSeveralRequestsTheNewestIsAnswered) {
    BuildJob job(std::make_shared<StageCache>());
    for (int t = 4; t <= 16; ++t)
        job.request(request("evh(t=" + std::to_string(t) + ") > bvh-sweep-sah", "spaceship"));
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result && result->built);
    EXPECT_EQ(print(result->built->recipe), "evh(t=16) > bvh-sweep-sah");
    EXPECT_FALSE(job.take());
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
    EXPECT_TRUE(job.take()->built) << "it works on after a cancel";
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
    EXPECT_FALSE(result->built);
    EXPECT_NE(result->error.find("bvh-sweep-sah"), std::string::npos);
}

TEST(BuildJob, BuildsNoStructureThatNothingShows) {
    BuildJob job(std::make_shared<StageCache>());
    job.request({.scene = "cornell", .recipe = "bvh-sweep-sah", .structure = false});
    job.wait();
    const std::optional<BuildResult> result = job.take();
    ASSERT_TRUE(result && result->scene);
    EXPECT_FALSE(result->built);
    EXPECT_EQ(job.cache().run_count(), 0u);
}

}  // namespace
}  // namespace boxwood
