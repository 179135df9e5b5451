#include "app/viewer/node_facts.h"

#include <algorithm>

namespace boxwood {

NodeFacts node_facts(const NodeList& list, const BoxValues& values, uint32_t node) {
    NodeFacts facts;
    facts.node = node;
    facts.view = list.nodes[node];
    for (uint32_t at = node; at != kNoIndex; at = list.nodes[at].parent) facts.path.push_back(at);
    std::ranges::reverse(facts.path);

    std::vector<uint8_t> is_inside(list.nodes.size(), 0);
    std::vector<uint8_t> holds(values.prim_leaves.size(), 0);
    is_inside[node] = 1;
    for (uint32_t i = 0; i < list.nodes.size(); ++i) {  // parents before children
        const NodeView& view = list.nodes[i];
        if (view.parent == facts.view.parent && view.parent != kNoIndex &&
            facts.siblings.size() < NodeFacts::kMostChildren) {
            facts.siblings.push_back(i);
        }
        if (view.parent != kNoIndex && is_inside[view.parent] != 0) {
            is_inside[i] = 1;
            ++facts.nodes_below;
            facts.child_count += view.parent == node ? 1 : 0;
            if (view.parent == node && facts.children.size() < NodeFacts::kMostChildren)
                facts.children.push_back(i);
        }
        if (is_inside[i] == 0) continue;
        facts.share_below += static_cast<double>(values.sah_share[i]);
        if (view.kind != NodeKind::Leaf) continue;
        ++facts.leaves_below;
        facts.references += view.ref_count;
        for (uint32_t r = view.first_ref; r < view.first_ref + view.ref_count; ++r)
            holds[list.ref_prims[r]] = 1;
    }
    facts.own_share = static_cast<double>(values.sah_share[node]);
    for (uint32_t prim = 0; prim < holds.size(); ++prim) {
        if (holds[prim] == 0) continue;
        ++facts.prim_count;
        if (facts.prims.size() < NodeFacts::kMostPrims) facts.prims.push_back(prim);
    }
    return facts;
}

}  // namespace boxwood
