#include "bench/builds.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bench/build_time.h"
#include "bench/timing.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/bvh/bvh2.h"
#include "core/measure/tree_stats.h"

namespace boxwood::bench {

namespace {

/// What is built in a round: one of the recipes, or after these one of the variants.
class Builds {
public:
    Builds(const Scene& scene, const BuildSettings& settings, Task& task)
        : scene_(scene), settings_(settings), task_(task) {
        for (const int threads : settings.threads) {
            for (size_t i = 0; i < settings.recipes.size() + settings.variants.size(); ++i) {
                BuildRow row;
                row.scene = scene.spec;
                row.threads = threads;
                row.triangles = scene.mesh.triangle_count();
                row.sah_cost = std::numeric_limits<double>::quiet_NaN();
                if (is_recipe(i)) row.recipe = print(settings.recipes[i]);
                row.contestant = is_recipe(i) ? "boxwood:" + row.recipe
                                              : settings.variants[i - settings.recipes.size()].name;
                rows_.push_back(std::move(row));
                what_.push_back(i);
            }
        }
    }

    size_t size() const { return rows_.size(); }
    std::vector<BuildRow> take_rows() { return std::move(rows_); }

    void build(size_t k) {
        const size_t i = what_[k];
        if (is_recipe(i)) {
            build_recipe(settings_.recipes[i], rows_[k]);
        } else {
            build_variant(settings_.variants[i - settings_.recipes.size()], rows_[k]);
        }
        ++task_.done;
    }

private:
    bool is_recipe(size_t i) const { return i < settings_.recipes.size(); }

    void build_recipe(const Recipe& recipe, BuildRow& row) {
        Task task(task_.stop);
        const std::optional<TimedBuild> built = build_timed(recipe, scene_.mesh, row.threads, task);
        if (!built) return;
        row.ms.push_back(built->ms());
        row.references_ms.push_back(built->references_ms);
        row.references = built->references;
        row.bytes = built->structure.byte_count();
        row.skipped = task.skipped.counts();
        if (row.ms.size() == 1)
            row.sah_cost = tree_stats(make_level_table(built->structure.list_nodes())).sah_cost;
    }

    void build_variant(const EmbreeVariant& variant, BuildRow& row) {
        const ThreadLimit limit(row.threads);
        EmbreeScene scene(scene_.mesh, variant);
        const double begin = clock_ms(row.threads);
        scene.build();
        row.ms.push_back(clock_ms(row.threads) - begin);
        row.bytes = scene.byte_count();
    }

    const Scene& scene_;
    const BuildSettings& settings_;
    Task& task_;
    std::vector<BuildRow> rows_;
    std::vector<size_t> what_;  ///< by row
};

}  // namespace

std::vector<BuildRow> run_builds(const Scene& scene, const BuildSettings& settings, Task& task) {
    Builds builds(scene, settings, task);
    task.total = static_cast<uint64_t>(settings.rounds) * builds.size();
    std::vector<size_t> order(builds.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    Rng rng(settings.seed);
    for (int round = 0; round < settings.rounds; ++round) {
        for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[rng.next_index(i)]);
        for (const size_t k : order) {
            builds.build(k);
            if (task.stopped()) return {};
        }
    }
    std::vector<BuildRow> rows = builds.take_rows();
    for (BuildRow& row : rows) {
        for (const BuildRow& peer : rows)
            if (peer.recipe.empty() && peer.threads == row.threads)
                row.over_peers.emplace_back(peer.contestant, ratio_of_medians(row.ms, peer.ms));
    }
    return rows;
}

std::vector<Recipe> bvh_recipes() {
    std::vector<Recipe> recipes;
    for (const CatalogEntry& builder : builder_catalog())
        if (std::string(builder.output) == Bvh2::kFamily) recipes.push_back(parse_recipe(builder.id));
    return recipes;
}

ReportRow report_row(const BuildRow& row) {
    ReportRow cells;
    cells.set("scene", row.scene).set("contestant", row.contestant);
    if (!row.recipe.empty()) cells.set("recipe", row.recipe);
    const double triangles = static_cast<double>(std::max<uint64_t>(row.triangles, 1));
    const double median = median_of(row.ms);
    cells.set("threads", static_cast<uint64_t>(row.threads))
        .set("triangles", row.triangles)
        .set("rounds", uint64_t{row.ms.size()})
        .set("build_ms", median)
        .set("least_ms", row.ms.empty() ? median : *std::ranges::min_element(row.ms))
        .set("ns_per_triangle", 1e6 * median / triangles)
        .set("bytes", row.bytes);
    if (!row.recipe.empty()) {
        cells.set("references_ms", median_of(row.references_ms))
            .set("references", row.references)
            .set("sah_cost", row.sah_cost);
        if (!row.skipped.empty()) cells.set("skipped", row.skipped);
    }
    for (const auto& [peer, ratio] : row.over_peers)
        cells.set("over_" + peer.substr(peer.find(':') + 1), ratio.value);
    return cells;
}

}  // namespace boxwood::bench
