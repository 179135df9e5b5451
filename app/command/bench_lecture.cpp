#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/bench_structures.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/lecture.h"

namespace boxwood {
namespace {

using bench::MeasuredStructure;

/// Numbers and words of one scene, added to the report's rows and to its table of words.
void add_scene(const Scene& scene, std::span<const MeasuredStructure> structures, Report& report,
               std::vector<ReportRow>& words, ReportRow& about) {
    const double clustering = bench::clustering(scene.mesh);
    const bool is_uniform = clustering <= bench::kUniformClustering;
    about.set("scene", scene.spec)
        .set("triangles", uint64_t{scene.mesh.triangle_count()})
        .set("clustering", clustering)
        .set("uniform", is_uniform);
    const std::vector<bench::LectureRow> judged =
        bench::judge_lecture(structures, scene.mesh.triangle_count(), is_uniform);
    for (size_t i = 0; i < structures.size(); ++i) {
        report.rows.push_back(bench::numbers_row(structures[i], scene));
        words.push_back(bench::words_row(structures[i], judged[i], scene));
    }
}

}  // namespace

ExitCode run_bench_lecture(Arguments arguments) {
    StructureOptions shared;
    Options options(
        "bench lecture",
        "Measures the comparison table of Kerbl's lecture: memory, build time and rays per second of "
        "every structure, and which of its words the numbers bear out.");
    shared.add_to(
        options,
        "scene; may be given several times (default: terrain, which is uniform, and kitchen, which is "
        "clustered)");
    options.footer(
        "One thread, processor time; rounds over all structures in random order; medians. Of the slow\n"
        "structures fewer rays, evenly spread: see primary_rays, diffuse_rays. A transform stands on\n"
        "the recipe of least SAH cost that it takes. *_holds: whether the word of the numbers is among\n"
        "the lecture's: yes, or better or worse than them.\n\n" +
        bench::rule_text({}) + "\n" + recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    check_json_file(shared.json());
    shared.recipes();  // all are checked before one is built
    Report report{"bench lecture", shared.scenes({"terrain", "kitchen"}), {}, {}};
    std::vector<ReportRow> words, about;
    const ExitCode result = for_each_scene(report.scenes, [&](const std::string& spec) {
        const std::shared_ptr<const Scene> scene = open_surface(spec);
        Task task;
        const Progress progress(scene->title + ": the lecture's table", task);
        const std::vector<MeasuredStructure> structures =
            bench::measure_structures(scene, shared.settings(*scene), task);
        add_scene(*scene, structures, report, words, about.emplace_back());
    });
    if (report.rows.empty()) return result;
    report.tables = {{"scenes", about}, {"words", words}};
    if (shared.json() != "-") {
        const std::string text = to_table(about) + "\n" + to_table(report.rows) + "\n" + to_table(words) +
                                 "\n" + bench::rule_text({});
        std::fputs(text.c_str(), stdout);
    }
    if (!shared.json().empty()) write_json(report, shared.json());
    return result;
}

}  // namespace boxwood
