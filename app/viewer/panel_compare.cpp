#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/viewer/panel_parts.h"
#include "core/render/color_map.h"

namespace boxwood::panel {
namespace {

constexpr const char* kCompareTip =
    "Two recipes, A and B, over the same scene from the same camera (C): boxes and heat maps on one scale, "
    "their signed difference, and their measures beside each other.";

void view_choice(const Context& context) {
    constexpr std::array<const char*, 2> kViews{"wipe", "side by side"};
    int view = static_cast<int>(context.state.compare_view);
    choice(
        context, "##compare view", view, 0, kViews,
        "wipe: one picture, A to the left of a bar that can be dragged, B to the right of it. Side by side: "
        "a picture each (G).");
    context.state.compare_view = static_cast<CompareView>(view);
}

void side_buttons(const Context& context) {
    ViewerState& s = context.state;
    if (ImGui::Button("Swap")) context.actions.push_back(SwapSides{});
    tooltip(context, "A becomes B, with all that was found out for it (S).");
    ImGui::SameLine();
    const Side from = s.active_side(), to = other_side(from);
    const std::string copy = std::string("Copy to ") + side_name(to);
    if (ImGui::Button(copy.c_str())) s.sides[index_of(to)] = s.side(from);
    tooltip(context, std::string("Recipe ") + side_name(to) + " becomes that of " + side_name(from) +
                         ": the difference is zero everywhere, until one of them is changed.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    view_choice(context);
}

/// Whether the width is enough for a label that is more than its letter.
bool has_room(const Context& context, float width) { return width >= 72.0f * context.scale; }

std::string recipe_of(const Context& context, Side side) {
    const Built* built = context.input.side(side).built;
    return built != nullptr ? print(built->recipe) : "not built yet";
}

struct Label {
    std::string text{};
    ImVec2 size{};
    float wrap = 0.0f;
};

Label label_of(const Context& context, Side side, float width) {
    Label label{.text = side_name(side)};
    const float margin = 8.0f * context.scale, padding = 6.0f * context.scale;
    label.wrap = width - 2.0f * (margin + padding) - context.scale * 14.0f;
    if (has_room(context, width)) label.text += ": " + recipe_of(context, side);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    label.size = ImGui::CalcTextSize(label.text.c_str(), nullptr, false, std::max(label.wrap, 1.0f));
    ImGui::PopFont();
    return label;
}

/// In the upper left corner of A's part, the upper right one of B's.
void draw_label(const Context& context, Side side, const ViewRect& part) {
    const float margin = 8.0f * context.scale, padding = 6.0f * context.scale, chip = 14.0f * context.scale;
    const Label label = label_of(context, side, part.width);
    const ImVec2 size{label.size.x + chip + 2.0f * padding, label.size.y + 2.0f * padding};
    if (part.width < size.x || part.height < size.y) return;
    const float x = side == Side::A ? std::min(part.x + margin, part.x + part.width - size.x)
                                    : std::max(part.x + part.width - margin - size.x, part.x);
    const float y = part.y + margin;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.AddRectFilled({x, y}, {x + size.x, y + size.y}, im_packed(Vec4(Vec3(context.colors.panel), 0.92f)),
                       3.0f * context.scale);
    draw.AddRectFilled({x + padding, y + padding + 1.0f * context.scale},
                       {x + padding + 8.0f * context.scale, y + padding + 11.0f * context.scale},
                       im_packed(side_color(context.state.theme, side)), 2.0f * context.scale);
    const ImFont* font = ImGui::GetIO().Fonts->Fonts[1];
    draw.AddText(font, font->FontSize, {x + padding + chip, y + padding}, im_packed(context.colors.text),
                 label.text.c_str(), nullptr, std::max(label.wrap, 1.0f));
}

void draw_bar(const Context& context, const WipeBar& bar) {
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const float half = 1.0f * context.scale, middle = bar.rect.y + 0.5f * bar.rect.height;
    const float top = bar.rect.y, bottom = bar.rect.y + bar.rect.height;
    const uint32_t dark = im_packed(Vec4(0.0f, 0.0f, 0.0f, 0.75f)), bright = im_packed(Vec3(0.96f));
    draw.AddRectFilled({bar.x - half - context.scale, top}, {bar.x + half + context.scale, bottom}, dark);
    draw.AddRectFilled({bar.x - half, top}, {bar.x + half, bottom}, bright);
    const float radius = 11.0f * context.scale, arrow = 4.0f * context.scale;
    draw.AddCircleFilled({bar.x, middle}, radius + 1.5f * context.scale, dark, 32);
    draw.AddCircleFilled({bar.x, middle}, radius, bright, 32);
    for (const float way : {-1.0f, 1.0f}) {
        const float x = bar.x + way * 2.5f * context.scale;
        draw.AddTriangleFilled({x, middle - arrow}, {x, middle + arrow}, {x + way * arrow, middle},
                               im_packed(Vec3(0.15f)));
    }
}

/// Between two pictures side by side.
void draw_gap(const Context& context) {
    const ViewRect &a = context.layout.side(Side::A).scene.rect, &b = context.layout.side(Side::B).scene.rect;
    const float x = 0.5f * (a.x + a.width + b.x), half = std::max(1.0f, context.scale);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const bool is_whole = !context.state.shows_difference() || context.state.traced != TracedView::Beside;
    const float bottom = is_whole ? context.layout.view.y + context.layout.view.height : a.y + a.height;
    draw.AddRectFilled({x - half, a.y}, {x + half, bottom}, im_packed(context.colors.panel));
}

}  // namespace

Vec3 side_color(Theme theme, Side side) {
    return diverging_srgb(side == Side::A ? 0.62f : -0.62f, theme == Theme::Dark);
}

std::string of_side(const ViewerState& state) {
    return state.compares() ? std::string(" of ") + side_name(state.active_side()) : std::string();
}

void toggle_compare(ViewerState& state, PanelMemory& memory) {
    SideState &a = state.sides[0], &b = state.sides[1];
    if (state.compares()) {
        memory.last_b = b.recipe;
        b = SideState{};
        state.active = Side::A;
    } else {
        b = SideState{.recipe = memory.last_b.empty() ? a.recipe : memory.last_b};
        state.active = Side::B;
    }
}

void toggle_difference(ViewerState& state) {
    const bool was_shown = state.shows_difference();
    if (state.traced == TracedView::Off) state.traced = TracedView::Beside;
    if (!is_heat(state.shading)) state.shading = Shading::Heat;
    state.heat_difference = !was_shown;
}

void compare_part(const Context& context) {
    ViewerState& s = context.state;
    const char* button = s.compares() ? "one recipe" : "compare";
    ImGui::Dummy({0.0f, 2.0f * context.scale});
    if (s.compares()) {
        const auto tab = [&](Side side) {
            return Tab{
                std::string("Recipe ") + side_name(side),
                "Edits this recipe; measures, levels and nodes below are of it (A).\n" + s.side(side).recipe,
                Vec4(side_color(s.theme, side), 1.0f)};
        };
        const std::array<Tab, 2> all{tab(Side::A), tab(Side::B)};
        if (const std::optional<size_t> chosen = tabs(context, all, index_of(s.active_side())))
            s.active = static_cast<Side>(*chosen);
    } else {
        ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[2]);
        ImGui::TextUnformatted("Recipe");
        ImGui::PopFont();
    }
    const float width = ImGui::CalcTextSize(button).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    if (ImGui::SmallButton(button)) toggle_compare(s, context.memory);
    tooltip(context, s.compares() ? "Shows A alone again (C); B is kept for the next time." : kCompareTip);
    ImGui::Separator();
    if (s.compares()) side_buttons(context);
}

float label_height(const Context& context) {
    if (!context.state.compares()) return 0.0f;
    float height = 0.0f;
    for (const Side side : kSides) {
        const float width = context.layout.side(side).scene.part.width;
        height = std::max(height, label_of(context, side, width).size.y);
    }
    return height + 20.0f * context.scale;
}

void side_labels(const Context& context) {
    if (!context.state.compares()) return;
    for (const std::optional<WipeBar>& bar : context.layout.bars)
        if (bar) draw_bar(context, *bar);
    if (context.state.compare_view == CompareView::Beside) draw_gap(context);
    const bool is_beside = context.state.traced == TracedView::Beside;
    for (const Side side : kSides) {
        const SideLayout& places = context.layout.side(side);
        draw_label(context, side, places.scene.part);
        if (is_beside && !context.state.shows_difference()) draw_label(context, side, places.traced.part);
    }
}

}  // namespace boxwood::panel
