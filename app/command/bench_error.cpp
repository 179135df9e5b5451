#include <algorithm>
#include <cmath>

#include "app/cli/camera_options.h"
#include "app/cli/options.h"
#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/error.h"

namespace boxwood {
namespace {

using bench::ErrorRow;
using bench::ErrorSettings;

constexpr const char* kSeriesNames[] = {"none", "scale", "offset"};
constexpr int kScaleExponents[] = {-30, -20, -15, -10, -5, 0, 5, 10, 15, 20, 30};
constexpr int kOffsetExponents[] = {0, 1, 2, 3, 4, 5, 6, 7};

/// Every exact builder over whole boxes and over edge volume references; brute force would take hours.
std::vector<Recipe> compared_recipes() {
    std::vector<Recipe> recipes;
    for (const char* references : {"", "evh(t=14) > "})
        for (const CatalogEntry& builder : builder_catalog())
            if (builder.exact && std::string(builder.id) != "none")
                recipes.push_back(parse_recipe(references + std::string(builder.id)));
    return recipes;
}

/// One scene of a series: its spec, and what the plots put on their axis.
struct SeriesStep {
    std::string spec;
    const char* key = nullptr;
    double value = 0.0;
};

/// The scene at several scales, or moved by multiples of its extent along all axes.
std::vector<SeriesStep> series_of(const std::string& spec, size_t series) {
    if (series == 0) return {{spec}};
    std::vector<SeriesStep> steps;
    if (series == 1) {
        for (const int exponent : kScaleExponents) {
            const double scale = std::pow(10.0, exponent);
            steps.push_back({spec + "@scale=" + shortest(scale), "scale", scale});
        }
        return steps;
    }
    const Vec3 extent = Vec3(open_surface(spec)->mesh.bounds().extent());
    const double longest = static_cast<double>(std::max({extent.x, extent.y, extent.z}));
    for (const int exponent : kOffsetExponents) {
        const double offset = std::pow(10.0, exponent);
        const std::string move = shortest(offset * longest);
        steps.push_back({spec + "@move=" + move + "," + move + "," + move, "offset", offset});
    }
    return steps;
}

}  // namespace

ExitCode run_bench_error(Arguments arguments) {
    std::vector<std::string> scenes;
    std::vector<std::string> texts;
    std::string json;
    int ray_count = 100000, sample_count = 2000, rounds = 7, threads = 0;
    size_t series = 0;
    CameraOptions camera_options;
    ErrorSettings settings;
    Options options(
        "bench error",
        "Measures run time against error: rays per second of exact mode, fast mode and plain double "
        "precision, and how their answers differ from those of rational arithmetic.");
    options.texts("-s,--scene", "SCENE", scenes, "scene; may be given several times (default: atrium)");
    options.texts("-r,--recipe", "RECIPE", texts,
                  "structure; may be given several times (default: every exact builder over whole and over "
                  "evh(t=14))");
    options.integer("-n,--rays", ray_count, 1, 100000000,
                    "rays of each kind: primary, and one diffuse bounce (default: 100000)");
    options.integer("--sample", sample_count, 1, 100000000,
                    "of them judged by rational arithmetic (default: 2000)");
    options.real("--seconds", settings.seconds, 0.0, 1e6,
                 "time for the rounds of each kind of rays, at least; 0: errors only (default: 5)");
    options.integer("--rounds", rounds, 1, 1000000, "rounds, at least (default: 7)");
    options.choice("--series", series, kSeriesNames,
                   "each scene again at scales from 1e-30 to 1e30, or moved by 1 to 1e7 times its extent");
    camera_options.add_to(options);
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads to build and to judge with (default: all)");
    options.footer(
        "Times: one thread; processor time; rounds over all structures and contestants in random order, "
        "after\n"
        "one to warm up; trace_ms is the median, mrays_min and mrays_max the extremes, over_fast the median\n"
        "of the ratios to fast mode within a round. A time counts only if the answers of its round have the\n"
        "hash of those that were judged. wrong_plain: hit or miss differs on a ray that is not within "
        "rounding\n"
        "of an edge; wrong_sensitive: on one that is; wrong_prims: another primitive than the nearest. Exits "
        "1\n"
        "if exact mode has a wrong answer, fast mode one on a plain ray or a t beyond its bound, or if "
        "answers\n"
        "changed between rounds. bench/plots.py draws the JSON.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    settings.recipes = texts.empty() ? compared_recipes() : parse_recipes(texts);
    settings.ray_count = static_cast<size_t>(ray_count);
    settings.sample_count = static_cast<size_t>(sample_count);
    settings.least_rounds = static_cast<uint64_t>(rounds);
    if (scenes.empty()) scenes.push_back("atrium");
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"bench error", scenes, {}, {}};
    bool holds = true;
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        for (const SeriesStep& step : series_of(spec, series)) {
            const std::shared_ptr<const Scene> scene = open_surface(step.spec);
            settings.camera = camera_options.camera(*scene);
            Task task;
            const Progress progress(scene->title + ": run time against error", task);
            for (const ErrorRow& row : bench::run_error(scene, settings, task)) {
                report.rows.push_back(report_row(row));
                if (step.key != nullptr) report.rows.back().set(step.key, step.value);
                holds = holds && row.holds();
            }
        }
    });
    if (!report.rows.empty()) print_report(report, json);
    return holds ? result : ExitCode::CheckFailed;
}

}  // namespace boxwood
