#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/peer_options.h"
#include "app/command/shared.h"
#include "bench/builds.h"

namespace boxwood {

ExitCode run_bench_builds(Arguments arguments) {
    std::vector<std::string> scenes, texts;
    std::string json;
    PeerOptions peer_options(bench::embree_builds());
    bench::BuildSettings settings;
    Options options(
        "bench builds",
        "Measures what builds take, in turns with those of Embree: milliseconds, bytes, SAH cost.");
    options.texts("-s,--scene", "SCENE", scenes, "scene; may be given several times (default: terrain)");
    options.texts("-r,--recipe", "RECIPE", texts,
                  "structure; may be given several times (default: every builder of binary BVHs)");
    peer_options.add_to(options);
    options.integer("--rounds", settings.rounds, 1, 1000000, "builds of each (default: 5)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.footer(
        "Times: one thread by its processor time, more by the wall clock; rounds over all recipes, peers "
        "and\n"
        "numbers of threads in random order; build_ms is the median of references, builder and transforms "
        "(of\n"
        "Embree: of the commit of its scene), least_ms the least. over_low, over_medium, over_high: time "
        "over\n"
        "that of the peer on as many threads.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    settings.recipes = texts.empty() ? bench::bvh_recipes() : parse_recipes(texts);
    settings.variants = peer_options.peers();
    settings.threads = peer_options.threads();
    if (scenes.empty()) scenes.push_back("terrain");
    check_json_file(json);

    Report report{"bench builds", scenes, {}, {}};
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        Task task;
        const Progress progress(scene->title + ": builds", task);
        for (const bench::BuildRow& row : bench::run_builds(*scene, settings, task))
            report.rows.push_back(report_row(row));
    });
    if (!report.rows.empty()) print_report(report, json);
    return result;
}

}  // namespace boxwood
