#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/tree_promises.h"

namespace boxwood {
namespace {

constexpr const char* kTreesFooter =
    "A promise is VALUE: RECIPE <= [FACTOR *] RECIPE, for example\n"
    "\"sah_cost: bvh-sweep-sah <= 1.1 * bvh-binned-sah\". Values: sah_cost, in triangle tests;\n"
    "wide_cost, of wide BVHs, with the costs of nodes and packs of wide4, wide8 and wide16;\n"
    "references in leaves; nodes; bytes.\n"
    "Exit code 1 where a promise does not hold on a scene.\n\n";

}  // namespace

ExitCode run_bench_trees(Arguments arguments) {
    std::vector<std::string> scenes, texts;
    std::string json;
    Options options("bench trees", "Checks what builders and transforms promise about their trees.");
    options.texts("-s,--scene", "SCENE", scenes,
                  "scene; may be given several times (default: atrium, spaceship and kitchen)");
    options.texts("-p,--promise", "PROMISE", texts,
                  "may be given several times (default: those of the catalog's methods)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.footer(kTreesFooter + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    if (scenes.empty()) scenes = {"atrium", "spaceship", "kitchen"};
    if (texts.empty()) texts.assign(bench::catalog_promises().begin(), bench::catalog_promises().end());
    std::vector<bench::TreePromise> promises;
    for (const std::string& text : texts) promises.push_back(bench::parse_promise(text));
    check_json_file(json);

    Report report{"bench trees", scenes, {}, {}};
    bool all_hold = true;
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        StageCache cache;
        for (const bench::TreePromise& promise : promises) {
            Task task;
            const Progress progress(scene->title + ": " + bench::print(promise), task);
            const bench::KeptPromise kept = bench::check_promise(promise, scene, cache, task);
            report.rows.push_back(bench::promise_row(promise, kept, *scene));
            all_hold = all_hold && kept.holds;
        }
    });
    if (!report.rows.empty()) print_report(report, json);
    return all_hold ? result : ExitCode::CheckFailed;
}

}  // namespace boxwood
