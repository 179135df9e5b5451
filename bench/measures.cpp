#include "bench/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/correlation.h"
#include "core/brute_force/brute_force.h"
#include "core/bvh/bvh2.h"

namespace boxwood::bench {
namespace {

constexpr double kLongestBuild = 1.0;  ///< s, of one core, by a builder's own estimate
constexpr size_t kFewest = 3;          ///< structures of a scene that can be compared
constexpr int kAlphaSteps = 20;
constexpr const char* kPlainBuilders[] = {"bvh-sweep-sah",
                                          "bvh-binned-sah"};  ///< the first one for transforms

double ns_per_ray(const MeasuredStructure& s, TimedRays kind) {
    return 1e3 / (kind == TimedRays::Primary ? s.primary : s.diffuse).mrays_per_s();
}

bool counts_in(const MeasuredStructure& s, Group group, TimedRays kind) {
    if (!s.is_built || s.is_list || !std::isfinite(ns_per_ray(s, kind))) return false;
    if (group != Group::Boxes && s.family != Bvh2::kFamily) return false;
    for (size_t m = 0; m < kMeasureCount; ++m)
        if (!std::isfinite(value_of(s, static_cast<Measure>(m), kind))) return false;
    return true;
}

/// Whether two recipes came to the same tree, as references do that the scene does not need. Counted steps
/// are not compared: of how many rays they are depends on the clock.
bool is_same_tree(const MeasuredStructure& a, const MeasuredStructure& b) {
    for (size_t m = 0; m < static_cast<size_t>(Measure::Steps); ++m) {
        const auto measure = static_cast<Measure>(m);
        if (value_of(a, measure, TimedRays::Primary) != value_of(b, measure, TimedRays::Primary))
            return false;
    }
    return a.family == b.family;
}

/// Structures of one scene that are compared, each tree once.
struct Compared {
    std::vector<const MeasuredStructure*> structures;
    std::vector<double> times;
};

void keep_fast(Compared& scene) {
    if (scene.times.empty()) return;
    const double limit = kFastTime * *std::ranges::min_element(scene.times);
    Compared fast;
    for (size_t i = 0; i < scene.times.size(); ++i) {
        if (scene.times[i] > limit) continue;
        fast.structures.push_back(scene.structures[i]);
        fast.times.push_back(scene.times[i]);
    }
    scene = std::move(fast);
}

std::vector<Compared> compared(std::span<const MeasuredScene> scenes, Group group, TimedRays kind) {
    std::vector<Compared> result;
    for (const MeasuredScene& scene : scenes) {
        Compared one;
        for (const MeasuredStructure& s : scene.structures) {
            if (!counts_in(s, group, kind)) continue;
            if (std::ranges::any_of(one.structures,
                                    [&](const MeasuredStructure* other) { return is_same_tree(*other, s); }))
                continue;
            one.structures.push_back(&s);
            one.times.push_back(ns_per_ray(s, kind));
        }
        if (group == Group::FastBvh) keep_fast(one);
        if (one.structures.size() >= kFewest) result.push_back(std::move(one));
    }
    return result;
}

std::vector<double> values_of(const Compared& scene, Measure measure, TimedRays kind, double alpha) {
    std::vector<double> values;
    for (const MeasuredStructure* s : scene.structures) values.push_back(value_of(*s, measure, kind, alpha));
    return values;
}

/// Pairs of logarithms, each minus its mean over the scene.
struct LogPairs {
    std::vector<double> x, y;
    uint64_t scenes = 0;

    void add(std::span<const double> values, std::span<const double> times) {
        std::vector<double> logs, log_times;
        for (size_t i = 0; i < values.size(); ++i) {
            if (!(values[i] > 0.0)) continue;
            logs.push_back(std::log(values[i]));
            log_times.push_back(std::log(times[i]));
        }
        if (logs.size() < kFewest) return;
        ++scenes;
        const auto append_centered = [](std::vector<double>& to, const std::vector<double>& from) {
            double mean = 0.0;
            for (const double value : from) mean += value / static_cast<double>(from.size());
            for (const double value : from) to.push_back(value - mean);
        };
        append_centered(x, logs);
        append_centered(y, log_times);
    }
};

/// The weight of EPO that gives the largest correlation over the scenes but `without`.
double best_alpha(const std::vector<Compared>& scenes, TimedRays kind, size_t without) {
    double best = 0.0, most = -std::numeric_limits<double>::infinity();
    for (int step = 0; step <= kAlphaSteps; ++step) {
        const double alpha = static_cast<double>(step) / kAlphaSteps;
        LogPairs pairs;
        for (size_t i = 0; i < scenes.size(); ++i)
            if (i != without)
                pairs.add(values_of(scenes[i], Measure::SahAndEpo, kind, alpha), scenes[i].times);
        const double correlation = pearson(pairs.x, pairs.y);
        if (correlation > most) {
            most = correlation;
            best = alpha;
        }
    }
    return best;
}

Prediction predict(const std::vector<Compared>& scenes, Group group, TimedRays kind, Measure measure) {
    const bool is_weighted = measure == Measure::SahAndEpo;
    LogPairs pairs;
    double sum = 0.0, least = std::numeric_limits<double>::infinity();
    uint64_t ranked = 0;
    for (size_t i = 0; i < scenes.size(); ++i) {
        const size_t without = scenes.size() > 1 ? i : scenes.size();
        const double alpha = is_weighted ? best_alpha(scenes, kind, without) : 0.0;
        const std::vector<double> values = values_of(scenes[i], measure, kind, alpha);
        pairs.add(values, scenes[i].times);
        const double rank = spearman(values, scenes[i].times);
        if (!std::isfinite(rank)) continue;
        ++ranked;
        sum += rank;
        least = std::min(least, rank);
    }
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    return {.group = group,
            .kind = kind,
            .measure = measure,
            .pearson = pearson(pairs.x, pairs.y),
            .spearman = ranked > 0 ? sum / static_cast<double>(ranked) : kUnknown,
            .spearman_worst = ranked > 0 ? least : kUnknown,
            .scenes = pairs.scenes,
            .points = pairs.x.size(),
            .alpha = is_weighted ? best_alpha(scenes, kind, scenes.size()) : kUnknown};
}

bool is_whole(const CatalogEntry& references) { return std::string(references.id) == kWholeReferences; }

/// The builder that a transform stands on: the plain one if it fits.
const CatalogEntry* input_of(const CatalogEntry& transform) {
    const CatalogEntry* plain = find_entry(kPlainBuilders[0]);
    if (plain != nullptr && std::string(plain->output) == transform.input) return plain;
    for (const CatalogEntry& builder : builder_catalog())
        if (std::string(builder.output) == transform.input) return &builder;
    return nullptr;
}

}  // namespace

double value_of(const MeasuredStructure& s, Measure measure, TimedRays kind, double alpha) {
    switch (measure) {
        case Measure::SahCost:
            return s.sah_cost;
        case Measure::Epo:
            return s.measures.epo;
        case Measure::SahAndEpo:
            return (1.0 - alpha) * s.sah_cost + alpha * s.measures.epo;
        case Measure::LeafCounts:
            return s.measures.leaf_count_deviation;
        case Measure::Overlap:
            return s.measures.sibling_overlap;
        case Measure::EmptyVolume:
            return s.measures.empty_volume;
        case Measure::LeafSizes:
            return s.measures.leaf_size_variation;
        case Measure::Steps:
            return kind == TimedRays::Primary ? s.measures.primary_steps : s.measures.diffuse_steps;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::vector<Prediction> predictions(std::span<const MeasuredScene> scenes) {
    std::vector<Prediction> result;
    for (const Group group : {Group::BinaryBvh, Group::FastBvh, Group::Boxes}) {
        for (const TimedRays kind : {TimedRays::Primary, TimedRays::Diffuse}) {
            const std::vector<Compared> chosen = compared(scenes, group, kind);
            for (size_t m = 0; m < kMeasureCount; ++m)
                result.push_back(predict(chosen, group, kind, static_cast<Measure>(m)));
        }
    }
    return result;
}

std::vector<Recipe> recipes_to_measure(size_t triangle_count) {
    std::vector<Recipe> recipes;
    for (const CatalogEntry& builder : builder_catalog()) {
        if (std::string(builder.output) == BruteForce::kFamily) continue;
        if (builder.make()->estimate_seconds(triangle_count) > kLongestBuild) continue;
        recipes.push_back(parse_recipe(builder.id));
    }
    for (const CatalogEntry& references : reference_catalog()) {
        if (is_whole(references)) continue;
        for (const char* builder : kPlainBuilders)
            recipes.push_back(parse_recipe(std::string(references.id) + " > " + builder));
    }
    for (const CatalogEntry& transform : transform_catalog()) {
        const CatalogEntry* input = input_of(transform);
        if (input == nullptr || transform.make()->input_frame()) continue;
        recipes.push_back(parse_recipe(std::string(input->id) + " > " + transform.id));
    }
    return recipes;
}

ReportRow measures_row(const MeasuredStructure& s, const Scene& scene) {
    ReportRow row;
    row.set("scene", scene.spec).set("recipe", s.recipe).set("family", s.family);
    if (!s.is_built) return row;
    row.set("triangles", uint64_t{scene.mesh.triangle_count()})
        .set("references", s.references)
        .set("sah_cost", s.sah_cost)
        .set("epo", s.measures.epo)
        .set("lcv", s.measures.leaf_count_deviation)
        .set("overlap", s.measures.sibling_overlap)
        .set("empty_volume", s.measures.empty_volume)
        .set("leaf_size_variation", s.measures.leaf_size_variation)
        .set("primary_steps_per_ray", s.measures.primary_steps)
        .set("primary_mrays_per_s", s.primary.mrays_per_s())
        .set("diffuse_steps_per_ray", s.measures.diffuse_steps)
        .set("diffuse_mrays_per_s", s.diffuse.mrays_per_s());
    return row;
}

ReportRow prediction_row(const Prediction& prediction) {
    const bool is_weighted = prediction.measure == Measure::SahAndEpo;
    ReportRow row;
    row.set("structures", std::string(kGroupNames[static_cast<size_t>(prediction.group)]))
        .set("rays_kind", std::string(kTimedRaysNames[static_cast<size_t>(prediction.kind)]))
        .set("measure", std::string(kMeasureNames[static_cast<size_t>(prediction.measure)]))
        .set("pearson", prediction.pearson)
        .set("spearman", prediction.spearman)
        .set("spearman_worst_scene", prediction.spearman_worst)
        .set("scenes", prediction.scenes)
        .set("points", prediction.points);
    if (is_weighted) row.set("alpha", prediction.alpha);
    return row;
}

}  // namespace boxwood::bench
