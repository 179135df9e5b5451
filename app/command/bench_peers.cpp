#include <algorithm>
#include <cstdio>

#include "app/cli/camera_options.h"
#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/peer_options.h"
#include "app/command/shared.h"
#include "bench/peers.h"

namespace boxwood {
namespace {

using bench::PeerRow;

constexpr const char* kPeersFooter =
    "Rays: through the pixel centres; one cosine-distributed bounce from each hit; a shadow ray from each\n"
    "hit that faces the light, to a point light up and to the right of the eye, half way to what stands\n"
    "there, at most half the scene's diagonal far. One after the other in that order, t and primitive (or\n"
    "one byte) written for each. \"primary packets\": in blocks of 4 x 4, Embree by packets of 16; RECIPE\n"
    "renderer: the renderer, which makes the rays too. Times: one thread pinned to a core and its\n"
    "processor time, or more and the wall clock; rounds over all contestants in random order after one\n"
    "that warms up; medians. ratio: rate over that of the best peer in its cell, ratio_low and ratio_high\n"
    "hold 95 % of its bootstrap. wrong: of the rays judged, a sample and every ray that contestants answer\n"
    "differently (disputed; at most 10 times the sample). ties: another primitive at exactly the same t.\n"
    "Exits 1 if exact mode has a wrong answer, or if answers changed between rounds. bench/plots.py draws\n"
    "the JSON.\n\n";

void print_peer_tables(const std::vector<PeerRow>& rows, Report& report, const std::string& json) {
    std::vector<ReportRow> shown, summary;
    for (const PeerRow& row : rows) {
        report.rows.push_back(report_row(row));
        shown.push_back(short_row(row));
    }
    for (const bench::RatioSummary& one : bench::summarize(rows)) summary.push_back(report_row(one));
    const std::vector<ReportRow> ratios = ratio_table(rows);
    report.tables.emplace_back("summary", summary);
    report.tables.emplace_back("ratios", ratios);
    report.tables.emplace_back("embree", std::vector{ReportRow().set("version", bench::embree_version())});
    if (json != "-") {
        std::printf("%s\n%s\n%s", to_table(shown).c_str(), to_table(ratios).c_str(),
                    to_table(summary).c_str());
    }
    if (!json.empty()) write_json(report, json);
}

}  // namespace

ExitCode run_bench_peers(Arguments arguments) {
    std::vector<std::string> scenes, texts, kinds;
    std::string json;
    int sample_count = 2000, rounds = 7;
    bool exact_only = false;
    CameraOptions camera_options;
    PeerOptions peer_options(bench::embree_variants());
    bench::PeerSettings settings;
    Options options("bench peers",
                    "Measures recipes side by side with Embree: the same rays, the same clock, the same "
                    "answers written; wrong answers counted by exact arithmetic.");
    options.texts("-s,--scene", "SCENE", scenes, "scene; may be given several times (default: atrium)");
    options.texts("-r,--recipe", "RECIPE", texts, "structure; may be given several times");
    peer_options.add_to(options);
    options.texts(
        "-k,--kind", "KIND", kinds,
        "primary, diffuse, shadow or \"primary packets\"; may be given several times (default: all)");
    options.integer("--size", settings.size, 1, 16384,
                    "the camera's picture, pixels along a side (default: 1024)");
    options.integer("--rounds", rounds, 1, 1000000, "rounds, at least (default: 7)");
    options.real("--seconds", settings.seconds, 0.0, 1e6,
                 "time for the rounds of each kind of rays, at least (default: 2)");
    options.integer("--sample", sample_count, 0, 100000000,
                    "rays of each kind judged by exact arithmetic, besides those disputed (default: 2000)");
    options.integer("--builds", settings.builds, 1, 1000,
                    "builds of each structure; of several, after one more (default: 1)");
    options.flag("--exact-only", exact_only, "leave out fast mode");
    camera_options.add_to(options);
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.footer(kPeersFooter + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    settings.recipes = texts.empty() ? bench::quality_recipes() : parse_recipes(texts);
    settings.threads = peer_options.threads();
    settings.kinds =
        checked_words("--kind", kinds, {std::begin(bench::kRayKinds), std::end(bench::kRayKinds)});
    settings.variants = peer_options.peers();
    settings.with_fast_mode = !exact_only;
    settings.sample_count = static_cast<size_t>(sample_count);
    settings.least_rounds = static_cast<uint64_t>(rounds);
    if (scenes.empty()) scenes.push_back("atrium");
    check_json_file(json);

    Report report{"bench peers", scenes, {}, {}};
    std::vector<PeerRow> rows;
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        settings.camera = camera_options.camera(*scene);
        Task task;
        const Progress progress(scene->title + ": peers", task);
        for (PeerRow& row : bench::run_peers(scene, settings, task)) rows.push_back(std::move(row));
    });
    if (!rows.empty()) print_peer_tables(rows, report, json);
    return std::ranges::all_of(rows, &PeerRow::holds) ? result : ExitCode::CheckFailed;
}

}  // namespace boxwood
