#include "bench/stress.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bench/stress_cases.h"
#include "bench/stress_failure.h"
#include "core/base/parallel.h"
#include "core/measure/ray_file.h"
#include "core/scene/load_file.h"
#include "oracle/oracle.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"

namespace boxwood::bench {
namespace {

TEST(Stress, NoWrongAnswerInExactModeForEveryBuilder) {
    StressSettings settings;
    for (const CatalogEntry& builder : builder_catalog())
        settings.recipes.push_back(parse_recipe(builder.id));
    settings.seconds = 0.1;
    // Every kind is run once at least on each thread: under a sanitizer on one.
    const ThreadLimit limit(kIsSanitized ? 1 : thread_count());
    Task task;
    uint64_t exact_decisions = 0;
    for (const StressRow& row : run_stress(settings, task)) {
        EXPECT_TRUE(row.holds()) << row.first_failure;
        EXPECT_GT(row.rays, 0u) << row.kind;
        exact_decisions += row.exact_decisions;
    }
    EXPECT_GT(exact_decisions, 0u);
}

TEST(Stress, CasesHaveSomethingToHit) {
    for (const StressKind& kind : stress_kinds()) {
        if (kind.judge != Judge::Oracle) continue;
        const StressCase test = kind.make(1, 48);
        size_t hit_count = 0;
        for (const Ray& ray : test.rays) hit_count += oracle::closest_hit(test.mesh, ray).has_value();
        EXPECT_GT(hit_count, 4u) << kind.name;
    }
}

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Stress, AFailingRayIsSavedSoThatItCanBeCastAgain) {
    StressSettings settings;
    settings.recipes = {parse_recipe("evh(t=9) > bvh-binned-sah")};
    settings.modes = {Mode::Exact};
    settings.seconds = 0.01;
    settings.tamper = [](std::span<Hit> hits) {  // every answer is another one
        for (Hit& hit : hits) hit = hit.is_hit() ? Hit{} : Hit{1.0f, 0};
    };
    Task task;
    const TemporaryFolder folder;
    const std::string place = folder.write("empty", "");
    const std::string saved = place.substr(0, place.size() - 5) + "failures";
    size_t found_count = 0;
    for (const StressRow& row : run_stress(settings, task)) {
        EXPECT_FALSE(row.holds()) << row.kind;
        ASSERT_TRUE(row.failure) << row.kind;
        const std::string line = save_failure(*row.failure, saved);
        const std::string end = line.substr(line.find("--rays '") + 8);
        const std::string stem = end.substr(0, end.find(".rays'"));
        EXPECT_EQ(line, "boxwood cast '" + stem + ".ply' --recipe '" + row.recipe +
                            "' --mode exact --rays '" + stem + ".rays' -o -");
        const RayFile rays = parse_rays(content_of(stem + ".rays"), "rays");
        ASSERT_EQ(rays.rays.size(), 1u);
        EXPECT_EQ(ray_line("0", rays.rays[0]), ray_line("0", row.failure->ray)) << row.kind;
        // Its ray meets the mesh that was saved as it meets the mesh of the case.
        const StressCase test = row.failure->make(row.failure->seed, row.failure->ray_count);
        const Scene scene = load_file(stem + ".ply", task);
        const auto expected = oracle::closest_hit(test.mesh, row.failure->ray);
        const auto found = oracle::closest_hit(scene.mesh, rays.rays[0]);
        ASSERT_EQ(found.has_value(), expected.has_value()) << row.kind;
        if (!found) continue;
        ++found_count;
        EXPECT_EQ(found->t, expected->t) << row.kind;
        EXPECT_EQ(scene.mesh.source_prim[found->prim], expected->prim) << row.kind;
    }
    EXPECT_GT(found_count, 5u);
}

}  // namespace
}  // namespace boxwood::bench
