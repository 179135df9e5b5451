#include <imgui.h>

#include <algorithm>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"
#include "core/structure/sah.h"

namespace boxwood::panel {
namespace {

std::string name_of(const NodeView& node, uint32_t number) {
    const bool is_leaf = node.kind == NodeKind::Leaf;
    return (!is_leaf ? "node " : node.ref_count == 0 ? "empty leaf " : "leaf ") + std::to_string(number);
}

std::string share_text(double share) { return number_text(100.0 * share, 3) + " %"; }

void select(const Context& context, uint32_t node) {
    context.state.side().node = node;
    context.state.prim = kNoIndex;
}

/// Whether a small button fits behind the last item; otherwise it begins a line.
void flow(const std::string& text, bool is_first) {
    if (is_first) return;
    ImGui::SameLine(0.0f, 0.4f * ImGui::GetFontSize());
    const float width = ImGui::CalcTextSize(text.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

/// Clickable numbers of nodes.
void node_buttons(const Context& context, const char* id, std::span<const uint32_t> nodes, size_t most) {
    const NodeList& list = context.side.built->levels->list;
    ImGui::PushID(id);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    for (size_t i = 0; i < std::min(nodes.size(), most); ++i) {
        const std::string text = std::to_string(nodes[i]);
        flow(text, i == 0);
        if (ImGui::SmallButton(text.c_str())) select(context, nodes[i]);
        const NodeView& node = list.nodes[nodes[i]];
        tooltip(context, "Selects " + name_of(node, nodes[i]) + " at level " + std::to_string(node.level) +
                             ", " +
                             grouped(static_cast<uint64_t>(context.side.values->references[nodes[i]])) +
                             " references.");
    }
    ImGui::PopFont();
    ImGui::PopID();
}

void number_rows(const Context& context, const NodeFacts& facts) {
    const NodeView& node = facts.view;
    const DVec3 size = node.bounds.extent();
    const size_t deepest = context.side.built->levels->level_count() - 1;
    value_row(context, "level", std::to_string(node.level) + " of " + std::to_string(deepest),
              "Edges from the root to this node.");
    value_row(
        context, "box",
        number_text(size.x, 3) + " \u00d7 " + number_text(size.y, 3) + " \u00d7 " + number_text(size.z, 3),
        "Size of its box along x, y and z in world units.\nFrom " + number_text(double(node.bounds.lower.x)) +
            ", " + number_text(double(node.bounds.lower.y)) + ", " +
            number_text(double(node.bounds.lower.z)) + " to " + number_text(double(node.bounds.upper.x)) +
            ", " + number_text(double(node.bounds.upper.y)) + ", " +
            number_text(double(node.bounds.upper.z)) + ".\nArea " + number_text(node.bounds.surface_area()) +
            ".");
    value_row(context, "triangles", grouped(facts.prim_count),
              "Different triangles in it, or in the leaves below it: " + grouped(facts.prim_count) + " in " +
                  grouped(facts.references) + " references of " + grouped(facts.leaves_below) +
                  " leaves; nodes below: " + grouped(facts.nodes_below) + ".");
    const double cost = node.kind == NodeKind::Leaf ? leaf_cost(node.ref_count) : double(kTraversalCost);
    const double sah_cost = context.side.tree->sah_cost;
    const double probability = cost > 0.0 ? facts.own_share * sah_cost / cost : 0.0;
    value_row(context, "own share of cost", share_text(facts.own_share),
              "(area / root area) \u00d7 " + number_text(cost) +
                  (node.kind == NodeKind::Leaf ? " tests" : " for the visit") +
                  " / SAH cost of the tree = " + number_text(probability, 3) + " \u00d7 " +
                  number_text(cost) + " / " + number_text(sah_cost) + ".");
    value_row(context, "with all below", share_text(facts.share_below),
              "Share of the SAH cost that the node and all nodes below it have.");
    if (const Visits* visits = context.side.visits; visits != nullptr) {
        value_row(context, "visits", grouped(visits->by_node[facts.node]),
                  "Visits by " + grouped(visits->ray_count) + (visits->ray_count == 1 ? " ray." : " rays."));
    }
}

void buttons(const Context& context, uint32_t node) {
    ViewerState& s = context.state;
    if (ImGui::Button("Focus")) context.actions.push_back(FocusSelection{});
    tooltip(context, "F: the camera looks at the whole box, or at the triangle selected below.");
    ImGui::SameLine();
    if (ImGui::Button("Hide")) hide_selected(s);
    tooltip(context,
            "Delete: hides the node, all below it, and the triangles that are in no other visible leaf. The "
            "ray-traced view still shows all.");
    ImGui::SameLine();
    if (ImGui::Button(s.side().isolated == node ? "Show all" : "Isolate")) isolate_selected(s);
    tooltip(context, "I: shows this node, what is below it and its triangles alone; again: all.");
    ImGui::SameLine();
    const bool is_whole = s.side().hidden_nodes.empty() && s.side().isolated == kNoIndex;
    ImGui::BeginDisabled(is_whole);
    if (ImGui::Button("Put back")) put_nodes_back(s);
    ImGui::EndDisabled();
    tooltip(context, "Shift + Delete: everything that was hidden or isolated away is shown again.");
}

void triangle_list(const Context& context, const NodeFacts& facts) {
    const Mesh& mesh = context.side.built->scene->mesh;
    std::string title = "triangles";
    if (facts.prim_count > facts.prims.size()) title += ", the first " + grouped(facts.prims.size());
    colored(context.colors.dim, title);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    if (ImGui::BeginChild("triangles", {0.0f, -1.0f})) {
        for (const uint32_t prim : facts.prims) {
            const std::string text = std::to_string(mesh.source_prim[prim]) + "  " +
                                     mesh.objects[mesh.object[prim]].name + "##" + std::to_string(prim);
            const bool is_selected = prim == context.state.prim;
            if (ImGui::Selectable(text.c_str(), is_selected))
                context.state.prim = is_selected ? kNoIndex : prim;
            tooltip(context, "Triangle " + std::to_string(mesh.source_prim[prim]) + " of the file, in " +
                                 grouped(context.side.values->prim_leaves[prim]) +
                                 (context.side.values->prim_leaves[prim] == 1 ? " leaf" : " leaves") +
                                 ". A click shows it in colour; F looks at it.");
        }
    }
    ImGui::EndChild();
    ImGui::PopFont();
}

}  // namespace

void node_part(const Context& context) {
    const NodeFacts* facts = context.side.facts;
    if (facts == nullptr || context.side.built == nullptr) {
        note(context,
             "Click a box in the view to select its node; another click at the same place selects the next "
             "one there.");
        if (!context.state.side().hidden_nodes.empty() || context.state.side().isolated != kNoIndex) {
            if (ImGui::Button("Put back")) put_nodes_back(context.state);
            tooltip(context, "Shift + Delete: everything that was hidden or isolated away is shown again.");
        }
        return;
    }
    colored(context.colors.text, name_of(facts->view, facts->node));
    if (context.input.picked_count > 1) {
        const std::string place = std::to_string(context.input.picked_place + 1) + " of " +
                                  std::to_string(context.input.picked_count) + " here";
        ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(place.c_str()).x);
        colored(context.colors.dim, place);
        tooltip(context, "Nodes under the place that was clicked; click there again for the next one.");
    }
    number_rows(context, *facts);
    buttons(context, facts->node);
    colored(context.colors.dim, "path from the root");
    node_buttons(context, "path", facts->path, facts->path.size());
    constexpr size_t kMostShown = 24;
    std::string title = facts->child_count == 0 ? "no children" : grouped(facts->child_count) + " children";
    if (facts->child_count > kMostShown) title += ", the first " + std::to_string(kMostShown);
    colored(context.colors.dim, title);
    node_buttons(context, "children", facts->children, kMostShown);
    triangle_list(context, *facts);
}

void hide_selected(ViewerState& state) {
    if (state.side().node == kNoIndex) return;
    if (std::ranges::find(state.side().hidden_nodes, state.side().node) == state.side().hidden_nodes.end())
        state.side().hidden_nodes.push_back(state.side().node);
    if (state.side().isolated == state.side().node) state.side().isolated = kNoIndex;
    state.side().node = state.prim = kNoIndex;
}

void isolate_selected(ViewerState& state) {
    if (state.side().node == kNoIndex) return;
    state.side().isolated = state.side().isolated == state.side().node ? kNoIndex : state.side().node;
}

void put_nodes_back(ViewerState& state) {
    state.side().hidden_nodes.clear();
    state.side().isolated = kNoIndex;
}

}  // namespace boxwood::panel
