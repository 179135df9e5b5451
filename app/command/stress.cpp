#include "bench/stress.h"

#include <algorithm>
#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/stress_cases.h"
#include "bench/stress_failure.h"
#include "core/bvh/bvh2.h"

namespace boxwood {
namespace {

using bench::StressRow;
using bench::StressSettings;

ReportRow report_row(const StressRow& row) {
    ReportRow cells;
    cells.set("recipe", row.recipe)
        .set("mode", kModeNames[static_cast<size_t>(row.mode)])
        .set("kind", row.kind)
        .set("cases", row.cases)
        .set("rays", row.rays)
        .set("leaks", row.leaks)
        .set("wrong_hits", row.wrong_hits)
        .set("wrong_sensitive", row.wrong_sensitive)
        .set("wrong_prims", row.wrong_prims)
        .set("wrong_t", row.wrong_t)
        .set("exact_decisions", row.exact_decisions)
        .set("holds", row.holds());
    return cells;
}

std::string kinds_help() {
    std::string text = "Kinds of cases:\n";
    for (const bench::StressKind& kind : bench::stress_kinds()) {
        std::string name = kind.name;
        name.resize(18, ' ');
        text += "  " + name + kind.what + "\n";
    }
    return text;
}

}  // namespace

ExitCode run_stress(Arguments arguments) {
    std::vector<std::string> texts;
    std::vector<std::string> mode_names;
    std::string json, folder;
    int seed = 1, threads = 0, aimed_rays = 0;
    bool is_long = false;
    StressSettings settings;
    Options options(
        "stress",
        "Casts rays that are hard for floating point at meshes that are, and counts the answers that "
        "rational arithmetic does not give.");
    options.texts("-r,--recipe", "RECIPE", texts,
                  "what to test; may be given several times (default: every exact row of the catalog)");
    options.texts("--mode", "MODE", mode_names, "exact or fast; may be given twice (default: both)");
    options.real("--seconds", settings.seconds, 0.01, 1e6,
                 "time for each recipe and mode, shared by the kinds of cases (default: 3)");
    options.integer(
        "--aimed-rays", aimed_rays, 0, 2000000000,
        "at least so many rays at vertices and edges of closed meshes, for each recipe in exact mode "
        "(default: 10000000 for each binary BVH if no recipe is given, otherwise 0)");
    options.flag("--long", is_long, "the same as --aimed-rays 1000000000");
    options.integer("--seed", seed, 0, 1000000000, "first seed of the cases (default: 1)");
    options.text("--save", "DIR", folder,
                 "write the first failing case of each row there, and print how to cast its ray again");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads (default: all)");
    options.footer(
        "leaks: a closed mesh was missed from inside; wrong_hits: a hit for a miss or a miss for a hit (in "
        "fast\n"
        "mode on rays that are not within rounding of an edge or an end of their range; those are counted "
        "as\n"
        "wrong_sensitive); wrong_prims: another primitive than the nearest; wrong_t: not the exact t, "
        "rounded (in\n"
        "fast mode: off by more than 2^-18 of it). Exits 1 if a row does not hold: exact mode allows no "
        "wrong\n"
        "answer, fast mode no wrong_hits. The first failing ray of a row is printed in hex.\n\n" +
        kinds_help() + "\n" + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    settings.recipes = texts.empty() ? exact_recipes() : parse_recipes(texts);
    if (!mode_names.empty()) settings.modes.clear();
    for (const std::string& name : mode_names) {
        const auto* found = std::ranges::find(kModeNames, name);
        if (found == std::end(kModeNames))
            throw Error(ExitCode::WrongUsage, "--mode is \"" + name + "\", expected exact or fast");
        settings.modes.push_back(static_cast<Mode>(found - std::begin(kModeNames)));
    }
    settings.seed = static_cast<uint64_t>(seed);
    settings.aimed_rays = is_long ? 1000000000 : static_cast<uint64_t>(aimed_rays);
    if (texts.empty() && settings.aimed_rays == 0) {
        settings.aimed_rays = 10000000;
        settings.aimed_family = Bvh2::kFamily;
    }
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"stress", {}, {}, {}};
    std::vector<StressRow> rows;
    {
        Task task;
        const Progress progress("stress cases", task);
        rows = bench::run_stress(settings, task);
    }
    for (const StressRow& row : rows) {
        report.rows.push_back(report_row(row));
        if (!row.first_failure.empty()) std::fprintf(stderr, "%s\n", row.first_failure.c_str());
        if (row.failure && !folder.empty())
            std::fprintf(stderr, "%s\n", bench::save_failure(*row.failure, folder).c_str());
    }
    print_report(report, json);
    return std::ranges::all_of(rows, &StressRow::holds) ? ExitCode::Done : ExitCode::CheckFailed;
}

}  // namespace boxwood
