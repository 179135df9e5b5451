#include "app/viewer/marks.h"

#include <algorithm>

#include "app/viewer/draw_list.h"

namespace boxwood {

Visibility visible_parts(const SideState& state, const NodeList& list, size_t triangle_count) {
    const size_t count = list.nodes.size();
    const auto exists = [&](uint32_t node) { return node < count; };
    Visibility visibility;
    const bool is_isolated = exists(state.isolated);
    if (!is_isolated && std::ranges::none_of(state.hidden_nodes, exists)) return visibility;

    std::vector<uint8_t> is_hidden(count, 0);
    for (const uint32_t node : state.hidden_nodes)
        if (exists(node)) is_hidden[node] = 1;
    visibility.nodes.assign(count, is_isolated ? 0 : 1);
    visibility.triangles.assign(triangle_count, 0);
    for (uint32_t i = 0; i < count; ++i) {  // parents before children
        const NodeView& node = list.nodes[i];
        if (node.parent != kNoIndex) {
            visibility.nodes[i] = visibility.nodes[node.parent];
            is_hidden[i] |= is_hidden[node.parent];
        }
        if (i == state.isolated) visibility.nodes[i] = 1;
    }
    for (uint32_t i = 0; i < count; ++i) {
        const NodeView& node = list.nodes[i];
        if (is_hidden[i] != 0) visibility.nodes[i] = 0;
        if (visibility.nodes[i] == 0 || node.kind != NodeKind::Leaf) continue;
        for (uint32_t r = node.first_ref; r < node.first_ref + node.ref_count; ++r)
            visibility.triangles[list.ref_prims[r]] = 1;
    }
    return visibility;
}

std::vector<uint32_t> box_marks(const Visibility& visibility, const Visits* visits) {
    std::vector<uint32_t> marks;
    if (visits != nullptr) {
        for (const uint32_t count : visits->by_node) marks.push_back(std::min(count, BoxMark::kVisits));
    }
    if (marks.empty()) marks.assign(visibility.nodes.size(), 0);
    for (size_t i = 0; i < visibility.nodes.size(); ++i)
        if (visibility.nodes[i] == 0) marks[i] |= BoxMark::kHidden;
    return marks;
}

std::vector<uint8_t> triangle_marks(std::span<const PrimRef> refs, const BoxValues& values,
                                    const Visibility& visibility, size_t triangle_count) {
    std::vector<uint8_t> marks = split_flags(refs, triangle_count);
    for (size_t prim = 0; prim < marks.size(); ++prim) {
        const bool is_split = marks[prim] != 0;
        marks[prim] = is_split ? TriangleMark::kSplit : uint8_t{0};
        if (!is_split && prim < values.prim_leaves.size() && values.prim_leaves[prim] > 1)
            marks[prim] |= TriangleMark::kShared;
        if (!visibility.is_whole() && visibility.triangles[prim] == 0) marks[prim] |= TriangleMark::kHidden;
    }
    return marks;
}

}  // namespace boxwood
