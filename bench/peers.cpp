#include "bench/peers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bench/contestant.h"
#include "bench/ray_sets.h"
#include "bench/timing.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/base/timer.h"
#include "core/measure/verify.h"
#include "core/render/trace_schedule.h"

namespace boxwood::bench {

namespace {

/// Rounds over all contestants until the time is used. On one thread all of them on one core: another one may
/// be slower, where something beside this machine shares it.
void time_rounds(std::span<const Contestant> contestants, const RaySet& set, int threads,
                 const PeerSettings& settings, std::span<PeerRow> rows, Task& task) {
    const ThreadLimit limit(threads);
    std::optional<CorePin> pin;
    if (threads == 1) pin.emplace();
    std::vector<size_t> order(contestants.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    Answers answers;
    answers.resize_for(set);
    Rng rng(settings.seed);
    const Timer timer;
    for (uint64_t round = 0;
         round < settings.least_rounds || timer.milliseconds() < 1000.0 * settings.seconds; ++round) {
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.next_index(i)]);
        for (const size_t i : order) {
            rows[i].ms.push_back(cast(contestants[i], set, threads, answers));
            if (task.stopped()) return;
            if (answers.hash() != rows[i].hits_hash) ++rows[i].refused;
        }
        ++task.done;
    }
}

/// Ratios to the best peer of the cell, and of exact to fast mode.
void compare(std::span<PeerRow> rows) {
    const PeerRow* best = nullptr;
    for (const PeerRow& row : rows)
        if (row.is_peer() && (best == nullptr || median_of(row.ms) < median_of(best->ms))) best = &row;
    for (PeerRow& row : rows) {
        row.ratio = {kNan, kNan, kNan};
        row.over_fast = kNan;
        if (best != nullptr) {
            row.best_peer = best->contestant;
            row.ratio = ratio_of_medians(best->ms, row.ms);
        }
        for (const PeerRow& peer : rows)
            if (peer.is_peer())
                row.over_peers.emplace_back(peer.contestant, median_of(peer.ms) / median_of(row.ms));
        const auto fast = std::ranges::find_if(rows, [&](const PeerRow& other) {
            return other.contestant == row.contestant && other.mode == "fast";
        });
        if (row.mode == "exact" && fast != rows.end())
            row.over_fast = ratio_of_medians(row.ms, fast->ms).value;
    }
}

std::vector<PeerRow> rows_for(const RaySet& set, const Scene& scene, std::span<const Contestant> all,
                              const ScreenedOracle& oracle, int threads, const PeerSettings& settings,
                              Task& task) {
    std::vector<Contestant> contestants;
    std::ranges::copy_if(all, std::back_inserter(contestants),
                         [&](const Contestant& one) { return one.takes(set.casting); });
    std::vector<PeerRow> rows;
    std::vector<Answers> answers;
    std::vector<Demand> demands;
    for (const Contestant& one : contestants) {
        answers.emplace_back();
        answers.back().resize_for(set);
        cast(one, set, threads, answers.back());
        if (task.stopped()) return {};
        demands.push_back(one.demand);
        PeerRow row;
        row.scene = scene.spec;
        row.contestant = one.name;
        if (set.casting == Casting::Packets && one.recipe.empty()) row.contestant += " packets16";
        row.recipe = one.recipe;
        row.mode = one.mode;
        row.rays_kind = set.kind;
        row.threads = threads;
        row.triangles = scene.mesh.triangle_count();
        row.rays = set.rays.size();
        row.build_ms = one.build_ms;
        row.bytes = one.bytes;
        row.hits_hash = answers.back().hash();
        rows.push_back(std::move(row));
    }
    uint64_t disputed = 0;
    const std::vector<uint32_t> judged =
        rays_to_judge(answers, set.rays.size(), settings.sample_count, disputed);
    const std::vector<PeerErrors> errors = judge_answers(scene.mesh, oracle, set, judged, answers, demands);
    answers.clear();
    for (size_t i = 0; i < rows.size(); ++i) {
        rows[i].disputed = disputed;
        rows[i].errors = errors[i];
    }
    time_rounds(contestants, set, threads, settings, rows, task);
    compare(rows);
    return rows;
}

/// Pixels of a square picture, tile by tile as the renderer takes them.
std::vector<uint32_t> tile_order(int size) {
    constexpr int kTile = TracePass().tile_size;
    std::vector<uint32_t> pixels;
    const auto append = [&](int x, int y) { pixels.push_back(static_cast<uint32_t>(y * size + x)); };
    for (int y = 0; y < size; y += kTile)
        for (int x = 0; x < size; x += kTile) for_each_pixel({x, y}, kTile, 1, size, size, append);
    return pixels;
}

/// Of a spec of a file its name without folders.
std::string file_of(const std::string& scene) { return scene.substr(scene.find_last_of('/') + 1); }

}  // namespace

std::vector<Recipe> quality_recipes() {
    return {parse_recipe("preview"), parse_recipe("balanced"), parse_recipe("best")};
}

double PeerRow::mrays_per_s() const { return static_cast<double>(rays) / median_of(ms) / 1000.0; }

bool PeerRow::holds() const { return mode != "exact" || (refused == 0 && errors.wrong() == 0); }

std::vector<RaySet> peer_rays(const Structure& structure, const Scene& scene, const PeerSettings& settings,
                              Task& task) {
    const auto size = static_cast<size_t>(settings.size);
    const std::vector<Ray> primary = primary_rays(settings.camera, size * size);
    const std::vector<Hit> hits = boxwood::closest_hits(structure, scene.mesh, primary, Mode::Exact, task);
    const Vec3 light = light_by_camera(settings.camera, structure, scene.mesh);
    std::vector<RaySet> sets;
    sets.push_back({kRayKinds[0], Casting::Closest, primary});
    sets.push_back({kRayKinds[1], Casting::Closest, bounced_rays(scene.mesh, primary, hits)});
    sets.push_back({kRayKinds[2], Casting::Any, shadow_rays(scene.mesh, primary, hits, light)});
    RaySet packets{kRayKinds[3], Casting::Packets, {}, tile_order(static_cast<int>(size))};
    for (const uint32_t pixel : packets.pixels) packets.rays.push_back(primary[pixel]);
    sets.push_back(std::move(packets));
    std::erase_if(sets, [&](const RaySet& set) {
        const bool is_wanted =
            settings.kinds.empty() || std::ranges::find(settings.kinds, set.kind) != settings.kinds.end();
        return set.rays.empty() || !is_wanted;
    });
    return sets;
}

std::vector<PeerRow> run_peers(std::shared_ptr<const Scene> scene, const PeerSettings& settings, Task& task) {
    const ScreenedOracle oracle(scene->mesh);
    std::vector<RaySet> sets;
    std::vector<PeerRow> rows;
    for (const int threads : settings.threads) {
        const ContestantSettings how{threads, settings.builds, settings.with_fast_mode, settings.camera,
                                     settings.size};
        std::vector<Contestant> contestants;
        for (const Recipe& recipe : settings.recipes) {
            const std::optional<Structure> built = add_recipe(contestants, recipe, scene->mesh, how, task);
            if (!built) return {};
            if (sets.empty()) sets = peer_rays(*built, *scene, settings, task);
        }
        for (const EmbreeVariant& variant : settings.variants)
            add_embree(contestants, variant, scene->mesh, how);
        for (const RaySet& set : sets) {
            std::vector<PeerRow> part = rows_for(set, *scene, contestants, oracle, threads, settings, task);
            if (task.stopped()) return {};
            std::ranges::move(part, std::back_inserter(rows));
        }
    }
    return rows;
}

std::vector<RatioSummary> summarize(std::span<const PeerRow> rows) {
    std::vector<RatioCell> cells;
    for (const PeerRow& row : rows) {
        if (row.is_peer()) continue;
        std::string contestant = row.contestant + ", " + row.mode + ", " + std::to_string(row.threads) +
                                 (row.threads == 1 ? " thread" : " threads");
        if (row.rays_kind == kRayKinds[3]) contestant += ", packets";
        cells.push_back({std::move(contestant), file_of(row.scene) + " " + row.rays_kind, row.ratio.value,
                         row.over_fast, row.errors.wrong()});
    }
    return summarize(cells);
}

std::vector<ReportRow> ratio_table(std::span<const PeerRow> rows) {
    std::vector<ReportRow> table;
    std::vector<const PeerRow*> firsts;  // of each line of the table
    const auto name_of = [](const PeerRow& row) {
        return row.contestant.substr(0, row.contestant.find(" pack"));
    };
    for (const PeerRow& row : rows) {
        const auto is_own = [&](const PeerRow* first) {
            return first->scene == row.scene && first->threads == row.threads && first->mode == row.mode &&
                   first->contestant == name_of(row);
        };
        const auto line = static_cast<size_t>(std::ranges::find_if(firsts, is_own) - firsts.begin());
        if (line == firsts.size()) {
            firsts.push_back(&row);
            table.push_back(ReportRow()
                                .set("scene", file_of(row.scene))
                                .set("threads", static_cast<uint64_t>(row.threads))
                                .set("contestant", name_of(row))
                                .set("mode", row.mode)
                                .set("build_ms", row.build_ms)
                                .set("bytes", row.bytes));
        }
        table[line].set(row.rays_kind, row.ratio.value);
    }
    return table;
}

ReportRow report_row(const PeerRow& row) {
    ReportRow cells;
    cells.set("scene", row.scene).set("contestant", row.contestant);
    if (!row.recipe.empty()) cells.set("recipe", row.recipe).set("mode", row.mode);
    const double median = median_of(row.ms);
    const double rate = row.mrays_per_s();
    cells.set("rays_kind", row.rays_kind)
        .set("threads", static_cast<uint64_t>(row.threads))
        .set("triangles", row.triangles)
        .set("build_ms", row.build_ms)
        .set("bytes", row.bytes)
        .set("rays", row.rays)
        .set("rounds", uint64_t{row.ms.size()})
        .set("trace_ms", median)
        .set("mrays_per_s", rate)
        .set("best_peer", row.best_peer)
        .set("ratio", row.ratio.value)
        .set("ratio_low", row.ratio.lower)
        .set("ratio_high", row.ratio.upper)
        .set("over_fast", row.over_fast)
        .set("judged", row.errors.judged)
        .set("disputed", row.disputed)
        .set("wrong", row.errors.wrong())
        .set("wrong_hits", row.errors.wrong_hits)
        .set("ties", row.errors.ties)
        .set("times_refused", row.refused);
    for (const auto& [peer, ratio] : row.over_peers)
        cells.set("rate_over_" + peer.substr(peer.find(':') + 1), ratio);
    return cells;
}

ReportRow short_row(const PeerRow& row) {
    return ReportRow()
        .set("scene", file_of(row.scene))
        .set("rays_kind", row.rays_kind)
        .set("threads", static_cast<uint64_t>(row.threads))
        .set("contestant", row.contestant)
        .set("mode", row.mode)
        .set("mrays_per_s", row.mrays_per_s())
        .set("ratio", row.ratio.value)
        .set("ratio_low", row.ratio.lower)
        .set("ratio_high", row.ratio.upper)
        .set("over_fast", row.over_fast)
        .set("wrong", row.errors.wrong())
        .set("ties", row.errors.ties)
        .set("judged", row.errors.judged)
        .set("build_ms", row.build_ms)
        .set("bytes", row.bytes);
}

ReportRow report_row(const RatioSummary& summary) {
    return ReportRow()
        .set("contestant", summary.contestant)
        .set("cells", summary.cells)
        .set("geometric_mean", summary.geometric_mean)
        .set("worst", summary.worst)
        .set("worst_cell", summary.worst_cell)
        .set("under_0.9", summary.under_09)
        .set("under_1.2", summary.under_12)
        .set("over_fast", summary.over_fast)
        .set("worst_over_fast", summary.worst_over_fast)
        .set("wrong", summary.wrong);
}

}  // namespace boxwood::bench
