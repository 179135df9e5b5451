#include "app/viewer/box_values.h"

#include <algorithm>

#include "core/structure/sah.h"

namespace boxwood {
namespace {

/// Of the values above 0.
ValueRange range_of(const std::vector<float>& values) {
    ValueRange range;
    for (const float value : values) {
        if (!(value > 0.0f)) continue;
        range.lower = range.lower > 0.0f ? std::min(range.lower, value) : value;
        range.upper = std::max(range.upper, value);
    }
    return range;
}

/// The nodes' terms of the SAH cost.
std::vector<double> sah_terms(const NodeList& list) {
    const double root_area = list.nodes.empty() ? 0.0 : list.half_area(0);
    std::vector<double> terms;
    terms.reserve(list.nodes.size());
    for (size_t i = 0; i < list.nodes.size(); ++i) {
        const NodeView& node = list.nodes[i];
        const double cost =
            node.kind == NodeKind::Leaf ? leaf_cost(node.ref_count) : static_cast<double>(kTraversalCost);
        terms.push_back(hit_probability(list.half_area(i), root_area) * cost);
    }
    return terms;
}

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double value : values) total += value;
    return total;
}

}  // namespace

BoxValues make_box_values(const NodeList& list) {
    const size_t node_count = list.nodes.size();
    std::vector<uint64_t> references(node_count, 0);
    for (size_t i = node_count; i-- > 0;) {  // children before parents
        const NodeView& node = list.nodes[i];
        if (node.kind == NodeKind::Leaf) references[i] += node.ref_count;
        if (node.parent != kNoIndex) references[node.parent] += references[i];
    }
    const std::vector<double> terms = sah_terms(list);
    const double total = sum(terms);
    BoxValues values;
    values.references.reserve(node_count);
    values.sah_share.reserve(node_count);
    for (size_t i = 0; i < node_count; ++i) {
        values.references.push_back(static_cast<float>(references[i]));
        values.sah_share.push_back(total > 0.0 ? static_cast<float>(terms[i] / total) : 0.0f);
    }
    for (const uint32_t prim : list.ref_prims) {
        if (prim >= values.prim_leaves.size()) values.prim_leaves.resize(size_t{prim} + 1, 0);
        ++values.prim_leaves[prim];
    }
    values.references_range = range_of(values.references);
    values.sah_share_range = range_of(values.sah_share);
    return values;
}

}  // namespace boxwood
