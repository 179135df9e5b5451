#include "bench/refit_frames.h"

#include <optional>

#include "bench/ray_sets.h"
#include "bench/timing.h"
#include "core/base/parallel.h"
#include "core/measure/tree_stats.h"
#include "core/scene/frame.h"

namespace boxwood::bench {
namespace {

/// Runs it several times; the last result, and the median time.
template <class Run>
Structure timed(int times, const Run& run, double& ms) {
    std::vector<double> all;
    std::optional<Structure> result;
    for (int i = 0; i < times; ++i) {
        const double begin = process_ms();
        result = run();
        all.push_back(process_ms() - begin);
    }
    ms = median_of(std::move(all));
    return *result;
}

double sah_cost_of(const Structure& structure) {
    return tree_stats(make_level_table(structure.list_nodes())).sah_cost;
}

class Frames {
public:
    Frames(const std::string& spec, const RefitSettings& settings, Task& task)
        : spec_(spec), settings_(settings), task_(task) {
        const std::shared_ptr<const Scene> first = open_scene(with_frame(spec, settings.from), task);
        for (const Recipe& recipe : settings.recipes) {
            const References references = recipe.references.method().make(first->mesh, task);
            trees_.push_back(recipe.builder.method().build(first->mesh, references.refs, task));
        }
    }

    void run(int frame, std::vector<RefitRow>& rows) {
        const std::shared_ptr<const Scene> scene = open_scene(with_frame(spec_, frame), task_);
        const size_t first = rows.size();
        std::vector<Structure> structures;
        for (size_t i = 0; i < settings_.recipes.size() && !task_.stopped(); ++i) {
            const Recipe& recipe = settings_.recipes[i];
            RefitRow& row = rows.emplace_back();
            row.scene = scene->spec;
            row.recipe = print(recipe);
            row.frame = frame;
            row.from = settings_.from;
            row.triangles = scene->mesh.triangle_count();
            const References references = recipe.references.method().make(scene->mesh, task_);
            structures.push_back(timed(
                settings_.builds,
                [&] { return recipe.builder.method().build(scene->mesh, references.refs, task_); },
                row.built.ms));
            structures.push_back(timed(
                settings_.builds,
                [&] { return Stage(refit_).method().apply(scene->mesh, references.refs, trees_[i], task_); },
                row.refitted.ms));
            row.built.sah_cost = sah_cost_of(structures[2 * i]);
            row.refitted.sah_cost = sah_cost_of(structures[2 * i + 1]);
        }
        if (task_.stopped()) return;
        cast(*scene, structures, std::span(rows).subspan(first));
    }

private:
    void cast(const Scene& scene, std::span<const Structure> structures, std::span<RefitRow> rows) {
        const std::vector<Ray> primary = primary_rays(settings_.camera, settings_.ray_count);
        const std::vector<Ray> diffuse =
            diffuse_rays(structures.front(), scene.mesh, primary, primary.size(), task_);
        const std::vector<Rate> first = time_rates(structures, scene.mesh, primary, settings_.rates, task_),
                                second = time_rates(structures, scene.mesh, diffuse, settings_.rates, task_);
        for (size_t i = 0; i < rows.size(); ++i) {
            rows[i].built.primary = first[2 * i];
            rows[i].refitted.primary = first[2 * i + 1];
            rows[i].built.diffuse = second[2 * i];
            rows[i].refitted.diffuse = second[2 * i + 1];
        }
    }

    const std::string& spec_;
    const RefitSettings& settings_;
    Task& task_;
    const CatalogEntry& refit_ = *find_entry("refit");
    std::vector<Structure> trees_;  ///< of frame `from`, one for each recipe
};

}  // namespace

std::vector<RefitRow> run_refit_frames(const std::string& spec, const RefitSettings& settings, Task& task) {
    const ThreadLimit one_thread(1);
    std::vector<RefitRow> rows;
    if (settings.recipes.empty()) return rows;
    Task builds(task.stop);  // so that task.done counts frames alone
    Frames frames(spec, settings, builds);
    task.total = settings.frames.size();
    for (const int frame : settings.frames) {
        if (task.stopped()) break;
        frames.run(frame, rows);
        ++task.done;
    }
    return rows;
}

ReportRow report_row(const RefitRow& row) {
    ReportRow cells;
    cells.set("scene", row.scene)
        .set("recipe", row.recipe)
        .set("triangles", row.triangles)
        .set("frame", static_cast<uint64_t>(row.frame))
        .set("from", static_cast<uint64_t>(row.from))
        .set("threads", uint64_t{1})
        .set("build_ms", row.built.ms)
        .set("refit_ms", row.refitted.ms)
        .set("sah_cost", row.built.sah_cost)
        .set("refit_sah_cost", row.refitted.sah_cost)
        .set("primary_mrays_per_s", row.built.primary.mrays_per_s())
        .set("refit_primary_mrays_per_s", row.refitted.primary.mrays_per_s())
        .set("diffuse_mrays_per_s", row.built.diffuse.mrays_per_s())
        .set("refit_diffuse_mrays_per_s", row.refitted.diffuse.mrays_per_s());
    return cells;
}

}  // namespace boxwood::bench
