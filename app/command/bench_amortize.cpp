#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/bench_structures.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/amortize.h"

namespace boxwood {

ExitCode run_bench_amortize(Arguments arguments) {
    StructureOptions shared;
    Options options(
        "bench amortize",
        "Measures from how many rays on a better structure pays for its build: for 10^4 to 10^10 rays, "
        "build plus trace.");
    shared.add_to(options, "scene; may be given several times (default: terrain and kitchen)");
    options.footer(
        "One thread, processor time; rounds over all structures in random order; medians.\n"
        "total_ms = build_ms + rays / rate; efficiency: rays over total time, relative to the fastest\n"
        "structure without its build. The table shows who wins; the JSON has every structure, and\n"
        "bench/plots.py draws it.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    check_json_file(shared.json());
    shared.recipes();  // all are checked before one is built
    Report report{"bench amortize", shared.scenes({"terrain", "kitchen"}), {}, {}};
    std::vector<ReportRow> winners;
    const ExitCode result = for_each_scene(report.scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        Task task;
        const Progress progress(scene->title + ": build plus trace", task);
        const std::vector<bench::MeasuredStructure> structures =
            bench::measure_structures(scene, shared.settings(*scene), task);
        const std::vector<bench::AmortizedRow> rows = bench::amortize(structures);
        for (const bench::AmortizedRow& row : rows)
            report.rows.push_back(bench::report_row(row, structures[row.structure], *scene));
        for (ReportRow& row : bench::winner_rows(rows, structures, *scene)) winners.push_back(std::move(row));
    });
    if (report.rows.empty()) return result;
    if (shared.json() != "-") std::fputs(to_table(winners).c_str(), stdout);
    report.tables = {{"winners", std::move(winners)}};
    if (!shared.json().empty()) write_json(report, shared.json());
    return result;
}

}  // namespace boxwood
