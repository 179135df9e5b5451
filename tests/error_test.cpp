#include "bench/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "bench/double_path.h"
#include "bench/error_judge.h"
#include "bench/fast_bound.h"
#include "bench/plain_ray.h"
#include "bench/ray_sets.h"
#include "bench/screened_oracle.h"
#include "core/base/rng.h"
#include "support/random_mesh.h"

namespace boxwood::bench {
namespace {

/// Answers of one mode by brute force.
std::vector<Hit> cast(const Mesh& mesh, std::span<const Ray> rays, Mode mode) {
    Task task;
    const References references = parse_recipe("none").references.method().make(mesh, task);
    const Structure structure = parse_recipe("none").builder.method().build(mesh, references.refs, task);
    std::vector<Hit> hits(rays.size());
    structure.closest_hits(mesh, rays, hits, mode, task);
    return hits;
}

Mesh one_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    Mesh mesh;
    mesh.objects.push_back({});
    mesh.positions = {a, b, c};
    mesh.triangles = {UVec3(0, 1, 2)};
    mesh.source_prim = {0};
    mesh.object = {0};
    return mesh;
}

/// A ray to (1/3, 1/3 + e), where the edge y = x passes at a distance far below what float tells apart: the
/// shear divides by three.
struct SensitiveCase {
    Mesh mesh = one_triangle(Vec3(-8.0f, -8.0f, 3.0f), Vec3(8.0f, 8.0f, 3.0f), Vec3(-8.0f, 8.0f, 3.0f));
    std::vector<Ray> rays;

    SensitiveCase() {
        for (int i = 0; i < 64; ++i) {
            Ray ray;
            const float x = 0.1f + 0.037f * static_cast<float>(i);
            ray.direction = Vec3(x, i % 2 == 0 ? std::nextafter(x, 9.0f) : std::nextafter(x, 0.0f), 3.0f);
            rays.push_back(ray);
        }
    }
};

TEST(Error, FastModeIsWrongWhereRaysPassAnEdgeCloselyAndExactModeIsNot) {
    const SensitiveCase test;
    const SampleJudge judge(test.mesh, test.rays, 1);
    const Errors fast = judge.judge(cast(test.mesh, test.rays, Mode::Fast), Precision::Fast);
    EXPECT_GT(fast.wrong_sensitive, 0u);
    EXPECT_EQ(fast.wrong_plain, 0u);
    const Errors exact = judge.judge(cast(test.mesh, test.rays, Mode::Exact), Precision::Exact);
    EXPECT_EQ(exact.wrong(), 0u);
    EXPECT_EQ(exact.sample, 64u);
    EXPECT_LE(exact.t_error, 0.5);
}

TEST(Error, WrongAnswersAreCountedByKind) {
    const Mesh mesh = one_triangle(Vec3(-1.0f, -1.0f, 3.0f), Vec3(1.0f, -1.0f, 3.0f), Vec3(0.0f, 1.0f, 3.0f));
    const std::vector<Ray> rays(1);  // from the origin along z: t = 3
    const SampleJudge judge(mesh, rays, 1);
    const auto errors_of = [&](const Hit& hit, Precision contestant) {
        return judge.judge(std::vector<Hit>{hit}, contestant);
    };
    const float next = std::nextafter(3.0f, 4.0f);
    EXPECT_EQ(errors_of({3.0f, 0}, Precision::Exact).wrong(), 0u);
    EXPECT_EQ(errors_of({}, Precision::Fast).wrong_plain, 1u);
    EXPECT_EQ(errors_of({3.0f, 1}, Precision::Fast).wrong_prims, 1u);
    EXPECT_EQ(errors_of({next, 0}, Precision::Exact).wrong_t, 1u);
    EXPECT_EQ(errors_of({next, 0}, Precision::Fast).wrong(), 0u);
    EXPECT_EQ(errors_of({next, 0}, Precision::Fast).t_error, 1.0);
    EXPECT_EQ(errors_of({3.0f, 0}, Precision::Fast).beyond_bound, 0u);
    EXPECT_EQ(errors_of({next, 0}, Precision::Fast).beyond_bound, 1u);
    EXPECT_EQ(errors_of({3.001f, 0}, Precision::Fast).beyond_bound, 1u);
}

TEST(Error, ARayIsSensitiveNearEdgesAndEndsOfItsRange) {
    const Mesh mesh = one_triangle(Vec3(-1.0f, -1.0f, 3.0f), Vec3(1.0f, -1.0f, 3.0f), Vec3(0.0f, 1.0f, 3.0f));
    Ray ray;
    EXPECT_TRUE(is_plain(mesh, ray, 3.0f));
    ray.t_max = 3.0f;
    EXPECT_FALSE(is_plain(mesh, ray, 3.0f));
    ray.t_max = 4.0f;
    EXPECT_TRUE(is_plain(mesh, ray, 3.0f));
    ray.direction = Vec3(0.0f, -1.0f, 3.0f);
    EXPECT_FALSE(is_plain(mesh, ray, 1.0f));
    ray.direction = Vec3(0.0f, -1.1f, 3.0f);
    EXPECT_TRUE(is_plain(mesh, ray, std::numeric_limits<float>::infinity()));
}

TEST(Error, TimesOfOtherAnswersDoNotCount) {
    const std::vector<Hit> answers = {{1.0f, 3}, {}};
    std::vector<Hit> others = answers;
    others[0].t = std::nextafter(1.0f, 2.0f);
    Rounds rounds;
    rounds.recorded_hash = hash_of(answers);
    rounds.add(5.0, hash_of(answers));
    rounds.add(1.0, hash_of(others));
    rounds.add(7.0, hash_of(answers));
    EXPECT_EQ(rounds.median(), 6.0);
    EXPECT_EQ(rounds.least(), 5.0);
    EXPECT_EQ(rounds.refused, 1u);
    ErrorRow row;
    EXPECT_TRUE(row.holds());
    row.rounds = rounds;
    EXPECT_FALSE(row.holds());
    EXPECT_NE(hash_of(std::vector<Hit>{{}, {1.0f, 3}}), hash_of(answers));
}

TEST(Error, TheScreenLosesNoHit) {
    const Mesh mesh = random_triangles(200, 0.3f, 7);
    const std::vector<Ray> rays = rays_for(mesh, 150, 8);
    const ScreenedOracle screened(mesh);
    size_t hit_count = 0;
    for (const Ray& ray : rays) {
        const auto found = screened.closest_hit(ray), expected = oracle::closest_hit(mesh, ray);
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (!found) continue;
        EXPECT_EQ(found->prim, expected->prim);
        EXPECT_TRUE(found->t == expected->t);
        ++hit_count;
    }
    EXPECT_GT(hit_count, 50u);
}

TEST(Error, FastModeStaysWithinItsBoundAtEveryScale) {
    for (const int exponent : {-100, -60, -30, 0, 20, 60, 100}) {
        Mesh mesh = random_triangles(100, 0.5f, 11);
        std::vector<Ray> rays = rays_for(mesh, 1500, 12);
        const float scale = std::ldexp(1.0f, exponent);
        for (Vec3& position : mesh.positions) position *= scale;
        for (Ray& ray : rays) ray.origin *= scale;
        for (size_t i = 0; i < rays.size(); i += 3) rays[i].direction *= scale;
        const Errors errors = SampleJudge(mesh, rays, 1).judge(cast(mesh, rays, Mode::Fast), Precision::Fast);
        EXPECT_EQ(errors.beyond_bound, 0u) << exponent;
        EXPECT_EQ(errors.wrong_plain, 0u) << exponent;
        EXPECT_GT(errors.t_error, 0.4) << exponent;
        EXPECT_LT(errors.t_error_p99, 0.6) << exponent;
        EXPECT_LT(errors.t_bound_p99, 1.1) << exponent;
    }
}

TEST(Error, PlainDoublePrecisionFindsTheSameHitsOverEveryBuilder) {
    const Mesh mesh = random_triangles(300, 0.2f, 3);
    Rng rng(4);
    std::vector<Ray> rays(500);
    for (Ray& ray : rays) {
        ray.origin = random_point(rng, 2.0f);
        ray.direction = random_point(rng, 1.0f) - ray.origin;
    }
    const std::vector<Hit> expected = cast(mesh, rays, Mode::Exact);
    for (const CatalogEntry& builder : builder_catalog()) {
        Task task;
        const Structure structure =
            Recipe(parse_recipe(builder.id)).builder.method().build(mesh, whole_refs(mesh), task);
        const std::optional<DoubleTracer> tracer = DoubleTracer::over(structure.list_nodes());
        if (!tracer) continue;
        std::vector<Hit> hits(rays.size());
        tracer->closest_hits(mesh, rays, hits);
        for (size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(hits[i].prim, expected[i].prim) << builder.id << ", ray " << i;
            if (!hits[i].is_hit()) continue;
            EXPECT_NEAR(hits[i].t / expected[i].t, 1.0f, 1e-6f);
        }
    }
}

TEST(Error, RowsHaveTheKeysOfTheDesignAndExactModeHolds) {
    Task task;
    const std::shared_ptr<const Scene> scene = open_scene("cornell", task);
    ErrorSettings settings;
    settings.recipes = {parse_recipe("bvh-binned-sah"), parse_recipe("evh(t=6) > bvh-sweep-sah")};
    settings.camera = scene->camera.value_or(fit_camera(scene->mesh.bounds()));
    settings.ray_count = 400;
    settings.sample_count = 100;
    settings.seconds = 0.001;
    settings.least_rounds = 3;
    const std::vector<ErrorRow> rows = run_error(scene, settings, task);
    ASSERT_EQ(rows.size(), 2u * 2u * 3u);
    for (const ErrorRow& row : rows) {
        EXPECT_TRUE(row.holds()) << row.recipe << ", " << row.rays_kind;
        EXPECT_EQ(row.rays, 400u);
        EXPECT_EQ(row.errors.sample, 100u);
        EXPECT_GE(row.rounds.ms.size(), 3u);
        EXPECT_GT(row.count.nodes, 400u);
        const ReportRow cells = report_row(row);
        for (const char* key : {"scene",
                                "recipe",
                                "rays_kind",
                                "contestant",
                                "triangles",
                                "references",
                                "bytes",
                                "build_ms",
                                "threads",
                                "rays",
                                "trace_ms",
                                "mrays_per_s",
                                "over_fast",
                                "nodes_per_ray",
                                "tests_per_ray",
                                "exact_per_ray",
                                "wrong",
                                "wrong_plain_per_million",
                                "wrong_sensitive_per_million",
                                "t_error_ulps",
                                "t_bound_ulps",
                                "rays_hash",
                                "hits_hash",
                                "holds"})
            EXPECT_NE(cells.find(key), nullptr) << key;
    }
    // The same rays for all, and the same exact answers from both structures.
    EXPECT_EQ(rows[0].rays_hash, rows[5].rays_hash);
    EXPECT_EQ(rows[0].rounds.recorded_hash, rows[3].rounds.recorded_hash);
    EXPECT_NE(rows[0].rays_hash, rows[6].rays_hash);
    EXPECT_EQ(rows[1].over_fast, 1.0);
}

TEST(Error, TheScriptOfPlotsIsPython) {
    if (std::system("python3 -c '' 2>/dev/null") != 0) GTEST_SKIP() << "no python3";
    for (const char* script : {"plots.py", "plots_peers.py"}) {
        const std::string command = "python3 -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' '" +
                                    std::string(BOXWOOD_SOURCE_DIR) + "/bench/" + script + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << script;
    }
}

}  // namespace
}  // namespace boxwood::bench
