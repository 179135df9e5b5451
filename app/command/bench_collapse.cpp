#include <algorithm>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/timing.h"
#include "core/wide_bvh/collapse.h"

namespace boxwood {
namespace {

/// What one way of collapsing made.
struct Collapsed {
    double cost = 0.0;  ///< wide_cost
    double ms = 0.0;
    size_t bytes = 0, nodes = 0, leaves = 0, packs = 0, children = 0, triangles = 0;
};

template <uint32_t Width>
Collapsed collapse(const Mesh& mesh, const Bvh2& input, const Collapse<Width>& method, int builds,
                   Task& task) {
    Collapsed result;
    std::vector<double> times;
    WideBvh<Width> wide;
    for (int i = 0; i < builds; ++i) {
        const double begin = bench::process_ms();
        wide = method.apply(mesh, {}, input, task);
        times.push_back(bench::process_ms() - begin);
    }
    result.ms = bench::median_of(std::move(times));
    result.cost =
        wide_cost(wide, {static_cast<double>(method.node_cost), static_cast<double>(method.pack_cost)});
    result.bytes = wide.byte_count();
    result.nodes = wide.nodes.size();
    result.leaves = wide.leaf_count;
    result.packs = wide.packs.size();
    for (const auto& node : wide.nodes)
        for (const WideChild child : node.children) result.children += child.is_empty() ? 0 : 1;
    for (const auto& pack : wide.packs) result.triangles += pack.count();
    return result;
}

/// Both ways over a built tree.
template <uint32_t Width>
ReportRow collapse_row(const Built& built, int builds) {
    const Mesh& mesh = built.scene->mesh;
    const Bvh2& input = *built.structure.as<Bvh2>();
    Task task;
    const Progress progress(built.scene->title + ": collapsing", task);
    Collapse<Width> method;
    const Collapsed optimal = collapse(mesh, input, method, builds, task);
    method.way = Collapse<Width>::Greedy;
    const Collapsed greedy = collapse(mesh, input, method, builds, task);
    const auto quotient = [](size_t a, size_t b) {
        return static_cast<double>(a) / static_cast<double>(std::max(b, size_t{1}));
    };
    const Recipe recipe = parse_recipe(print(built.recipe) + " > wide" + std::to_string(Width));
    return row_of(*built.scene, recipe)
        .set("triangles", uint64_t{mesh.triangle_count()})
        .set("greedy_cost", greedy.cost)
        .set("optimal_cost", optimal.cost)
        .set("ratio", greedy.cost > 0.0 ? optimal.cost / greedy.cost : 1.0)
        .set("nodes", uint64_t{optimal.nodes})
        .set("leaves", uint64_t{optimal.leaves})
        .set("children_per_node", quotient(optimal.children, optimal.nodes))
        .set("triangles_per_pack", quotient(optimal.triangles, optimal.packs))
        .set("greedy_bytes", uint64_t{greedy.bytes})
        .set("bytes", uint64_t{optimal.bytes})
        .set("build_ms", optimal.ms);
}

/// Whether the least cost is no more than the greedy one's, but for the rounding of the two sums.
bool holds(const ReportRow& row) { return std::get<double>(*row.find("ratio")) <= 1.0 + 1e-12; }

}  // namespace

ExitCode run_bench_collapse(Arguments arguments) {
    std::vector<std::string> scenes, recipe_texts;
    std::string json;
    int builds = 3, threads = 0;
    Options options("bench collapse",
                    "Measures the collapse of binary hierarchies into wide ones: by least cost and greedy.");
    options.texts("-s,--scene", "SCENE", scenes,
                  "scene to measure with; may be given several times (default: atrium)");
    options.texts("-r,--recipe", "RECIPE", recipe_texts,
                  "what makes a binary BVH; may be given several times (default: bvh-sweep-sah)");
    options.integer("--builds", builds, 1, 100, "times that each is collapsed (default: 3)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads to build with (default: all)");
    options.footer(
        "optimal_cost, greedy_cost: expected cost of a random ray, node-cost for each inner node and\n"
        "pack-cost for each pack of triangles that it meets. What follows is of the optimal one,\n"
        "build_ms the processor time of the collapse alone, a median. Exit code 1 where the greedy one\n"
        "costs less.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    if (scenes.empty()) scenes.push_back("atrium");
    if (recipe_texts.empty()) recipe_texts.push_back("bvh-sweep-sah");
    const std::vector<Recipe> recipes = parse_recipes(recipe_texts);
    for (const Recipe& recipe : recipes)
        parse_recipe(print(recipe) + " > wide4");  // throws for no binary BVH
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"bench collapse", scenes, {}, {}};
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        for (const Recipe& recipe : recipes) {
            StageCache cache;
            const Built built = build_shown(recipe, scene, cache, /*with_levels=*/false);
            report.rows.push_back(collapse_row<4>(built, builds));
            report.rows.push_back(collapse_row<8>(built, builds));
            report.rows.push_back(collapse_row<16>(built, builds));
        }
    });
    if (!report.rows.empty()) print_report(report, json);
    if (result == ExitCode::Done && !std::ranges::all_of(report.rows, holds)) return ExitCode::CheckFailed;
    return result;
}

}  // namespace boxwood
