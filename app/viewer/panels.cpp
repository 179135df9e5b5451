#include "app/viewer/panels.h"

#include <imgui.h>

#include <algorithm>

#include "app/viewer/panel_parts.h"

namespace boxwood {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoNavInputs;

void begin_fixed(const char* name, const ViewRect& rect) {
    ImGui::SetNextWindowPos({rect.x, rect.y});
    ImGui::SetNextWindowSize({rect.width, rect.height});
    ImGui::Begin(name, nullptr, kFixed);
}

void left_panel(const panel::Context& context) {
    begin_fixed("left", context.layout.left);
    // What is saved and undone stays in sight where the rest has to scroll.
    const ViewRect& rect = context.layout.left;
    const ImVec2 padding = ImGui::GetStyle().WindowPadding;
    const float spacing = ImGui::GetStyle().ItemSpacing.y;
    const float rest = std::max(rect.height - panel::session_height(context) - padding.y + spacing, 1.0f);
    ImGui::SetCursorPos({0.0f, 0.0f});
    ImGui::BeginChild("settings", {rect.width, rest + spacing}, /*border=*/false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding);
    panel::scene_part(context);
    panel::recipe_part(context);
    panel::view_part(context);
    panel::trace_part(context);
    ImGui::EndChild();
    ImGui::SetCursorPos({padding.x, rest});  // the room under the settings is enough between both
    panel::session_part(context);
    ImGui::End();
}

void right_panel(const panel::Context& context) {
    begin_fixed("right", context.layout.right);
    panel::measures_part(context);
    panel::side_tabs(context);
    switch (context.state.side_panel) {
        case SidePanel::Levels:
            panel::level_table_part(context);
            break;
        case SidePanel::Node:
            panel::node_part(context);
            break;
        case SidePanel::Verify:
            panel::verify_part(context);
            break;
    }
    ImGui::End();
}

}  // namespace

std::vector<Action> edit(ViewerState& state, const PanelInput& input, const FrameLayout& layout,
                         PanelMemory& memory) {
    std::vector<Action> actions;
    const panel::Context context{state,  input,   input.side(state.active_side()), layout,
                                 memory, actions, theme_colors(state.theme),       state.interface_scale};
    if (layout.left.width > 0.0f) {
        left_panel(context);
        right_panel(context);
        panel::status_line(context);
        if (!state.show_keys) panel::legends(context);
    }
    panel::side_labels(context);
    panel::wrong_marks(context);
    panel::message_line(context);
    panel::work_line(context);
    if (state.show_keys) panel::key_list(context);
    panel::dialogs(context);
    return actions;
}

}  // namespace boxwood
