#include "bench/peers.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/build_time.h"
#include "bench/builds.h"
#include "bench/contestant.h"
#include "bench/ray_sets.h"
#include "bench/scale.h"
#include "bench/timing.h"
#include "core/base/error.h"
#include "core/measure/tree_stats.h"
#include "core/measure/verify.h"

namespace boxwood::bench {
namespace {

std::shared_ptr<const Scene> scene_of(const std::string& spec) {
    Task task;
    return open_scene(spec, task);
}

Structure structure_of(const Mesh& mesh) {
    Task task;
    return build_timed(parse_recipe("bvh-sweep-sah"), mesh, 1, task)->structure;
}

PeerSettings quick(const Scene& scene) {
    PeerSettings settings;
    settings.camera = scene.camera.value_or(fit_camera(scene.mesh.bounds()));
    settings.recipes = {parse_recipe("bvh-sweep-sah"), parse_recipe("bvh-spatial-median")};
    settings.size = 20;
    settings.sample_count = 40;
    settings.seconds = 0.0;
    settings.least_rounds = 3;
    return settings;
}

TEST(Ratios, TheRatioIsThatOfTheMediansAndItsIntervalThatOfRoundsDrawnAgain) {
    const std::vector<double> ours{1.0, 3.0, 2.0}, twice{2.0, 6.0, 4.0}, other{5.0, 3.0, 4.0};
    const RatioInterval same = ratio_of_medians(twice, ours);  // in each round twice as long: no spread
    EXPECT_EQ(same.value, 2.0);
    EXPECT_EQ(same.lower, 2.0);
    EXPECT_EQ(same.upper, 2.0);
    const RatioInterval spread = ratio_of_medians(other, ours);
    EXPECT_EQ(spread.value, 2.0);  // 4 / 2
    EXPECT_EQ(spread.lower, 1.0);  // the second round thrice: 3 / 3
    EXPECT_EQ(spread.upper, 5.0);  // the first round thrice: 5 / 1
    EXPECT_TRUE(std::isnan(ratio_of_medians(ours, std::span(other).first(2)).value));
    EXPECT_TRUE(std::isnan(ratio_of_medians({}, {}).value));
}

TEST(Ratios, ASummaryHasTheGeometricMeanAndTheWorstCell) {
    const double nan = std::nan("");
    std::vector<RatioCell> cells{{"a", "bunny primary", 2.0},   {"b", "bunny primary", 0.9},
                                 {"a", "bunny diffuse", 0.25},  {"a", "dragon primary", 1.1},
                                 {"a", "dragon diffuse", 1.2},  {"a", "dragon shadow", nan},
                                 {"b", "dragon primary", 0.899}};
    cells[0].over_fast = 1.0;
    cells[2].over_fast = 1.21;
    cells[3].over_fast = nan;
    cells[0].wrong = 2;
    cells[4].wrong = 3;
    const std::vector<RatioSummary> summaries = summarize(cells);
    ASSERT_EQ(summaries.size(), 2u);
    EXPECT_EQ(summaries[0].contestant, "a");
    EXPECT_NEAR(summaries[0].over_fast, 1.1, 1e-12);
    EXPECT_EQ(summaries[0].worst_over_fast, 1.21);
    EXPECT_EQ(summaries[0].wrong, 5u);
    EXPECT_TRUE(std::isnan(summaries[1].over_fast));
    EXPECT_EQ(summaries[0].cells, 4u);
    EXPECT_NEAR(summaries[0].geometric_mean, std::pow(2.0 * 0.25 * 1.1 * 1.2, 0.25), 1e-12);
    EXPECT_EQ(summaries[0].worst, 0.25);
    EXPECT_EQ(summaries[0].worst_cell, "bunny diffuse");
    EXPECT_EQ(summaries[0].under_09, 1u);
    EXPECT_EQ(summaries[0].under_12, 2u);
    EXPECT_EQ(summaries[1].under_09, 1u);  // 0.9 itself is not under it
}

/// A square of two triangles at z = 0, the same once more, so that each hit is a tie, and one below at z =
/// -1.
Mesh squares() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, -1}, {1, 1, -1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
    mesh.source_prim = {0, 1, 2, 3, 4};
    mesh.object = {0, 0, 0, 0, 0};
    mesh.objects = {{"square"}};
    return mesh;
}

Ray down_at(float x, float y) {
    Ray ray;
    ray.origin = {x, y, 3.0f};
    ray.direction = {0.0f, 0.0f, -1.0f};
    return ray;
}

TEST(PeerJudge, TellsMissesTiesWrongPrimitivesAndWrongBitsApart) {
    const Mesh mesh = squares();
    const RaySet set{"test", Casting::Closest, {down_at(0.75f, 0.25f), down_at(2.0f, 0.5f)}};
    const float next = std::nextafter(3.0f, 4.0f);
    std::vector<Answers> answers(7);
    answers[0].hits = {Hit{3.0f, 0}, Hit{}};         // right
    answers[1].hits = {Hit{3.0f, 2}, Hit{}};         // the copy: a tie
    answers[2].hits = {Hit{3.0f, 1}, Hit{}};         // a triangle beside the ray
    answers[3].hits = {Hit{next, 0}, Hit{}};         // a bit of t
    answers[4].hits = {Hit{}, Hit{3.0f, 0}};         // a miss for a hit, a hit for a miss
    answers[5].hits = {Hit{3.0f, 2}, Hit{3.0f, 1}};  // the copy, and a hit for a miss
    answers[6].hits = {Hit{4.0f, 4}, Hit{}};         // the one behind it
    const ScreenedOracle oracle(mesh);
    const std::vector<uint32_t> judged{0, 1};
    const std::vector<Demand> nearest(7, Demand::Nearest), exact(7, Demand::Exact);
    const std::vector<PeerErrors> of_peers = judge_answers(mesh, oracle, set, judged, answers, nearest);
    const std::vector<PeerErrors> of_ours = judge_answers(mesh, oracle, set, judged, answers, exact);
    const std::vector<uint64_t> peers_wrong{0, 0, 1, 0, 2, 1, 1}, ours_wrong{0, 1, 1, 1, 2, 2, 1};
    for (size_t a = 0; a < answers.size(); ++a) {
        EXPECT_EQ(of_peers[a].judged, 2u);
        EXPECT_EQ(of_peers[a].wrong(), peers_wrong[a]) << a;
        EXPECT_EQ(of_ours[a].wrong(), ours_wrong[a]) << a;
        EXPECT_EQ(of_peers[a].ties, a == 1 || a == 5 ? 1u : 0u) << a;
        EXPECT_EQ(of_ours[a].ties, 0u) << a;
    }
    EXPECT_EQ(of_ours[3].wrong_t, 1u);
    EXPECT_EQ(of_peers[4].wrong_hits, 2u);
}

TEST(PeerJudge, EveryRayWithDifferentAnswersIsJudged) {
    std::vector<Answers> answers(3);
    for (Answers& one : answers) one.hits.assign(1000, Hit{1.0f, 7});
    answers[1].hits[123].prim = 8;
    answers[2].hits[900] = Hit{};
    answers[2].hits[500].t = 2.0f;  // the same primitive: not disputed
    uint64_t disputed = 0;
    const std::vector<uint32_t> judged = rays_to_judge(answers, 1000, 4, disputed);
    EXPECT_EQ(disputed, 2u);
    EXPECT_TRUE(std::ranges::is_sorted(judged));
    EXPECT_TRUE(std::ranges::binary_search(judged, 123u));
    EXPECT_TRUE(std::ranges::binary_search(judged, 900u));
    EXPECT_LE(judged.size(), 6u);
    EXPECT_GE(judged.size(), 4u);
}

TEST(PeerRays, BouncesAndShadowsStartAtTheHitsOfTheCamera) {
    const auto scene = scene_of("cornell");
    const PeerSettings settings = quick(*scene);
    const Structure structure = structure_of(scene->mesh);
    Task task;
    const std::vector<RaySet> sets = peer_rays(structure, *scene, settings, task);
    ASSERT_EQ(sets.size(), 4u);
    const std::vector<Ray>& primary = sets[0].rays;
    ASSERT_EQ(primary.size(), 400u);
    const std::vector<Hit> hits = boxwood::closest_hits(structure, scene->mesh, primary, Mode::Exact, task);
    const auto hit_count = static_cast<size_t>(std::ranges::count_if(hits, &Hit::is_hit));
    EXPECT_GT(hit_count, 100u);
    EXPECT_EQ(sets[1].rays.size(), hit_count);
    EXPECT_EQ(sets[1].rays[0].t_max, std::numeric_limits<float>::infinity());
    EXPECT_EQ(sets[2].casting, Casting::Any);
    EXPECT_GT(sets[2].rays.size(), hit_count / 4);
    EXPECT_LE(sets[2].rays.size(), hit_count);
    const Vec3 light = light_by_camera(settings.camera, structure, scene->mesh);
    for (const Ray& ray : sets[2].rays) {
        EXPECT_EQ(ray.t_max, 1.0f);
        EXPECT_LT(glm::distance(ray.origin + ray.direction, light), 1e-5f * glm::length(light));
    }
    // In tiles: the same rays, the first sixteen from the first four rows and columns.
    const std::vector<Ray>& tiles = sets[3].rays;
    ASSERT_EQ(tiles.size(), primary.size());
    for (size_t k = 0; k < 16; ++k)
        EXPECT_EQ(hash_of(std::span(&tiles[k], 1)), hash_of(std::span(&primary[k / 4 * 20 + k % 4], 1))) << k;
    // The renderer's tile of 16 by 16 is done before the next one begins.
    for (size_t k = 0; k < 256; ++k) {
        EXPECT_LT(sets[3].pixels[k] % 20, 16u);
        EXPECT_LT(sets[3].pixels[k] / 20, 16u);
    }
    std::multiset<uint64_t> first, second;
    for (const Ray& ray : primary) first.insert(hash_of(std::span(&ray, 1)));
    for (const Ray& ray : tiles) second.insert(hash_of(std::span(&ray, 1)));
    EXPECT_EQ(first, second);
}

TEST(PeerRays, TheLightHangsHalfWayToTheCeiling) {
    Mesh mesh = squares();
    mesh.triangles.pop_back();
    for (Vec3& position : mesh.positions) position = Vec3(20.0f * (position - Vec3(0.5f, 0.5f, 0.0f)));
    for (Vec3& position : mesh.positions) position = {position.x, 4.0f, position.y};  // a ceiling at y = 4
    Camera camera;
    camera.eye = {0.0f, 0.0f, 0.0f};
    camera.target = {0.0f, 0.0f, -1.0f};
    const Structure structure = structure_of(mesh);
    const Vec3 light = light_by_camera(camera, structure, mesh);
    EXPECT_NEAR(light.y, 2.0f, 1e-5f);
    EXPECT_NEAR(light.x, 1.0f, 1e-5f);
    camera.eye.y = 10.0f;  // above it: nothing stands there, half the diagonal of 20 by 20 along (1/2, 1)
    const Vec3 outside = light_by_camera(camera, structure, mesh);
    EXPECT_NEAR(glm::distance(outside, camera.eye), std::sqrt(200.0f), 1e-4f);
}

TEST(PeerRays, ASideThatIsTurnedAwayFromTheLightHasNoShadowRay) {
    const Mesh mesh = squares();
    const std::vector<Ray> rays{down_at(0.75f, 0.25f), down_at(2.0f, 2.0f)};
    const std::vector<Hit> hits{Hit{3.0f, 0}, Hit{}};
    EXPECT_EQ(shadow_rays(mesh, rays, hits, Vec3(0.5f, 0.5f, 2.0f)).size(), 1u);
    EXPECT_EQ(shadow_rays(mesh, rays, hits, Vec3(0.5f, 0.5f, -2.0f)).size(), 0u);
    const std::vector<Ray> bounced = bounced_rays(mesh, rays, hits);
    ASSERT_EQ(bounced.size(), 1u);
    EXPECT_GT(bounced[0].origin.z, 0.0f);
    EXPECT_GT(bounced[0].direction.z, 0.0f);
}

TEST(Peers, AllCastTheSameRaysAndExactAnswersAreRight) {
    const auto scene = scene_of("cornell");
    PeerSettings settings = quick(*scene);
    settings.variants.assign(embree_variants().begin(), embree_variants().end());
    settings.threads = {1, 2};
    Task task;
    const std::vector<PeerRow> rows = run_peers(scene, settings, task);
    const size_t in_cell = 2 * settings.recipes.size() + settings.variants.size();
    const size_t renderers = 2 * settings.recipes.size();  // in the cell of packets
    ASSERT_EQ(rows.size(), 2 * (std::size(kRayKinds) * in_cell + renderers));
    for (size_t i = 0; i < rows.size(); ++i) {
        const PeerRow& row = rows[i];
        const PeerRow& first = *std::ranges::find_if(rows, [&](const PeerRow& other) {
            return other.rays_kind == row.rays_kind && other.threads == row.threads;
        });
        EXPECT_EQ(row.rays_kind, first.rays_kind);
        EXPECT_EQ(row.threads, first.threads);
        EXPECT_EQ(row.rays, first.rays);
        EXPECT_GE(row.ms.size(), settings.least_rounds);
        EXPECT_EQ(row.refused, 0u);
        EXPECT_GT(row.bytes, 0u);
        EXPECT_GE(row.errors.judged, settings.sample_count);
        EXPECT_TRUE(row.holds()) << row.contestant;
        if (row.mode == "exact") {
            EXPECT_EQ(row.errors.wrong() + row.errors.ties, 0u) << row.contestant << " " << row.rays_kind;
            EXPECT_EQ(row.hits_hash, first.hits_hash);
            EXPECT_GT(row.over_fast, 0.0);
        }
        if (settings.variants.empty()) {
            EXPECT_TRUE(std::isnan(row.ratio.value));
        } else if (row.contestant == row.best_peer) {
            EXPECT_EQ(row.ratio.value, 1.0);
        } else if (row.is_peer()) {
            EXPECT_LE(row.ratio.value, 1.0);
        }
    }
    // The number of threads changes no answer.
    for (size_t i = 0; i < rows.size() / 2; ++i)
        EXPECT_EQ(rows[i].hits_hash, rows[i + rows.size() / 2].hits_hash);
    EXPECT_EQ(rows[0].is_peer(), false);
    for (const char* key : {"contestant", "rays_kind", "threads", "ratio", "wrong", "build_ms", "bytes"})
        EXPECT_NE(report_row(rows.back()).find(key), nullptr) << key;
}

TEST(Peers, WithoutPeersBoxwoodStandsAlone) {
    const auto scene = scene_of("two-triangles");
    PeerSettings settings = quick(*scene);
    settings.with_fast_mode = false;
    settings.kinds = {"primary", "shadow"};
    Task task;
    const std::vector<PeerRow> rows = run_peers(scene, settings, task);
    ASSERT_EQ(rows.size(), 4u);
    for (const PeerRow& row : rows) {
        EXPECT_EQ(row.best_peer, "");
        EXPECT_TRUE(std::isnan(row.ratio.value));
        EXPECT_TRUE(std::isnan(row.over_fast));
        EXPECT_GT(row.mrays_per_s(), 0.0);
    }
    EXPECT_TRUE(summarize(rows).empty());
}

TEST(Embree, GivesTheSameHitsAwayFromEdges) {
    if (!has_embree()) GTEST_SKIP() << "built without Embree";
    const auto scene = scene_of("terrain@tris=5k");
    const Structure structure = structure_of(scene->mesh);
    PeerSettings settings = quick(*scene);
    settings.size = 37;  // no whole number of packets
    Task task;
    const std::vector<Ray> rays = peer_rays(structure, *scene, settings, task).front().rays;
    std::vector<Hit> expected(rays.size()), single(rays.size()), packets(rays.size());
    std::vector<uint8_t> occluded(rays.size());
    structure.closest_hits(scene->mesh, rays, expected, Mode::Exact, task);
    for (const std::span<const EmbreeVariant> variants : {embree_variants(), embree_builds()}) {
        for (const EmbreeVariant& variant : variants) {
            EmbreeScene embree(scene->mesh, variant);
            embree.build();
            EXPECT_GT(embree.byte_count(), 16 * scene->mesh.triangle_count()) << variant.name;
            EXPECT_LT(embree.byte_count(), 4000 * scene->mesh.triangle_count()) << variant.name;
            embree.closest_hits(rays, single);
            embree.closest_hits_in_packets(rays, packets);
            embree.any_hits(rays, occluded);
            size_t same = 0, alike = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                same += single[i].prim == expected[i].prim ? 1 : 0;
                alike += packets[i].prim == expected[i].prim ? 1 : 0;
                EXPECT_EQ(occluded[i] != 0, single[i].is_hit());
                if (single[i].prim != expected[i].prim || !expected[i].is_hit()) continue;
                EXPECT_NEAR(single[i].t, expected[i].t, 1e-4f * expected[i].t);
            }
            EXPECT_GE(same + 3, rays.size()) << variant.name;
            EXPECT_GE(alike + 3, rays.size()) << variant.name;
        }
    }
}

TEST(Builds, RoundsMeetAllAndThePeersStandBeside) {
    const auto scene = scene_of("cornell");
    BuildSettings settings;
    settings.recipes = {parse_recipe("bvh-sweep-sah"), parse_recipe("esc(s=8) > bvh-binned-sah")};
    settings.variants.assign(embree_builds().begin(), embree_builds().end());
    settings.threads = {1, 2};
    settings.rounds = 3;
    Task task;
    const std::vector<BuildRow> rows = run_builds(*scene, settings, task);
    const size_t in_part = settings.recipes.size() + settings.variants.size();
    ASSERT_EQ(rows.size(), 2 * in_part);
    for (size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].threads, i < in_part ? 1 : 2);
        EXPECT_EQ(rows[i].ms.size(), 3u);
        EXPECT_GT(rows[i].bytes, 0u);
        EXPECT_EQ(rows[i].over_peers.size(), settings.variants.size());
        for (const auto& [peer, ratio] : rows[i].over_peers) {
            EXPECT_GT(ratio.value, 0.0);
            EXPECT_EQ(ratio.value == 1.0 && ratio.lower == 1.0 && ratio.upper == 1.0,
                      peer == rows[i].contestant);
        }
    }
    EXPECT_EQ(rows[0].contestant, "boxwood:bvh-sweep-sah");
    EXPECT_EQ(rows[0].references, scene->mesh.triangle_count());
    EXPECT_GT(rows[1].references, scene->mesh.triangle_count());
    const NodeList nodes = structure_of(scene->mesh).list_nodes();
    EXPECT_EQ(rows[0].sah_cost, tree_stats(make_level_table(nodes)).sah_cost);
    EXPECT_EQ(rows[in_part].sah_cost, rows[0].sah_cost);
    EXPECT_EQ(task.done, task.total);
    const ReportRow cells = report_row(rows[0]);
    EXPECT_EQ(cells.find("over_low") != nullptr, has_embree());
}

TEST(Builds, ATransformOfAnotherFrameIsRefused) {
    const auto scene = scene_of("kitchen@frame=0");
    Task task;
    EXPECT_THROW(build_timed(parse_recipe("bvh-sweep-sah > refit"), scene->mesh, 1, task), Error);
}

TEST(Peers, TheTableOfRatiosHasOneColumnForEachKindOfRays) {
    std::vector<PeerRow> rows(4);
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].scene = "folder/bunny.obj";
        rows[i].contestant = i % 2 == 0 ? "boxwood:x" : "embree:high";
        rows[i].rays_kind = kRayKinds[i < 2 ? 0 : 3];
        rows[i].ratio.value = static_cast<double>(i);
    }
    rows[3].contestant += " packets16";
    const std::vector<ReportRow> table = ratio_table(rows);
    ASSERT_EQ(table.size(), 2u);
    EXPECT_EQ(std::get<std::string>(*table[1].find("scene")), "bunny.obj");
    EXPECT_EQ(std::get<std::string>(*table[1].find("contestant")), "embree:high");
    EXPECT_EQ(std::get<double>(*table[1].find("primary")), 1.0);
    EXPECT_EQ(std::get<double>(*table[1].find("primary packets")), 3.0);
    EXPECT_EQ(std::get<double>(*table[0].find("primary packets")), 2.0);
}

PeerRow sized(uint64_t triangles, double build_ms, uint64_t bytes, double ms) {
    PeerRow row;
    row.contestant = "boxwood:x";
    row.recipe = "x";
    row.rays_kind = "primary";
    row.triangles = triangles;
    row.build_ms = build_ms;
    row.bytes = bytes;
    row.rays = 1000;
    row.ms = {ms};
    return row;
}

TEST(Scale, FactorsAreThoseOfWhatATriangleTakes) {
    // 1 Mray/s times 10, 0.5 times 20, 0.25 times 12: 10, 10, 3. The order of the rows does not matter.
    const std::vector<PeerRow> rows{sized(1u << 12, 8.0, 4u << 12, 4.0), sized(1u << 10, 1.0, 4u << 10, 1.0),
                                    sized(1u << 20, 1024.0, 6u << 20, 2.0)};
    EXPECT_DOUBLE_EQ(rate_by_depth(rows[0]), 3.0);
    EXPECT_DOUBLE_EQ(rate_by_depth(rows[2]), 10.0);
    const std::vector<ScaleSummary> summaries = summarize_scale(rows);
    ASSERT_EQ(summaries.size(), 1u);
    EXPECT_EQ(summaries[0].least_triangles, 1u << 10);
    EXPECT_EQ(summaries[0].most_triangles, 1u << 20);
    EXPECT_DOUBLE_EQ(summaries[0].build_factor, 2.0);
    EXPECT_DOUBLE_EQ(summaries[0].bytes_factor, 1.5);
    EXPECT_DOUBLE_EQ(summaries[0].rate_fall, 10.0 / 3.0);  // what comes after, 10, does not make it good
}

TEST(Timing, APinnedThreadStaysOnItsCoreUntilThePinEnds) {
    cpu_set_t before, pinned, after;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    {
        const CorePin pin;
        if (!pin.is_pinned()) GTEST_SKIP() << "threads cannot be pinned here";
        ASSERT_EQ(sched_getaffinity(0, sizeof pinned, &pinned), 0);
        EXPECT_EQ(CPU_COUNT(&pinned), 1);
    }
    ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
    EXPECT_TRUE(CPU_EQUAL(&before, &after));
    EXPECT_FALSE(flushes_to_zero());
}

}  // namespace
}  // namespace boxwood::bench
