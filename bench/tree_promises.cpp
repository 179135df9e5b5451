#include "bench/tree_promises.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/structure/sah.h"
#include "core/wide_bvh/collapse.h"

namespace boxwood::bench {
namespace {

constexpr std::array<const char*, 5> kValueNames{"sah_cost", "wide_cost", "references", "nodes", "bytes"};

/// One line for each; see parse_promise. The budget of references is that of the stage.
constexpr const char* kPromises[] = {
    "references: bvh-sweep-sah > lsc <= 2 * bvh-sweep-sah",
    "references: bvh-spatial-splits <= 2 * bvh-sweep-sah",
    "sah_cost: bvh-spatial-splits <= bvh-sweep-sah",
    "sah_cost: bvh-sweep-sah > optimize <= bvh-sweep-sah",
    "sah_cost: bvh-spatial-splits > optimize <= bvh-spatial-splits",
    "wide_cost: bvh-sweep-sah > wide4 <= bvh-sweep-sah > wide4(collapse=greedy)",
    "wide_cost: bvh-sweep-sah > wide8 <= bvh-sweep-sah > wide8(collapse=greedy)",
    "wide_cost: bvh-sweep-sah > wide16 <= bvh-sweep-sah > wide16(collapse=greedy)",
};

std::string trimmed(const std::string& text) {
    const size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

TreeValue value_named(const std::string& name) {
    std::vector<std::string> names(kValueNames.begin(), kValueNames.end());
    for (size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return static_cast<TreeValue>(i);
    throw Error(ExitCode::WrongUsage, "a promise is about a value, and there is no value \"" + to_utf8(name) +
                                          "\"; did you mean " + nearest_word(name, names) + "?");
}

/// The factor before '*'; `text` becomes what follows.
double take_factor(std::string& text) {
    const size_t star = text.find('*');
    if (star == std::string::npos) return 1.0;
    const std::string number = trimmed(text.substr(0, star));
    double factor = 0.0;
    const auto end = std::from_chars(number.data(), number.data() + number.size(), factor);
    if (end.ec != std::errc() || end.ptr != number.data() + number.size() || !(factor > 0.0) ||
        !std::isfinite(factor))
        throw Error(ExitCode::WrongUsage,
                    "\"" + to_utf8(number) + "\" before * of a promise, expected a number above 0");
    text = text.substr(star + 1);
    return factor;
}

double sah_cost(const NodeList& list) {
    double cost = 0.0;
    for (size_t i = 0; i < list.nodes.size(); ++i) {
        const NodeView& node = list.nodes[i];
        cost += hit_probability(list.half_area(i), list.half_area(0)) *
                (node.kind == NodeKind::Inner ? double(kTraversalCost) : leaf_cost(node.ref_count));
    }
    return cost;
}

template <uint32_t Width>
double cost_of_wide(const WideBvh<Width>& bvh) {
    const Collapse<Width> method;
    return wide_cost(bvh, {static_cast<double>(method.node_cost), static_cast<double>(method.pack_cost)});
}

double wide_cost_of(const Built& built) {
    if (const auto* wide4 = built.structure.as<WideBvh<4>>()) return cost_of_wide(*wide4);
    if (const auto* wide8 = built.structure.as<WideBvh<8>>()) return cost_of_wide(*wide8);
    if (const auto* wide16 = built.structure.as<WideBvh<16>>()) return cost_of_wide(*wide16);
    throw Error(ExitCode::WrongUsage, "wide_cost is of wide BVHs, " + print(built.recipe) + " makes none");
}

double value_of(const Built& built, TreeValue value) {
    const NodeList& list = built.levels->list;
    switch (value) {
        case TreeValue::SahCost:
            return sah_cost(list);
        case TreeValue::WideCost:
            return wide_cost_of(built);
        case TreeValue::References:
            return static_cast<double>(list.ref_prims.size());
        case TreeValue::Nodes:
            return static_cast<double>(list.nodes.size());
        case TreeValue::Bytes:
            return static_cast<double>(built.structure.byte_count());
    }
    return 0.0;
}

}  // namespace

TreePromise parse_promise(const std::string& text) {
    const size_t colon = text.find(':'), relation = text.find("<=");
    if (colon == std::string::npos || relation == std::string::npos || relation < colon)
        throw Error(ExitCode::WrongUsage,
                    "\"" + to_utf8(text) + "\": expected VALUE: RECIPE <= [FACTOR *] RECIPE");
    std::string right = text.substr(relation + 2);
    const double factor = take_factor(right);
    return {.value = value_named(trimmed(text.substr(0, colon))),
            .recipe = parse_recipe(trimmed(text.substr(colon + 1, relation - colon - 1))),
            .factor = factor,
            .reference = parse_recipe(trimmed(right))};
}

std::string print(const TreePromise& promise) {
    std::string text = std::string(kValueNames[static_cast<size_t>(promise.value)]) + ": " +
                       boxwood::print(promise.recipe) + " <= ";
    if (promise.factor != 1.0) {
        char number[32];
        const auto end = std::to_chars(number, number + sizeof number, promise.factor);
        text += std::string(number, end.ptr) + " * ";
    }
    return text + boxwood::print(promise.reference);
}

std::span<const char* const> catalog_promises() { return kPromises; }

KeptPromise check_promise(const TreePromise& promise, std::shared_ptr<const Scene> scene, StageCache& cache,
                          Task& task) {
    constexpr double kRounding = 1e-9;  ///< of sums over up to 2^30 nodes, relative
    const auto built = run_recipe(promise.recipe, scene, cache, task, /*with_levels=*/true);
    if (!built) return {};
    const auto reference = run_recipe(promise.reference, scene, cache, task, /*with_levels=*/true);
    if (!reference) return {};
    KeptPromise kept{.value = value_of(*built, promise.value),
                     .reference = value_of(*reference, promise.value)};
    kept.holds = kept.value <= promise.factor * kept.reference * (1.0 + kRounding);
    return kept;
}

ReportRow promise_row(const TreePromise& promise, const KeptPromise& kept, const Scene& scene) {
    ReportRow row;
    row.set("scene", scene.spec)
        .set("promise", print(promise))
        .set("value", kept.value)
        .set("reference", kept.reference)
        .set("ratio", kept.value / kept.reference)
        .set("holds", kept.holds);
    return row;
}

}  // namespace boxwood::bench
