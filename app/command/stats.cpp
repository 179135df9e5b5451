#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "core/measure/end_point_overlap.h"
#include "core/measure/tree_stats.h"

namespace boxwood {
namespace {

double epo_of(const Built& built) {
    Task task;
    const Progress progress(built.scene->title + ": end-point overlap of " + print(built.recipe), task);
    return end_point_overlap(built.levels->list, built.scene->mesh, task).total;
}

ReportRow stats_row(const Built& built) {
    const TreeStats stats = tree_stats(*built.levels);
    std::map<std::string, uint64_t> skipped = built.scene->skipped;
    for (const auto& [reason, count] : built.skipped) skipped[reason] += count;
    if (const size_t point_count = built.scene->mesh.points.positions.size())
        skipped["point without surface"] += point_count;
    return row_of(*built.scene, built.recipe)
        .set("triangles", uint64_t{built.scene->mesh.triangle_count()})
        .set("references", stats.references)
        .set("references_made", uint64_t{built.references->refs.size()})
        .set("nodes", stats.nodes)
        .set("leaves", stats.leaves)
        .set("levels", uint64_t{stats.levels.size()})
        .set("bytes", uint64_t{built.structure.byte_count()})
        .set("sah_cost", stats.sah_cost)
        .set("epo", epo_of(built))
        .set("build_ms", built.references_ms + built.build_ms)
        .set("skipped", skipped);
}

}  // namespace

ExitCode run_stats(Arguments arguments) {
    std::vector<std::string> scenes;
    std::vector<std::string> texts;
    std::string json;
    int threads = 0;
    Options options("stats", "Builds structures over scenes and prints what they are made of.");
    options.arguments("SCENE", scenes, "files or built-in names");
    options.texts("-r,--recipe", "RECIPE", texts,
                  "what to build; may be given several times (default: evh(t=14) > bvh-binned-sah)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads to build with (default: all)");
    options.footer(
        "references: primitives in leaves, each once a leaf; references_made: before duplicates were "
        "removed;\n"
        "bytes: of the structure; sah_cost: expected cost of a random ray in triangle tests; epo: cost of "
        "nodes\n"
        "around a random point of the surface that its triangle is not in, - where nodes are no boxes;\n"
        "build_ms: references and builder; skipped: what was left out or needed no work, by reason.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    if (texts.empty()) texts.push_back(kDefaultRecipe);
    const std::vector<Recipe> recipes = parse_recipes(texts);
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"stats", scenes, {}, {}};
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        StageCache cache;
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        for (const Recipe& recipe : recipes)
            report.rows.push_back(stats_row(build_shown(recipe, scene, cache, /*with_levels=*/true)));
    });
    if (!report.rows.empty()) print_report(report, json);
    return result;
}

}  // namespace boxwood
