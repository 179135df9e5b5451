#include "app/cli/progress.h"
#include "app/command/bench_structures.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/refit_frames.h"
#include "core/scene/frame.h"

namespace boxwood {
namespace {

/// Every builder whose structure `refit` takes.
std::vector<Recipe> refittable() {
    const CatalogEntry& refit = *find_entry("refit");
    std::vector<Recipe> recipes;
    for (const CatalogEntry& builder : builder_catalog())
        if (std::string(builder.output) == refit.input) recipes.push_back(parse_recipe(builder.id));
    return recipes;
}

/// Throws Error for what is no builder over whole triangles that `refit` takes.
void check(const std::vector<Recipe>& recipes) {
    for (const Recipe& recipe : recipes) {
        parse_recipe(print(recipe) + " > refit");
        if (recipe.references.text() == kWholeReferences && recipe.transforms.empty()) continue;
        throw Error(ExitCode::WrongUsage,
                    "\"" + print(recipe) +
                        "\": a builder over whole triangles was expected, to be built again "
                        "and refitted");
    }
}

}  // namespace

ExitCode run_bench_refit(Arguments arguments) {
    StructureOptions shared;
    int from = 0, every = 10;
    Options options(
        "bench refit",
        "Measures refit against rebuild, frame by frame of an animated scene: times, SAH cost, rays per "
        "second.");
    shared.add_to(options, "animated scene; may be given several times (default: kitchen)");
    options.integer("--from", from, 0, kMostFrames - 1,
                    "frame that the refitted trees are built on (default: 0)");
    options.integer("--every", every, 1, kMostFrames, "measure every so many frames (default: 10)");
    options.footer(
        "One thread, processor time; rounds over all structures of a frame in random order; medians.\n"
        "build_ms: the builder alone; refit_ms: the refit alone; sah_cost, *_mrays_per_s: of the tree\n"
        "built on the frame, and with refit_ before them of the tree of frame --from, refitted.\n"
        "Recipes: builders over whole triangles (default: every one that can be refitted).\n"
        "bench/plots.py draws the JSON.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    check_json_file(shared.json());
    bench::RefitSettings settings;
    settings.recipes = shared.recipes();
    check(settings.recipes);
    if (settings.recipes.empty()) settings.recipes = refittable();
    settings.from = from;

    Report report{"bench refit", shared.scenes({"kitchen"}), {}, {}};
    const ExitCode result = for_each_scene(report.scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(with_frame(spec, from));
        const bench::StructureSettings common = shared.settings(*scene);
        settings.camera = common.camera;
        settings.ray_count = common.ray_count;
        settings.builds = common.builds;
        settings.rates = common.rates;
        settings.frames.clear();
        for (int frame = 0; frame < scene_frame(spec)->count; frame += every)
            settings.frames.push_back(frame);
        Task task;
        const Progress progress(scene->title + ": refit against rebuild", task);
        for (const bench::RefitRow& row : bench::run_refit_frames(spec, settings, task))
            report.rows.push_back(bench::report_row(row));
    });
    if (!report.rows.empty()) print_report(report, shared.json());
    return result;
}

}  // namespace boxwood
