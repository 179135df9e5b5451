#include "bench/picture_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <thread>

#include "core/base/parallel.h"
#include "core/base/timer.h"
#include "support/traced_scene.h"

namespace boxwood::bench {
namespace {

/// Brute force that never finds one of the triangles.
struct Forgetful {
    static constexpr const char* kFamily = "forgetful";
    uint32_t forgotten;

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
        const Box box = mesh.bounds();
        closest.enter_scene(box.lower, box.upper);
        for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
            if (prim != forgotten) closest.test(mesh.triangle(prim), prim, count);
    }
    template <Mode mode, class Counter>
    bool any_hit(const Mesh&, ClosestHit<mode>&, Counter&) const {
        return false;
    }
    NodeList list_nodes() const { return {}; }
    size_t byte_count() const { return 0; }
};

PictureCheckSettings settings_of(uint64_t samples) {
    const TraceSettings traced = boxwood::settings_of(40, 30, Shading::Primary, 1);
    return {.camera = traced.camera, .width = 40, .height = 30, .sample_count = samples, .seconds = 0.0};
}

TEST(SpreadOrder, HasEveryNumberOnceAndItsFirstPartIsSpread) {
    for (const uint64_t total : {1ull, 2ull, 7ull, 1200ull, 4096ull}) {
        std::vector<uint32_t> order = spread_order(total);
        ASSERT_EQ(order.size(), total);
        std::array<int, 4> quarters{};
        for (size_t i = 0; i < total / 50; ++i) ++quarters[4 * order[i] / total];
        for (const int count : quarters) EXPECT_GE(count, static_cast<int>(total / 250)) << total;
        std::ranges::sort(order);
        for (uint32_t i = 0; i < total; ++i) ASSERT_EQ(order[i], i);
    }
    EXPECT_TRUE(spread_order(0).empty());
}

TEST(EvenSample, HasOneOfEachPart) {
    const std::vector<uint32_t> sample = even_sample(1000, 100);
    ASSERT_EQ(sample.size(), 100u);
    for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(sample[i] / 10, i);
    EXPECT_EQ(even_sample(3, 3), (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(even_sample(3, 100).size(), 3u);
    EXPECT_TRUE(even_sample(0, 5).empty());
}

TEST(PictureCheck, FindsNothingWrongInExactMode) {
    const std::shared_ptr<Scene> scene = random_scene(60, 0.5f);
    const Structure structure = structure_by(BinnedSah{}, *scene);
    Task task;
    const PictureCheck some = check_picture(scene->mesh, structure, settings_of(100), task);
    EXPECT_EQ(some.rays, 1200u);
    EXPECT_EQ(some.checked, 100u);
    EXPECT_EQ(some.modes[0].wrong(), 0u);
    EXPECT_TRUE(some.modes[0].wrong_pixels.empty());
    EXPECT_EQ(task.done.load(), task.total.load());
    EXPECT_EQ(check_picture(scene->mesh, structure, settings_of(1u << 30), task).checked, 1200u);
}

TEST(PictureCheck, NamesThePixelsThatAreWrong) {
    const std::shared_ptr<Scene> scene = random_scene(60, 0.5f);
    const Structure right = structure_by(BruteForceBuilder{}, *scene);
    const PictureCheckSettings settings = settings_of(1200);
    std::map<uint32_t, std::vector<uint32_t>> pixels_of;  // each triangle
    const CameraFrame frame = camera_frame(settings.camera, 40.0 / 30.0);
    for (uint32_t pixel = 0; pixel < 1200; ++pixel) {
        const Ray ray = camera_ray(frame, pixel % 40 + 0.5, pixel / 40 + 0.5, 40, 30);
        Hit hit;
        right.closest_hits(scene->mesh, std::span(&ray, 1), std::span(&hit, 1), Mode::Exact, Task{});
        if (hit.is_hit()) pixels_of[hit.prim].push_back(pixel);
    }
    const auto largest =
        std::ranges::max_element(pixels_of, {}, [](const auto& entry) { return entry.second.size(); });
    const Structure wrong(Forgetful{largest->first});
    const std::vector<uint32_t>& expected = largest->second;
    ASSERT_GT(expected.size(), 20u);
    Task task;
    const PictureCheck check = check_picture(scene->mesh, wrong, settings, task);
    for (const ModeCheck& mode : check.modes) {
        EXPECT_EQ(mode.wrong_pixels, expected);
        EXPECT_EQ(mode.wrong_hits + mode.wrong_prims, expected.size());
        EXPECT_EQ(mode.wrong_t, 0u);
        EXPECT_EQ(mode.rays_per_second, 0.0) << "not asked for";
    }
    const ThreadLimit one(1);
    EXPECT_EQ(check_picture(scene->mesh, wrong, settings, task).modes[1].wrong_pixels, expected);
}

TEST(PictureCheck, TimesBothModesOverTheSameRays) {
    const std::shared_ptr<Scene> scene = random_scene(60, 0.5f);
    PictureCheckSettings settings = settings_of(10);
    settings.seconds = 0.05;
    Task task;
    const PictureCheck check = check_picture(scene->mesh, structure_by(BinnedSah{}, *scene), settings, task);
    for (const ModeCheck& mode : check.modes) {
        EXPECT_GT(mode.rays_per_second, 0.0);
        EXPECT_GE(mode.timed_rays, 1200u);
    }
}

TEST(PictureCheck, EndsSoonAfterAStop) {
    const std::shared_ptr<Scene> scene = random_scene(20000, 0.5f);
    const Structure structure = structure_by(BruteForceBuilder{}, *scene);
    PictureCheckSettings settings = settings_of(1u << 30);
    settings.width = settings.height = 500;
    std::stop_source stop;
    Task task(stop.get_token());
    Timer timer;
    std::jthread caller([&] { check_picture(scene->mesh, structure, settings, task); });
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    stop.request_stop();
    timer = Timer();
    caller.join();
    EXPECT_LT(timer.milliseconds(), 1000.0);
}

}  // namespace
}  // namespace boxwood::bench
