#include "bench/structures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/amortize.h"
#include "bench/refit_frames.h"
#include "support/random_mesh.h"

namespace boxwood::bench {
namespace {

StructureSettings short_run(const Scene& scene) {
    StructureSettings settings;
    settings.camera = scene.camera.value_or(fit_camera(scene.mesh.bounds()));
    settings.ray_count = 100;
    settings.builds = 2;
    settings.rates = {.rounds = 3, .round_ms = 0.2};
    return settings;
}

std::shared_ptr<const Scene> cornell() {
    Task task;
    return open_scene("cornell", task);
}

TEST(MeasureStructures, TakesEveryBuilderOfTheCatalogAndTransformsOfOneFrame) {
    const auto scene = cornell();
    Task task;
    const std::vector<MeasuredStructure> rows = measure_structures(scene, short_run(*scene), task);
    ASSERT_GE(rows.size(), builder_catalog().size());
    for (size_t i = 0; i < builder_catalog().size(); ++i) EXPECT_EQ(rows[i].recipe, builder_catalog()[i].id);
    for (const MeasuredStructure& row : rows) {
        EXPECT_TRUE(row.is_built) << row.recipe;
        EXPECT_EQ(row.is_list, row.recipe == "none") << row.recipe;
        EXPECT_GT(row.bytes, 0u);
        EXPECT_GE(row.references, scene->mesh.triangle_count());
        EXPECT_GE(row.build_ms, 0.0);
        EXPECT_EQ(row.primary.ms.size(), 3u);
        EXPECT_GT(row.primary.mrays_per_s(), 0.0);
        EXPECT_EQ(row.recipe.find("refit"), std::string::npos);
    }
}

TEST(MeasureStructures, ABuildThatTakesTooLongIsGivenUp) {
    Task task;
    const auto scene = open_scene("terrain@tris=400k", task);
    StructureSettings settings = short_run(*scene);
    settings.recipes = {parse_recipe("bvh-sweep-sah"), parse_recipe("none")};
    settings.patience = 0.01;
    settings.builds = 1;
    const std::vector<MeasuredStructure> rows = measure_structures(scene, settings, task);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_FALSE(rows[0].is_built);
    EXPECT_TRUE(std::isnan(rows[0].build_ms));
    EXPECT_TRUE(std::isnan(rows[0].primary.mrays_per_s()));
    EXPECT_FALSE(task.stopped());
}

TEST(TimeRates, ASlowStructureCastsFewerRaysEvenlySpread) {
    const Mesh mesh = random_triangles(20000, 0.01f, 1);
    Task task;
    const std::vector<PrimRef> refs = whole_refs(mesh);
    const std::vector<Structure> structures = {
        Stage(*find_entry("none")).method().build(mesh, refs, task),
        Stage(*find_entry("bvh-binned-sah")).method().build(mesh, refs, task)};
    const std::vector<Ray> rays = rays_for(mesh, 4000, 2);
    const std::vector<Rate> rates = time_rates(structures, mesh, rays, {.rounds = 2, .round_ms = 5.0}, task);
    EXPECT_LT(rates[0].rays, rates[1].rays / 10);
    EXPECT_GT(rates[0].rays, 0u);
    EXPECT_LT(10.0 * rates[0].mrays_per_s(), rates[1].mrays_per_s());
    EXPECT_TRUE(std::isnan(time_rates(structures, mesh, {}, {}, task)[0].mrays_per_s()));
}

MeasuredStructure with(const std::string& recipe, double build_ms, double mrays) {
    MeasuredStructure s;
    s.recipe = recipe;
    s.is_built = true;
    s.build_ms = build_ms;
    s.primary = {.rays = 1000, .ms = {1.0 / mrays}};
    return s;
}

/// By hand: without a build at 1 Mray/s, and 90 ms of build at 10 Mrays/s: even at 100,000 rays, 100 ms each.
TEST(Amortize, ABetterStructureWinsFromWhereItsBuildIsPaidFor) {
    const std::vector<MeasuredStructure> structures = {with("quick", 0.0, 1.0), with("good", 90.0, 10.0)};
    const std::vector<AmortizedRow> rows = amortize(structures);
    ASSERT_EQ(rows.size(), 14u);               // 7 decades of primary rays; no diffuse rays were cast
    EXPECT_DOUBLE_EQ(rows[0].total_ms, 10.0);  // 10^4 rays
    EXPECT_DOUBLE_EQ(rows[1].total_ms, 91.0);
    EXPECT_TRUE(rows[0].wins);
    EXPECT_FALSE(rows[1].wins);
    EXPECT_NEAR(rows[0].efficiency, 0.1, 1e-12);  // 1 of 10 Mrays/s
    EXPECT_NEAR(rows[1].efficiency, 1.0 / 91.0, 1e-12);
    EXPECT_DOUBLE_EQ(rows[4].total_ms, 1000.0);  // 10^6 rays
    EXPECT_DOUBLE_EQ(rows[5].total_ms, 190.0);
    EXPECT_TRUE(rows[5].wins);
    EXPECT_DOUBLE_EQ(rows[13].rays, 1e10);
    EXPECT_DOUBLE_EQ(rows[13].total_ms, 1e6 + 90.0);
    const std::vector<ReportRow> winners = winner_rows(rows, structures, *cornell());
    ASSERT_EQ(winners.size(), 7u);
    EXPECT_EQ(std::get<std::string>(*winners[0].find("winner")), "quick");
    EXPECT_EQ(std::get<std::string>(*winners[0].find("second")), "good");
    EXPECT_EQ(std::get<std::string>(*winners[6].find("winner")), "good");
    EXPECT_EQ(std::get<double>(*winners[6].find("second_ms")), 1e7);
}

TEST(RefitFrames, SetsRefitAgainstRebuildOnTheSameRays) {
    RefitSettings settings;
    settings.recipes = {parse_recipe("bvh-spatial-median")};
    settings.from = 5;
    settings.frames = {5, 60};
    settings.camera = Camera{.eye = {5.35f, 1.78f, 4.55f}, .target = {2.55f, 0.98f, 1.4f}, .fov = 56.0f};
    settings.ray_count = 100;
    settings.builds = 1;
    settings.rates = {.rounds = 2, .round_ms = 0.2};
    Task task;
    const std::vector<RefitRow> rows = run_refit_frames("kitchen@frame=77", settings, task);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].scene, "kitchen@frame=5");
    EXPECT_EQ(rows[0].built.sah_cost, rows[0].refitted.sah_cost);  // the same tree
    EXPECT_EQ(rows[1].scene, "kitchen@frame=60");
    EXPECT_NE(rows[1].built.sah_cost, rows[1].refitted.sah_cost);
    EXPECT_GT(rows[1].built.ms, rows[1].refitted.ms);
    for (const char* key : {"scene", "recipe", "triangles", "frame", "from", "build_ms", "refit_ms",
                            "sah_cost", "refit_sah_cost", "primary_mrays_per_s", "refit_primary_mrays_per_s",
                            "diffuse_mrays_per_s", "refit_diffuse_mrays_per_s"})
        EXPECT_NE(report_row(rows[1]).find(key), nullptr) << key;
}

}  // namespace
}  // namespace boxwood::bench
