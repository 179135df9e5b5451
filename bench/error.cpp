#include "bench/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <utility>

#include "bench/double_path.h"
#include "bench/error_judge.h"
#include "bench/ratios.h"
#include "bench/ray_sets.h"
#include "bench/timing.h"
#include "core/base/rng.h"
#include "core/base/timer.h"

namespace boxwood::bench {

namespace {

/// One who casts: a recipe's structure in one way.
struct Caster {
    size_t recipe;
    Precision contestant;
    std::function<void(std::span<const Ray>, std::span<Hit>)> cast;
    std::function<void(std::span<const Ray>, std::span<Hit>, std::span<Count>)> cast_counted;
    uint64_t bytes;
};

Caster caster_in(Mode mode, size_t recipe, const Built& built, const Task& task) {
    const Structure& structure = built.structure;
    const Mesh& mesh = built.scene->mesh;
    return {recipe, mode == Mode::Exact ? Precision::Exact : Precision::Fast,
            [&, mode](std::span<const Ray> rays, std::span<Hit> hits) {
                structure.closest_hits(mesh, rays, hits, mode, task);
            },
            [&, mode](std::span<const Ray> rays, std::span<Hit> hits, std::span<Count> counts) {
                structure.closest_hits_counted(mesh, rays, hits, counts, mode, task);
            },
            structure.byte_count()};
}

std::vector<Caster> casters_of(const std::vector<Built>& built, const Task& task) {
    std::vector<Caster> casters;
    for (size_t i = 0; i < built.size(); ++i) {
        for (const Mode mode : {Mode::Exact, Mode::Fast})
            casters.push_back(caster_in(mode, i, built[i], task));
        std::optional<DoubleTracer> tracer = DoubleTracer::over(built[i].structure.list_nodes());
        if (!tracer) continue;
        const auto shared = std::make_shared<const DoubleTracer>(std::move(*tracer));
        const Mesh& mesh = built[i].scene->mesh;
        casters.push_back(
            {i, Precision::Double,
             [shared, &mesh](std::span<const Ray> rays, std::span<Hit> hits) {
                 shared->closest_hits(mesh, rays, hits);
             },
             [shared, &mesh](std::span<const Ray> rays, std::span<Hit> hits, std::span<Count> counts) {
                 shared->closest_hits_counted(mesh, rays, hits, counts);
             },
             shared->byte_count()});
    }
    return casters;
}

/// The pass that is not timed: answers recorded and judged, work counted.
void record(const Caster& caster, std::span<const Ray> rays, const SampleJudge& judge, ErrorRow& row) {
    std::vector<Hit> hits(rays.size());
    std::vector<Count> counts(rays.size());
    caster.cast_counted(rays, hits, counts);
    for (const Count& count : counts) row.count += count;
    row.errors = judge.judge(hits, caster.contestant);
    row.rounds.recorded_hash = hash_of(hits);
}

/// Rounds over all casters until the time is used.
void time_rounds(std::span<const Caster> casters, std::span<const Ray> rays, const ErrorSettings& settings,
                 std::span<ErrorRow> rows, Task& task) {
    std::vector<size_t> order(casters.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<Hit> hits(rays.size());
    Rng rng(settings.seed);
    const Timer timer;
    for (uint64_t round = 0;
         round <= settings.least_rounds || timer.milliseconds() < 1000.0 * settings.seconds; ++round) {
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.next_index(i)]);
        for (const size_t i : order) {
            const double begin = process_ms();
            casters[i].cast(rays, hits);
            const double ms = process_ms() - begin;
            if (task.stopped()) return;
            if (round > 0) rows[i].rounds.add(ms, hash_of(hits));
        }
        ++task.done;
    }
}

/// Of one recipe's rows: each one's time over fast mode's in the same round.
void compare_with_fast(std::span<ErrorRow> rows) {
    for (ErrorRow& row : rows) {
        row.over_fast = kNan;
        const auto fast = std::ranges::find_if(rows, [&](const ErrorRow& other) {
            return other.recipe == row.recipe && other.contestant == Precision::Fast;
        });
        if (fast == rows.end() || row.rounds.ms.size() != fast->rounds.ms.size()) continue;
        std::vector<double> ratios;
        for (size_t i = 0; i < row.rounds.ms.size(); ++i)
            ratios.push_back(row.rounds.ms[i] / fast->rounds.ms[i]);
        row.over_fast = median_of(std::move(ratios));
    }
}

std::vector<ErrorRow> rows_for(std::string rays_kind, std::span<const Ray> rays,
                               const std::vector<Built>& built, std::span<const Caster> casters,
                               const ErrorSettings& settings, Task& task) {
    const Mesh& mesh = built.front().scene->mesh;
    const SampleJudge judge(mesh, rays, rays.size() / std::max<size_t>(settings.sample_count, 1));
    const uint64_t rays_hash = hash_of(rays);
    std::vector<ErrorRow> rows;
    for (const Caster& caster : casters) {
        const Built& of = built[caster.recipe];
        ErrorRow row;
        row.scene = of.scene->spec;
        row.recipe = print(of.recipe);
        row.rays_kind = rays_kind;
        row.contestant = caster.contestant;
        row.triangles = mesh.triangle_count();
        row.references = of.references->refs.size();
        row.bytes = caster.bytes;
        row.build_ms = of.references_ms + of.build_ms;
        row.rays = rays.size();
        row.rays_hash = rays_hash;
        record(caster, rays, judge, row);
        rows.push_back(std::move(row));
        if (task.stopped()) return rows;
    }
    if (settings.seconds > 0.0) time_rounds(casters, rays, settings, rows, task);
    compare_with_fast(rows);
    return rows;
}

std::string hex(uint64_t value) {
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

}  // namespace

void Rounds::add(double round_ms, uint64_t hash) {
    if (hash == recorded_hash) {
        ms.push_back(round_ms);
    } else {
        ++refused;
    }
}

double Rounds::median() const { return median_of(ms); }
double Rounds::least() const { return ms.empty() ? kNan : *std::ranges::min_element(ms); }
double Rounds::greatest() const { return ms.empty() ? kNan : *std::ranges::max_element(ms); }

bool ErrorRow::holds() const {
    if (rounds.refused > 0) return false;
    if (contestant == Precision::Exact) return errors.wrong() == 0;
    return contestant == Precision::Double || (errors.wrong_plain == 0 && errors.beyond_bound == 0);
}

std::vector<ErrorRow> run_error(std::shared_ptr<const Scene> scene, const ErrorSettings& settings,
                                Task& task) {
    StageCache cache;
    std::vector<Built> built;
    for (const Recipe& recipe : settings.recipes) {
        std::optional<Built> one = run_recipe(recipe, scene, cache, task);
        if (!one) return {};
        built.push_back(std::move(*one));
    }
    if (built.empty()) return {};
    const std::vector<Caster> casters = casters_of(built, task);
    const std::vector<Ray> primary = primary_rays(settings.camera, settings.ray_count);
    const std::vector<Ray> diffuse =
        diffuse_rays(built.front().structure, scene->mesh, primary, primary.size(), task);
    task.done = 0;
    task.total = 0;
    std::vector<ErrorRow> rows;
    for (const auto& [kind, rays] : {std::pair("primary", &primary), std::pair("diffuse", &diffuse)}) {
        if (rays->empty()) continue;
        std::vector<ErrorRow> part = rows_for(kind, *rays, built, casters, settings, task);
        std::ranges::move(part, std::back_inserter(rows));
        if (task.stopped()) return {};
    }
    return rows;
}

ReportRow report_row(const ErrorRow& row) {
    const auto rays = static_cast<double>(row.rays);
    const auto sample = static_cast<double>(std::max<uint64_t>(row.errors.sample, 1));
    const auto per_million = [&](uint64_t count) { return 1e6 * static_cast<double>(count) / sample; };
    const auto per_ray = [&](uint64_t count) { return static_cast<double>(count) / rays; };
    ReportRow cells;
    cells.set("scene", row.scene)
        .set("recipe", row.recipe)
        .set("rays_kind", row.rays_kind)
        .set("contestant", std::string(kContestantNames[static_cast<size_t>(row.contestant)]))
        .set("triangles", row.triangles)
        .set("references", row.references)
        .set("bytes", row.bytes)
        .set("build_ms", row.build_ms)
        .set("threads", uint64_t{1})
        .set("rays", row.rays)
        .set("rounds", uint64_t{row.rounds.ms.size()})
        .set("trace_ms", row.rounds.median())
        .set("mrays_per_s", rays / row.rounds.median() / 1000.0)
        .set("mrays_min", rays / row.rounds.greatest() / 1000.0)
        .set("mrays_max", rays / row.rounds.least() / 1000.0)
        .set("over_fast", row.over_fast)
        .set("nodes_per_ray", per_ray(row.count.nodes))
        .set("tests_per_ray", per_ray(row.count.tests))
        .set("exact_per_ray", per_ray(row.count.exact))
        .set("sample", row.errors.sample)
        .set("wrong", row.errors.wrong())
        .set("wrong_plain_per_million", per_million(row.errors.wrong_plain))
        .set("wrong_sensitive_per_million", per_million(row.errors.wrong_sensitive))
        .set("wrong_prims_per_million", per_million(row.errors.wrong_prims))
        .set("t_error_ulps", row.errors.t_error)
        .set("t_error_p99_ulps", row.errors.t_error_p99)
        .set("t_bound_ulps", row.errors.t_bound)
        .set("t_bound_p99_ulps", row.errors.t_bound_p99)
        .set("beyond_bound", row.errors.beyond_bound)
        .set("rays_hash", hex(row.rays_hash))
        .set("hits_hash", hex(row.rounds.recorded_hash))
        .set("times_refused", row.rounds.refused)
        .set("holds", row.holds());
    return cells;
}

}  // namespace boxwood::bench
