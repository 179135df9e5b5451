#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/bench_structures.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/measures.h"

namespace boxwood {
namespace {

constexpr const char* kMeasuresFooter =
    "Measures of a tree, in triangle tests where not said otherwise:\n"
    "  sah_cost      expected cost of a random ray that meets the scene's box\n"
    "  epo           end-point overlap: cost of nodes around a random point of the surface that its\n"
    "                triangle is not in\n"
    "  sah_epo       (1 - alpha) sah_cost + alpha epo; each scene with the alpha that fits the others best\n"
    "  lcv           standard deviation of the number of leaves that a random line meets\n"
    "  overlap       area of all siblings' common boxes over the area of the scene's box\n"
    "  empty_volume  mean share of an inner node's box that no child covers\n"
    "  leaf_size_variation  standard deviation of the leaves' sizes over their mean\n"
    "  steps_per_ray nodes visited and triangles tested, counted for the rays that are timed\n"
    "pearson: of logarithms of measure and time per ray, minus their means over a scene; spearman: of "
    "ranks,\n"
    "mean over the scenes. 1: the measure tells the time, 0: it says nothing about it. Structures whose "
    "nodes\n"
    "are no boxes have no epo and no lcv and are left out. Fast ones: at most 1.5 times as slow as the "
    "scene's\n"
    "fastest BVH. One thread, processor time; rounds over all\n"
    "structures in random order; medians. bench/plots.py draws the JSON.\n\n";

}  // namespace

ExitCode run_bench_measures(Arguments arguments) {
    StructureOptions shared;
    Options options("bench measures",
                    "Sets the measures of trees beside the rays per second that they give: which of them "
                    "tells how fast a structure is?");
    bench::StructureSettings initial;
    initial.ray_count = 20000;
    initial.builds = 1;
    initial.patience = 30.0;
    initial.rates.round_ms = 12.0;
    shared.add_to(options, "scene; may be given several times (default: atrium, spaceship and kitchen)",
                  initial, "every builder, and references and transforms on common ones");
    options.footer(kMeasuresFooter + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    check_json_file(shared.json());
    shared.recipes();  // all are checked before one is built
    Report report{"bench measures", shared.scenes({"atrium", "spaceship", "kitchen"}), {}, {}};
    std::vector<bench::MeasuredScene> measured;
    const ExitCode result = for_each_scene(report.scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        bench::StructureSettings settings = shared.settings(*scene);
        settings.with_measures = true;
        if (settings.recipes.empty())
            settings.recipes = bench::recipes_to_measure(scene->mesh.triangle_count());
        Task task;
        const Progress progress(scene->title + ": measures of trees", task);
        measured.push_back({scene->title, bench::measure_structures(scene, settings, task)});
        for (const bench::MeasuredStructure& structure : measured.back().structures)
            report.rows.push_back(bench::measures_row(structure, *scene));
    });
    if (report.rows.empty()) return result;
    std::vector<ReportRow> predictions;
    for (const bench::Prediction& prediction : bench::predictions(measured))
        predictions.push_back(bench::prediction_row(prediction));
    if (shared.json() != "-")
        std::fputs((to_table(report.rows) + "\n" + to_table(predictions)).c_str(), stdout);
    report.tables = {{"predictions", std::move(predictions)}};
    if (!shared.json().empty()) write_json(report, shared.json());
    return result;
}

}  // namespace boxwood
