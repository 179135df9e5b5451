#include "app/viewer/measures.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/viewer/number_text.h"
#include "app/viewer/text_table.h"
#include "app/viewer/tree_quality.h"

namespace boxwood {
namespace {

using Unit = Measure::Unit;
using Better = Measure::Better;

template <class Number>
double number(Number value) {
    return static_cast<double>(value);
}

std::vector<Measure> reference_measures(const Built& built) {
    const double triangles = number(built.scene->mesh.triangle_count());
    const double made = number(built.references->refs.size());
    const double added = triangles > 0.0 ? (made - triangles) / triangles : 0.0;
    return {{"triangles", "triangles", Unit::Count, Better::Neither, triangles,
             "Triangles of the scene that structures see."},
            {"references_made", "references made", Unit::Count, Better::Lower, made,
             "Boxes that the references stage made; a leaf keeps each primitive once. Lower is better for "
             "memory."},
            {"references_added", "references added", Unit::Share, Better::Lower, added,
             "(references made - triangles) / triangles. Lower is better for memory."}};
}

std::vector<Measure> tree_measures(const PanelInput& input, const SideInput& side) {
    const TreeStats& tree = *side.tree;
    const uint64_t largest = tree.leaf_sizes.empty() ? 0 : tree.leaf_sizes.size() - 1;
    return {
        {"references", "references in leaves", Unit::Count, Better::Lower, number(tree.references),
         "References in all leaves, after duplicates of one primitive in a leaf were removed. Lower is "
         "better "
         "for memory.\n" +
             grouped(side.shared_count) +
             " triangles of one reference are in several leaves (D shows them in blue)."},
        {"nodes", "nodes", Unit::Count, Better::Lower, number(tree.nodes),
         "Inner nodes and leaves. Lower is better for memory."},
        {"leaves", "leaves", Unit::Count, Better::Neither, number(tree.leaves),
         "Leaves, " + grouped(tree.empty_leaves) + " of them empty; the largest holds " + grouped(largest) +
             " references."},
        {"levels", "levels", Unit::Count, Better::Neither, number(tree.levels.size()),
         "Levels; the root is level 0."},
        {"bytes", "bytes", Unit::Bytes, Better::Lower, number(side.built->structure.byte_count()),
         "Memory of the structure that rays traverse. Lower is better.\nIts node list for this window: " +
             byte_text(side.built->levels->byte_count()) + "; on the GPU: " + byte_text(input.gpu_bytes) +
             ";\nstages kept for a return: " + byte_text(input.cache_bytes) + " of at most " +
             byte_text(input.cache_limit) + "."},
        {"sah_cost", "SAH cost", Unit::Number, Better::Lower, tree.sah_cost,
         "Expected cost of a random ray that meets the root's box, in triangle tests: the sum over all nodes "
         "of (area / root area) x (1 for an inner node, the number of primitives for a leaf). Lower is "
         "better."}};
}

Measure build_time(const PanelInput& input, const Built& built) {
    return {"build_ms",
            "build time",
            Unit::Milliseconds,
            Better::Lower,
            built.references_ms + built.build_ms,
            "References " + time_text(built.references_ms) + ", builder and transforms " +
                time_text(built.build_ms) + ", as they took when they were run. Lower is better.\nFrom the " +
                "request to this picture: " + time_text(input.build_wait_ms) + "."};
}

Measure ray_rate(const ViewerState& state, const SideInput& side, const std::string& hint) {
    Measure rate{"rays_per_second", "rays per second", Unit::Rate, Better::Higher};
    if (side.rays_per_second > 0.0) rate.value = side.rays_per_second;
    rate.tip = state.compares()
                   ? "Primary rays of the picture, cast through A and B in turns for a second once both "
                     "pictures are done, on all cores. Higher is better."
                   : "Rays of the picture over the time spent on them, on all cores. Higher is better.";
    rate.tip += hint;
    return rate;
}

std::vector<Measure> count_measures(const SideInput& side, const std::string& hint) {
    const TraceState& trace = side.trace;
    const auto mean = [&](uint64_t sum) {
        return trace.counted_rays > 0 ? std::optional(number(sum) / number(trace.counted_rays))
                                      : std::nullopt;
    };
    return {{"nodes_per_ray", "nodes per ray", Unit::Number, Better::Lower, mean(trace.counters.nodes),
             "Nodes visited by a primary ray, in the mean. Lower is better." + hint},
            {"tests_per_ray", "tests per ray", Unit::Number, Better::Lower, mean(trace.counters.tests),
             "Primitives tested by a primary ray, in the mean. Lower is better." + hint}};
}

nlohmann::ordered_json json_number(const std::optional<double>& value) {
    if (!value) return nullptr;
    const double whole = std::round(*value);
    if (whole == *value && std::abs(whole) < 1e15) return static_cast<int64_t>(whole);
    return *value;
}

std::string raw_text(const std::optional<double>& value) {
    return value ? json_number(value).dump() : std::string();
}

TextTable table_of(const std::vector<MeasurePair>& pairs) {
    TextTable table{.header = {"measure", "a", "b", "difference"}, .left_columns = 1};
    for (const MeasurePair& pair : pairs)
        table.rows.push_back(
            {pair.a.key, raw_text(pair.a.value), raw_text(pair.b.value), raw_text(pair.difference())});
    return table;
}

}  // namespace

std::vector<Measure> measures_of(const ViewerState& state, const PanelInput& input, Side side) {
    const SideInput& of = input.side(side);
    if (of.built == nullptr || of.tree == nullptr) return {};
    const std::string hint = state.traced == TracedView::Off ? " Shown with the ray-traced view (T)." : "";
    std::vector<Measure> measures = reference_measures(*of.built);
    const auto append = [&](const std::vector<Measure>& more) {
        measures.insert(measures.end(), more.begin(), more.end());
    };
    append(tree_measures(input, of));
    append(tree_qualities(*of.tree, of.slow, of.slow_progress));
    if (state.show_times) append({build_time(input, *of.built), ray_rate(state, of, hint)});
    append(count_measures(of, hint));
    return measures;
}

std::string measure_text(Measure::Unit unit, const std::optional<double>& value) {
    if (!value) return "\u2013";
    const std::string sign = *value < 0.0 ? "\u2212" : "";
    const double size = std::abs(*value);
    switch (unit) {
        case Unit::Count:
            return sign + grouped(static_cast<uint64_t>(size));
        case Unit::Bytes:
            return sign + byte_text(static_cast<size_t>(size));
        case Unit::Milliseconds:
            return sign + time_text(size);
        case Unit::Rate:
            return sign + rate_text(size);
        case Unit::Number:
            return sign + number_text(size);
        case Unit::Share:
            return sign + percent_text(size, 1.0);
    }
    return {};
}

std::optional<double> MeasurePair::difference() const {
    if (!a.value || !b.value) return std::nullopt;
    return *a.value - *b.value;
}

std::optional<Side> MeasurePair::winner() const {
    const std::optional<double> d = difference();
    if (!d || !(*d != 0.0) || a.better == Better::Neither) return std::nullopt;
    return (*d < 0.0) == (a.better == Better::Lower) ? Side::A : Side::B;
}

std::vector<MeasurePair> pairs_of(const std::vector<Measure>& a, const std::vector<Measure>& b) {
    std::vector<MeasurePair> pairs;
    for (const Measure& measure : a) {
        const auto other =
            std::ranges::find_if(b, [&](const Measure& m) { return std::string(m.key) == measure.key; });
        if (other != b.end()) pairs.push_back({measure, *other});
    }
    return pairs;
}

std::string measures_tsv(const std::vector<MeasurePair>& pairs) { return tsv_of(table_of(pairs)); }

std::string measures_markdown(const std::vector<MeasurePair>& pairs) { return markdown_of(table_of(pairs)); }

std::string measures_json(const std::vector<MeasurePair>& pairs, const std::string& recipe_a,
                          const std::string& recipe_b) {
    nlohmann::ordered_json json{{"a", recipe_a}, {"b", recipe_b}};
    json["rows"] = nlohmann::ordered_json::array();
    for (const MeasurePair& pair : pairs) {
        json["rows"].push_back({{"measure", pair.a.key},
                                {"a", json_number(pair.a.value)},
                                {"b", json_number(pair.b.value)},
                                {"difference", json_number(pair.difference())}});
    }
    return json.dump(4) + "\n";
}

}  // namespace boxwood
