#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/peer_options.h"
#include "app/command/shared.h"
#include "bench/scale.h"
#include "core/scene/suffix_value.h"

namespace boxwood {
namespace {

constexpr const char* kSizes[] = {"100k", "200k", "500k", "1M", "2M", "5M", "10M"};

constexpr const char* kScaleFooter =
    "Rays, clocks and rounds are those of `bench peers`, exact mode. mrays_by_log2: millions of rays per\n"
    "second times log2 of the number of triangles. The second table: build_factor and bytes_factor,\n"
    "largest over least of what a triangle takes; rate_fall, most by which a size's mrays_by_log2 lies\n"
    "below that of a smaller one. bench/plots.py draws the JSON.\n\n";

double count_of(const char* option, const std::string& text) {
    const std::optional<double> count = count_value(text);
    if (count && *count >= 1.0) return *count;
    throw Error(ExitCode::WrongUsage, std::string(option) + " " + to_utf8(text) +
                                          ": expected a number of triangles, such as 500k or 10M");
}

/// Those of the sizes that are not beyond `most`, in the order given.
std::vector<std::string> sizes_up_to(const std::string& most, const std::vector<std::string>& sizes) {
    std::vector<std::string> kept;
    const double limit = count_of("--most", most);
    for (const std::string& text : sizes)
        if (count_of("--tris", text) <= limit) kept.push_back(text);
    return kept;
}

void print_scale_tables(const std::vector<bench::PeerRow>& rows, Report& report, const std::string& json) {
    std::vector<ReportRow> shown, summary;
    for (const bench::PeerRow& row : rows) {
        report.rows.push_back(bench::scale_row(row));
        shown.push_back(bench::short_scale_row(row));
    }
    for (const bench::ScaleSummary& one : bench::summarize_scale(rows)) summary.push_back(report_row(one));
    report.tables.emplace_back("summary", summary);
    if (json != "-") std::printf("%s\n%s", to_table(shown).c_str(), to_table(summary).c_str());
    if (!json.empty()) write_json(report, json);
}

}  // namespace

ExitCode run_bench_scale(Arguments arguments) {
    std::vector<std::string> sizes, texts;
    std::string json;
    std::string most = "10M";
    int rounds = 5;
    PeerOptions peer_options(bench::embree_variants());
    bench::PeerSettings settings;
    settings.sample_count = 500;
    settings.seconds = 1.0;
    settings.builds = 3;
    settings.kinds = {bench::kRayKinds[0], bench::kRayKinds[1]};
    Options options("bench scale",
                    "Measures one terrain in growing sizes: build time and bytes for each triangle, rays per "
                    "second by depth.");
    options.texts(
        "-n,--tris", "N", sizes,
        "triangles, such as 500k; may be given several times (default: 100k, 200k, 500k, 1M, 2M, 5M "
        "and 10M)");
    options.text("--most", "N", most, "leave out sizes beyond this (default: 10M)");
    options.texts("-r,--recipe", "RECIPE", texts, "structure; may be given several times");
    peer_options.add_to(options);
    options.integer("--size", settings.size, 1, 16384,
                    "the camera's picture, pixels along a side (default: 1024)");
    options.integer("--rounds", rounds, 1, 1000000, "rounds, at least (default: 5)");
    options.real("--seconds", settings.seconds, 0.0, 1e6,
                 "time for the rounds of each kind of rays, at least (default: 1)");
    options.integer("--builds", settings.builds, 1, 1000,
                    "builds of each structure, after one more (default: 3)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.footer(kScaleFooter + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    settings.recipes = texts.empty() ? bench::quality_recipes() : parse_recipes(texts);
    settings.threads = peer_options.threads();
    settings.variants = peer_options.peers();
    settings.with_fast_mode = false;
    settings.least_rounds = static_cast<uint64_t>(rounds);
    if (sizes.empty()) sizes.assign(std::begin(kSizes), std::end(kSizes));
    check_json_file(json);

    Report report{"bench scale", {}, {}, {}};
    std::vector<bench::PeerRow> rows;
    for (const std::string& text : sizes_up_to(most, sizes)) {
        const std::string spec = "terrain@tris=" + text;
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        report.scenes.push_back(spec);
        settings.camera = scene->camera.value_or(fit_camera(scene->mesh.bounds()));
        Task task;
        const Progress progress(scene->title + ": scale", task);
        for (bench::PeerRow& row : bench::run_peers(scene, settings, task)) rows.push_back(std::move(row));
    }
    print_scale_tables(rows, report, json);
    return ExitCode::Done;
}

}  // namespace boxwood
