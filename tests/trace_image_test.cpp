#include "core/render/trace_image.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "core/render/film.h"
#include "core/render/trace_schedule.h"
#include "tests/support/traced_scene.h"

namespace boxwood {
namespace {

TraceResult trace(const Scene& scene, const TraceSettings& settings) {
    Task task;
    return trace_image(scene, structure_by(BinnedSah{}, scene), settings, task);
}

/// A wall at z = 0 that faces the camera.
std::shared_ptr<Scene> wall(float half_size, const Vec3& color) {
    std::vector<Triangle> triangles;
    add_quad(triangles, Vec3(-half_size, -half_size, 0.0f), Vec3(2.0f * half_size, 0.0f, 0.0f),
             Vec3(0.0f, 2.0f * half_size, 0.0f));
    return scene_of(triangles, color);
}

void expect_pixel(const Image& image, int x, int y, int r, int g, int b) {
    const uint8_t* p = image.pixel(x, y);
    EXPECT_EQ(p[0], r);
    EXPECT_EQ(p[1], g);
    EXPECT_EQ(p[2], b);
    EXPECT_EQ(p[3], 255);
}

TEST(TraceImage, ShowsTheBaseColourWhereTheLightFallsStraightAndTheBackgroundBeside) {
    TraceSettings settings = settings_of(5, 5, Shading::Primary, 1);
    settings.background = Vec3(0.0f, 1.0f, 0.0f);
    const TraceResult result = trace(*wall(0.5f, Vec3(0.5f, 0.25f, 1.0f)), settings);
    expect_pixel(result.image, 2, 2, srgb_byte(0.5f), srgb_byte(0.25f), 255);
    expect_pixel(result.image, 0, 0, 0, 255, 0);
    EXPECT_EQ(result.ray_count, 25u);
    EXPECT_FALSE(result.stopped);
}

TEST(TraceImage, RowZeroIsOnTopAndTrianglesHaveTwoSides) {
    const Triangle upper{{-9.0f, 0.1f, 0.0f}, {9.0f, 0.1f, 0.0f}, {0.0f, 9.0f, 0.0f}};
    const TraceSettings settings = settings_of(5, 4, Shading::Primary, 1);
    const Image front = trace(*scene_of({upper}), settings).image;
    EXPECT_GT(front.pixel(2, 0)[0], 200);
    expect_pixel(front, 2, 3, srgb_byte(settings.background.x), srgb_byte(settings.background.y),
                 srgb_byte(settings.background.z));
    EXPECT_EQ(trace(*scene_of({{upper.a, upper.c, upper.b}}), settings).image, front);
}

TEST(TraceImage, NormalsFaceTheEye) {
    const TraceResult result = trace(*wall(0.5f, Vec3(0.8f)), settings_of(5, 5, Shading::Normals, 1));
    expect_pixel(result.image, 2, 2, 128, 128, 255);
}

TEST(TraceImage, AoOfAnOpenPlaneIsWhiteAndBesideAWallHalf) {
    TraceSettings settings = settings_of(1, 1, Shading::Ao, 64);
    settings.camera.fov = 1.0f;
    settings.ao_radius = 0.01f;
    const TraceResult open = trace(*wall(100.0f, Vec3(0.8f)), settings);
    const int white = open.image.pixel(0, 0)[0];
    EXPECT_GT(white, 230);
    EXPECT_EQ(open.ray_count, 64u * 5u);

    std::vector<Triangle> triangles;
    add_quad(triangles, Vec3(-100.0f, -100.0f, 0.0f), Vec3(200.0f, 0.0f, 0.0f), Vec3(0.0f, 200.0f, 0.0f));
    add_quad(triangles, Vec3(0.03f, -100.0f, 0.0f), Vec3(0.0f, 200.0f, 0.0f), Vec3(0.0f, 0.0f, 100.0f));
    const TraceResult beside = trace(*scene_of(triangles), settings);
    const float white_value = linear_from_srgb(static_cast<uint8_t>(white));
    EXPECT_NEAR(linear_from_srgb(beside.image.pixel(0, 0)[0]), 0.5f * white_value, 0.03f);
}

TEST(TraceImage, HeatByBruteForceTestsEveryPrimitive) {
    const std::shared_ptr<Scene> scene = random_scene(50, 0.3f);
    Task task;
    const TraceSettings settings = settings_of(8, 8, Shading::HeatTests, 1);
    const TraceResult result = trace_image(*scene, structure_by(BruteForceBuilder{}, *scene), settings, task);
    EXPECT_EQ(result.counters.tests, 64u * 50u);
    EXPECT_EQ(result.counted_rays, 64u);
    EXPECT_EQ(result.heat.scale.upper, 50.0);
    EXPECT_EQ(result.heat.largest, 50.0);
    expect_pixel(result.image, 3, 3, 253, 231, 37);  // the map's last colour
    EXPECT_EQ(result.ms, 0.0);
    EXPECT_EQ(task.done.load(), task.total.load());
}

TEST(TraceImage, MeasuresInAPassApart) {
    const std::shared_ptr<Scene> scene = random_scene(50, 0.3f);
    TraceSettings settings = settings_of(8, 8, Shading::Primary, 2);
    const TraceResult plain = trace(*scene, settings);
    EXPECT_EQ(plain.counted_rays, 0u);
    settings.measure = true;
    const TraceResult measured = trace(*scene, settings);
    EXPECT_EQ(measured.image, plain.image);
    EXPECT_EQ(measured.ray_count, 128u);
    EXPECT_EQ(measured.counted_rays, 64u);
    EXPECT_GT(measured.counters.nodes, 64u);
    settings.shading = Shading::Heat;
    EXPECT_GT(trace(*scene, settings).ms, 0.0);
}

TEST(TraceImage, IsTheSameForEveryStructureAndNumberOfThreads) {
    const std::shared_ptr<Scene> scene = random_scene(200, 0.3f);
    for (const Shading shading : kAllShadings) {
        const TraceSettings settings = settings_of(70, 45, shading, 3);
        const Image image = trace(*scene, settings).image;
        const ThreadLimit one_thread(1);
        EXPECT_EQ(trace(*scene, settings).image, image);
        if (is_heat(shading)) continue;
        Task task;
        EXPECT_EQ(trace_image(*scene, structure_by(BruteForceBuilder{}, *scene), settings, task).image,
                  image);
    }
}

TEST(TraceImage, ASceneWithoutTrianglesIsBackground) {
    for (const Shading shading : kAllShadings) {
        const TraceResult result = trace(Scene(), settings_of(3, 3, shading, 1));
        EXPECT_EQ(result.image.width, 3);
        if (is_heat(shading)) continue;
        EXPECT_EQ(result.image.pixel(1, 1)[0], srgb_byte(TraceSettings().background.x));
    }
}

TEST(TraceImage, AStopIsReported) {
    std::stop_source stop;
    stop.request_stop();
    Task task(stop.get_token());
    const std::shared_ptr<Scene> scene = random_scene(50, 0.3f);
    const Structure structure = structure_by(BinnedSah{}, *scene);
    EXPECT_TRUE(trace_image(*scene, structure, settings_of(64, 64, Shading::Ao, 1), task).stopped);
}

TEST(HeatScale, AFewCostlyPixelsDoNotSetItsEnd) {
    TraceSettings settings = settings_of(100, 100, Shading::Heat, 1);
    Film film;
    film.resize(settings);
    for (size_t i = 0; i < film.counts.size(); ++i) film.counts[i].nodes = i % 40;
    film.counts[77].nodes = 100000;
    const HeatScale heat = make_heat_scale(film, settings, 1, 1);
    EXPECT_EQ(heat.scale.lower, 0.0);
    EXPECT_EQ(heat.scale.upper, 39.0);
    EXPECT_EQ(heat.largest, 100000.0);
    settings.heat_max = 64.0;
    EXPECT_EQ(make_heat_scale(film, settings, 1, 1).scale.upper, 64.0);
    settings.log_heat = true;
    EXPECT_EQ(make_heat_scale(film, settings, 1, 1).scale.lower, 1.0);
}

TEST(TraceSchedule, EverySampleOfEveryPixelIsInOnePass) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(64, 64), std::pair(131, 70)}) {
        TraceSettings settings = settings_of(width, height, Shading::Primary, 3);
        settings.measure = true;
        std::vector<int> counts(static_cast<size_t>(width * height));
        std::vector<uint32_t> pixels;
        for (const TracePass& pass : make_trace_passes(settings)) {
            if (pass.counting) continue;
            for (const TraceTile& tile : tiles_from_middle(width, height, pass.tile_size)) {
                list_pixels(pass, tile, width, height, pixels);
                EXPECT_LE(pixels.size(), 256u);
                for (const uint32_t pixel : pixels) ++counts[pixel];
            }
        }
        for (const int count : counts) ASSERT_EQ(count, 3);
    }
}

TEST(TraceSchedule, BeginsInTheMiddle) {
    const std::vector<TraceTile> tiles = tiles_from_middle(160, 160, 32);
    EXPECT_EQ(tiles.front().x, 64);
    EXPECT_EQ(tiles.front().y, 64);
    EXPECT_EQ(tiles.size(), 25u);
}

}  // namespace
}  // namespace boxwood
