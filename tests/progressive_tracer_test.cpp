#include "core/render/progressive_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>

#include "core/base/timer.h"
#include "tests/support/traced_scene.h"

namespace boxwood {
namespace {

constexpr double kLongWait = 60000.0;

void sleep_for(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

TraceResult reference(const Scene& scene, const Structure& structure, const TraceSettings& settings) {
    Task task;
    return trace_image(scene, structure, settings, task);
}

TEST(ProgressiveTracer, ConvergesToTheWholePictureAndTracesNoRayTwice) {
    const std::shared_ptr<Scene> scene = random_scene(200, 0.3f);
    const Structure structure = structure_by(BinnedSah{}, *scene);
    for (const int thread_count : {1, 4}) {
        ProgressiveTracer tracer(thread_count);
        for (const Shading shading : kAllShadings) {
            const TraceSettings settings = settings_of(97, 61, shading, 3);
            const TraceResult expected = reference(*scene, structure, settings);
            tracer.start(scene, structure, settings);
            ASSERT_TRUE(tracer.wait(kLongWait));
            Image image;
            uint64_t version = 0;
            ASSERT_TRUE(tracer.snapshot(image, version));
            EXPECT_EQ(image, expected.image) << kShadingNames[static_cast<size_t>(shading)];
            const TraceState state = tracer.state();
            EXPECT_TRUE(state.converged);
            EXPECT_FALSE(state.running);
            EXPECT_EQ(state.ray_count, expected.ray_count);
            EXPECT_EQ(state.step, 1);
            EXPECT_EQ(state.samples, 3);
            EXPECT_EQ(state.progress, 1.0);
            EXPECT_EQ(state.counters.nodes, expected.counters.nodes);
            EXPECT_EQ(state.heat.scale, expected.heat.scale);
        }
    }
}

TEST(ProgressiveTracer, ConvergedItsThreadsSleep) {
    const std::shared_ptr<Scene> scene = random_scene(20, 0.3f);
    ProgressiveTracer tracer;
    tracer.start(scene, structure_by(BinnedSah{}, *scene), settings_of(50, 50, Shading::Primary, 1));
    ASSERT_TRUE(tracer.wait(kLongWait));
    const uint64_t rays = tracer.state().ray_count;
    const std::clock_t before = std::clock();
    sleep_for(200);
    EXPECT_LT(static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC, 0.05);
    EXPECT_EQ(tracer.state().ray_count, rays);
}

TEST(ProgressiveTracer, SnapshotCopiesOnlyWhatIsNewer) {
    const std::shared_ptr<Scene> scene = random_scene(20, 0.3f);
    ProgressiveTracer tracer(2);
    Image image;
    uint64_t version = 0;
    EXPECT_FALSE(tracer.snapshot(image, version));
    EXPECT_TRUE(tracer.wait(0.0));
    tracer.start(scene, structure_by(BinnedSah{}, *scene), settings_of(50, 40, Shading::Primary, 1));
    ASSERT_TRUE(tracer.wait(kLongWait));
    EXPECT_TRUE(tracer.snapshot(image, version));
    EXPECT_EQ(image.width, 50);
    EXPECT_FALSE(tracer.snapshot(image, version));
}

TEST(ProgressiveTracer, ARestartEndsInTheOtherPictureAndKeepsTheOldUntilThen) {
    const std::shared_ptr<Scene> scene = random_scene(500, 0.3f);
    const Structure structure = structure_by(BinnedSah{}, *scene);
    ProgressiveTracer tracer(2);
    TraceSettings settings = settings_of(120, 80, Shading::Primary, 2);
    tracer.start(scene, structure, settings);
    ASSERT_TRUE(tracer.wait(kLongWait));
    Image image;
    uint64_t version = 0;
    tracer.snapshot(image, version);
    for (int i = 0; i < 20; ++i) {
        settings.camera.eye.x += 0.05f;
        settings.width = 120 + i;
        tracer.start(scene, structure, settings);
        const uint64_t before = version;
        if (tracer.snapshot(image, version)) {
            EXPECT_GT(version, before);
        }
        EXPECT_EQ(image.rgba.size(), 4 * image.pixel_count());
        EXPECT_GE(image.width, 120);
    }
    ASSERT_TRUE(tracer.wait(kLongWait));
    tracer.snapshot(image, version);
    EXPECT_EQ(image, reference(*scene, structure, settings).image);
}

TEST(ProgressiveTracer, AStopDoesNotFinishTheTile) {
    const std::shared_ptr<Scene> scene = random_scene(25000, 0.02f);
    const Structure structure = structure_by(BruteForceBuilder{}, *scene);
    const std::vector<Ray> ray(1, Ray{.origin = Vec3(0.0f, 0.0f, -3.0f)});
    std::vector<Hit> hit(1);
    const Timer ray_timer;
    structure.closest_hits(scene->mesh, ray, hit, Mode::Exact, Task());
    const double ray_ms = ray_timer.milliseconds();

    ProgressiveTracer tracer(2);
    std::vector<double> latencies;
    for (int i = 0; i < 7; ++i) {
        tracer.start(scene, structure, settings_of(64, 64, i % 2 == 0 ? Shading::Primary : Shading::Ao, 4));
        while (tracer.state().step != 8) std::this_thread::yield();
        const Timer timer;  // the next pass is one tile of 192 pixels
        tracer.stop();
        latencies.push_back(timer.milliseconds());
        const TraceState state = tracer.state();
        EXPECT_FALSE(state.running);
        EXPECT_FALSE(state.converged);
        EXPECT_EQ(state.ray_count, tracer.state().ray_count);
    }
    std::ranges::sort(latencies);
    EXPECT_LT(latencies[3], 10.0 + 10.0 * ray_ms);
}

TEST(ProgressiveTracer, PicksWhatThePixelShows) {
    std::vector<Triangle> triangles;
    add_quad(triangles, Vec3(-0.2f, -0.2f, 0.0f), Vec3(0.4f, 0.0f, 0.0f), Vec3(0.0f, 0.4f, 0.0f));
    const std::shared_ptr<Scene> scene = scene_of(triangles);
    ProgressiveTracer tracer(2);
    EXPECT_FALSE(tracer.picked(0, 0).has_value());
    tracer.start(scene, structure_by(BruteForceBuilder{}, *scene),
                 settings_of(51, 51, Shading::HeatTests, 2));
    ASSERT_TRUE(tracer.wait(kLongWait));
    const std::optional<PixelValue> middle = tracer.picked(26, 24), corner = tracer.picked(0, 50);
    ASSERT_TRUE(middle.has_value() && corner.has_value());
    EXPECT_EQ(middle->hit.prim, 0u);
    EXPECT_EQ(middle->count.tests, 2u);
    EXPECT_FALSE(corner->hit.is_hit());
    EXPECT_FALSE(tracer.picked(51, 0).has_value());
    EXPECT_FALSE(tracer.picked(0, -1).has_value());
}

TEST(ProgressiveTracer, CountsInAPassApart) {
    const std::shared_ptr<Scene> scene = random_scene(100, 0.3f);
    const Structure structure = structure_by(BruteForceBuilder{}, *scene);
    TraceSettings settings = settings_of(64, 64, Shading::Primary, 2);
    settings.measure = true;
    ProgressiveTracer tracer(2);
    tracer.start(scene, structure, settings);
    ASSERT_TRUE(tracer.wait(kLongWait));
    const TraceState state = tracer.state();
    EXPECT_EQ(state.ray_count, 2u * 64u * 64u);
    EXPECT_EQ(state.counted_rays, 64u);
    EXPECT_EQ(state.counters.tests, 64u * 100u);
}

TEST(ProgressiveTracer, CanBeDestroyedAtWork) {
    const std::shared_ptr<Scene> scene = random_scene(20000, 0.02f);
    const Structure structure = structure_by(BruteForceBuilder{}, *scene);
    for (int i = 0; i < 5; ++i) {
        ProgressiveTracer tracer(3);
        tracer.start(scene, structure, settings_of(300, 200, Shading::Ao, 4));
        sleep_for(i);
    }
}

}  // namespace
}  // namespace boxwood
