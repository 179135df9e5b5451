#include "bench/structures.h"

#include <chrono>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "bench/ray_sets.h"
#include "bench/timing.h"
#include "core/base/parallel.h"
#include "core/brute_force/brute_force.h"
#include "core/measure/end_point_overlap.h"
#include "core/measure/leaf_count_variability.h"
#include "core/measure/tree_stats.h"

namespace boxwood::bench {
namespace {

constexpr double kLongBuild = 5000.0;  ///< ms: a build that takes longer is not repeated

/// Requests a stop after some seconds, or when another task is stopped.
class Patience {
public:
    Patience(double seconds, const Task& whole)
        : whole_(whole.stop, [this] { stop_.request_stop(); }),
          thread_([this, seconds](const std::stop_token& quit) { wait(quit, seconds); }) {}
    std::stop_token token() const { return stop_.get_token(); }

private:
    void wait(const std::stop_token& quit, double seconds) {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, quit, std::chrono::duration<double>(seconds), [] { return false; });
        if (!quit.stop_requested()) stop_.request_stop();
    }

    std::stop_source stop_;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::stop_callback<std::function<void()>> whole_;
    std::jthread thread_;  ///< last: it ends first
};

/// Builds recipes and keeps what is needed to choose among them and to cast rays.
class Measurement {
public:
    Measurement(std::shared_ptr<const Scene> scene, const StructureSettings& settings, Task& task)
        : scene_(std::move(scene)), settings_(settings), task_(task) {}

    void build(const Recipe& recipe) {
        MeasuredStructure row;
        row.recipe = print(recipe);
        row.build_ms = std::numeric_limits<double>::quiet_NaN();
        std::vector<double> times;
        std::optional<Built> built;
        for (int i = 0; i < settings_.builds && (i == 0 || times.front() < kLongBuild); ++i) {
            StageCache cache;
            const Patience patience(settings_.patience, task_);
            Task task(patience.token());
            const double begin = process_ms();
            built = run_recipe(recipe, scene_, cache, task);
            times.push_back(process_ms() - begin);
            if (!built) break;
        }
        task_.done += 1;
        if (built) {
            const LevelTable levels = make_level_table(built->structure.list_nodes());
            const TreeStats stats = tree_stats(levels);
            if (settings_.with_measures) row.measures = measure(levels.list, stats);
            row.is_built = true;
            row.is_list = std::string(built->structure.family()) == BruteForce::kFamily;
            row.family = built->structure.family();
            row.bytes = built->structure.byte_count();
            row.references = stats.references;
            row.sah_cost = stats.sah_cost;
            row.build_ms = median_of(std::move(times));
            structures_.push_back(built->structure);
        }
        rows_.push_back(std::move(row));
    }

    /// The transform on the recipe of least SAH cost that it takes; not at all where there is none.
    void build_on_best(const CatalogEntry& transform) {
        if (transform.make()->input_frame()) return;
        const MeasuredStructure* best = nullptr;
        for (const MeasuredStructure& row : rows_) {
            if (row.is_built && row.family == transform.input &&
                (best == nullptr || row.sah_cost < best->sah_cost))
                best = &row;
        }
        if (best != nullptr) build(parse_recipe(best->recipe + " > " + transform.id));
    }

    std::vector<MeasuredStructure> cast() {
        if (structures_.empty()) return std::move(rows_);
        const std::vector<Ray> primary = primary_rays(settings_.camera, settings_.ray_count);
        const std::vector<Ray> diffuse =
            diffuse_rays(fastest(), scene_->mesh, primary, primary.size(), task_);
        const std::vector<Rate> first = rates(primary), second = rates(diffuse);
        size_t i = 0;
        for (MeasuredStructure& row : rows_) {
            if (!row.is_built) continue;
            row.primary = first[i];
            row.diffuse = second[i];
            if (settings_.with_measures) {
                row.measures.primary_steps = steps(structures_[i], primary, row.primary.rays);
                row.measures.diffuse_steps = steps(structures_[i], diffuse, row.diffuse.rays);
            }
            ++i;
        }
        return std::move(rows_);
    }

private:
    TreeMeasures measure(const NodeList& list, const TreeStats& stats) const {
        Task task(task_.stop);
        return {.epo = end_point_overlap(list, scene_->mesh, task).total,
                .leaf_count_deviation = count_leaves_on_lines(list, task).deviation,
                .sibling_overlap = stats.sibling_overlap,
                .empty_volume = stats.empty_volume,
                .leaf_size_variation = stats.leaf_size_variation};
    }
    /// Mean over as many of the rays as were timed.
    double steps(const Structure& structure, std::span<const Ray> rays, uint64_t timed) const {
        if (timed == 0) return std::numeric_limits<double>::quiet_NaN();
        const std::vector<Ray> chosen = evenly_spread(rays, timed);
        std::vector<Hit> hits(timed);
        std::vector<Count> counts(timed);
        structure.closest_hits_counted(scene_->mesh, chosen, hits, counts, settings_.rates.mode, task_);
        uint64_t sum = 0;
        for (const Count& count : counts) sum += count.nodes + count.tests;
        return static_cast<double>(sum) / static_cast<double>(timed);
    }
    std::vector<Rate> rates(std::span<const Ray> rays) {
        std::vector<Rate> result = time_rates(structures_, scene_->mesh, rays, settings_.rates, task_);
        task_.done += 1;
        return result;
    }
    /// Of least SAH cost: only to find where rays bounce, which all structures agree on.
    const Structure& fastest() const {
        size_t best = 0, i = 0;
        double least = std::numeric_limits<double>::infinity();
        for (const MeasuredStructure& row : rows_) {
            if (!row.is_built) continue;
            if (row.sah_cost < least) {
                least = row.sah_cost;
                best = i;
            }
            ++i;
        }
        return structures_[best];
    }

    std::shared_ptr<const Scene> scene_;
    const StructureSettings& settings_;
    Task& task_;
    std::vector<MeasuredStructure> rows_;
    std::vector<Structure> structures_;  ///< of the rows that are built
};

}  // namespace

std::vector<MeasuredStructure> measure_structures(std::shared_ptr<const Scene> scene,
                                                  const StructureSettings& settings, Task& task) {
    const ThreadLimit one_thread(1);
    Measurement measurement(std::move(scene), settings, task);
    const size_t build_count = settings.recipes.empty()
                                   ? builder_catalog().size() + transform_catalog().size()
                                   : settings.recipes.size();
    task.total = build_count + 2;  // and two kinds of rays
    for (const Recipe& recipe : settings.recipes) measurement.build(recipe);
    if (settings.recipes.empty()) {
        for (const CatalogEntry& entry : builder_catalog()) measurement.build(parse_recipe(entry.id));
        for (const CatalogEntry& entry : transform_catalog()) measurement.build_on_best(entry);
    }
    return measurement.cast();
}

}  // namespace boxwood::bench
