#include "app/viewer/keys.h"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/viewer/panel_parts.h"
#include "app/viewer/ui_context.h"

namespace boxwood {
namespace {

constexpr auto kHelp = std::to_array<KeyHelp>({
    {"Camera", "left drag", "orbit"},
    {"Camera", "middle drag", "pan"},
    {"Camera", "wheel", "zoom to the pointer"},
    {"Camera", "right drag", "look around"},
    {"Camera", "right + W A S D", "fly; E up, Q down"},
    {"Camera", "Shift, Alt", "fly ten times faster, slower"},
    {"Camera", "F", "focus the selection, or the point"},
    {"Camera", "double click", "focus the point under the pointer"},
    {"Camera", "Home", "whole scene"},
    {"Camera", "X Y Z", "along an axis; Shift: from behind"},
    {"Camera", "1 ... 9", "recall a view; Ctrl: store it"},
    {"Camera", "O", "orthographic"},
    {"Camera", "U", "next up axis"},
    {"Show", "B", "boxes"},
    {"Show", "M", "mesh"},
    {"Show", "W", "wire"},
    {"Show", "R", "subdivided triangles in red"},
    {"Show", "P", "boxes of the pieces"},
    {"Show", "E", "empty cells"},
    {"Show", "D", "triangles in several leaves in blue"},
    {"Show", "K", "boxes see-through"},
    {"Show", "T", "ray-traced view: beside, over, off"},
    {"Show", "H", "heat map"},
    {"Show", "V", "boxes by visits: picked ray, view, off"},
    {"Show", "Tab", "panels"},
    {"Show", "?", "this list"},
    {"Nodes", "click", "select; again: the next one there"},
    {"Nodes", "Shift + click", "cast the ray of that pixel"},
    {"Nodes", "arrow keys", "parent, first child, siblings"},
    {"Nodes", "I", "isolate the selected node; again: all"},
    {"Nodes", "Delete", "hide it; Shift: put all back"},
    {"Nodes", "Esc", "select nothing; forget the ray"},
    {"Nodes", "N", "levels, node, verify in the right panel"},
    {"Compare", "C", "two recipes, A and B; again: one"},
    {"Compare", "A", "edit the other of both"},
    {"Compare", "S", "swap A and B"},
    {"Compare", "G", "wipe, or side by side"},
    {"Compare", "drag the bar", "wipe; keys , and .; double click: middle"},
    {"Compare", "J", "heat map of the difference A \u2212 B"},
    {"Levels", "[  ]", "level range up, down the tree"},
    {"Levels", "Shift + [  ]", "its last level alone"},
    {"Levels", "L", "leaves above the range"},
    {"Session", "Ctrl + O", "open a scene, session or picture"},
    {"Session", "Ctrl + S", "save the session"},
    {"Session", "Ctrl + C", "copy the session as text"},
    {"Session", "Ctrl + V", "paste it"},
    {"Session", "Ctrl + Z", "undo a setting"},
    {"Session", "Ctrl + Shift + Z", "redo it"},
    {"Session", "drop a file", "open it"},
    {"Session", "Esc", "cancel a build; close what is open"},
    {"Panels", "Ctrl + click", "type a slider's value"},
    {"Panels", "right click", "put a changed value back"},
});

bool pressed(int key) { return ImGui::IsKeyPressed(key, /*repeat=*/false); }

void handle_commands(std::vector<Action>& actions, PanelMemory& memory) {
    const bool shift = ImGui::GetIO().KeyShift;
    if (pressed('O')) memory.ask_open = true;
    if (pressed('S')) memory.ask_save = true;
    if (pressed('C')) actions.push_back(CopySession{});
    if (pressed('V')) actions.push_back(PasteSession{});
    if (ImGui::IsKeyPressed('Z')) actions.push_back(shift ? Action(RedoStep{}) : Action(UndoStep{}));
    for (int i = 0; i < 9; ++i) {
        if (pressed('1' + i)) actions.push_back(StoreView{i});
    }
}

void toggle(bool& value, int key) {
    if (pressed(key)) value = !value;
}

/// Boxes by visits of the picked ray, of the whole view, by level.
void next_visits(ViewerState& state) {
    if (state.box_color != BoxColor::Visits) {
        state.box_color = BoxColor::Visits;
        state.visit_rays = VisitRays::Picked;
    } else if (state.visit_rays == VisitRays::Picked) {
        state.visit_rays = VisitRays::Picture;
    } else {
        state.box_color = BoxColor::Level;
    }
}

void handle_toggles(ViewerState& state) {
    toggle(state.show_boxes, 'B');
    toggle(state.show_mesh, 'M');
    toggle(state.show_wire, 'W');
    toggle(state.show_red, 'R');
    toggle(state.show_reference_boxes, 'P');
    toggle(state.see_through, 'K');
    toggle(state.leaves_above, 'L');
    toggle(state.show_empty, 'E');
    toggle(state.show_shared, 'D');
    toggle(state.show_panels, key::kTab);
    if (pressed('N')) state.side_panel = static_cast<SidePanel>((static_cast<int>(state.side_panel) + 1) % 3);
    if (pressed('V')) next_visits(state);
    if (pressed('T')) {
        state.traced = state.traced == TracedView::Off      ? TracedView::Beside
                       : state.traced == TracedView::Beside ? TracedView::Over
                                                            : TracedView::Off;
    }
    if (pressed('H')) {
        const bool on = state.traced != TracedView::Off && is_heat(state.shading);
        if (state.traced == TracedView::Off) state.traced = TracedView::Beside;
        state.shading = on ? Shading::Primary : Shading::Heat;
    }
}

void handle_views(ViewerState& state, const PanelInput& input, const Camera& camera,
                  std::vector<Action>& actions) {
    const ImGuiIO& io = ImGui::GetIO();
    for (int axis = 0; axis < 3; ++axis) {
        if (pressed('X' + axis)) {
            state.camera = axis_view(camera, input.scene_bounds, axis, io.KeyShift, up_vector(state.up_axis));
        }
    }
    if (pressed(key::kHome)) state.camera.reset();
    const bool is_selected = state.side().node != kNoIndex || state.prim != kNoIndex;
    if (pressed('F'))
        actions.push_back(is_selected ? Action(FocusSelection{})
                                      : Action(FocusPoint{Vec2(io.MousePos.x, io.MousePos.y)}));
    if (pressed('O')) {
        state.camera = camera;
        state.camera->orthographic = !camera.orthographic;
    }
    if (pressed('U')) {
        state.up_axis = static_cast<UpAxis>((static_cast<int>(state.up_axis) + 1) % 3);
        if (state.camera) state.camera->up = up_vector(state.up_axis);
    }
    for (size_t i = 0; i < state.stored_views.size(); ++i) {
        if (pressed('1' + static_cast<int>(i)) && state.stored_views[i]) state.camera = state.stored_views[i];
    }
}

/// What two recipes are compared by.
void handle_compare(ViewerState& state, PanelMemory& memory, std::vector<Action>& actions) {
    if (pressed('C')) panel::toggle_compare(state, memory);
    if (!state.compares()) return;
    if (pressed('A')) state.active = other_side(state.active);
    if (pressed('S')) actions.push_back(SwapSides{});
    if (pressed('G'))
        state.compare_view =
            state.compare_view == CompareView::Wipe ? CompareView::Beside : CompareView::Wipe;
    if (pressed('J')) panel::toggle_difference(state);
}

/// Selects a neighbour of the selected node, hides or isolates it.
void handle_nodes(ViewerState& state, const PanelInput& input) {
    if (pressed('I')) panel::isolate_selected(state);
    if (pressed(key::kDelete)) {
        if (ImGui::GetIO().KeyShift) {
            panel::put_nodes_back(state);
        } else {
            panel::hide_selected(state);
        }
    }
    const NodeFacts* found = input.side(state.active_side()).facts;
    if (found == nullptr || found->node != state.side().node) return;
    const NodeFacts& facts = *found;
    const auto go_to = [&](uint32_t node) {
        state.side().node = node;
        state.prim = kNoIndex;
    };
    const auto at = std::ranges::find(facts.siblings, facts.node);
    if (pressed(key::kUp) && facts.view.parent != kNoIndex) go_to(facts.view.parent);
    if (pressed(key::kDown) && !facts.children.empty()) go_to(facts.children.front());
    if (at == facts.siblings.end()) return;
    if (pressed(key::kLeft) && at != facts.siblings.begin()) go_to(*(at - 1));
    if (pressed(key::kRight) && at + 1 != facts.siblings.end()) go_to(*(at + 1));
}

/// Signs that stand on different keys of different keyboards come as characters.
void handle_characters(ViewerState& state, const PanelInput& input) {
    const int deepest = panel::deepest_level(input);
    constexpr float kWipeStep = 0.05f;
    for (const ImWchar c : ImGui::GetIO().InputQueueCharacters) {
        if (c == '?') state.show_keys = !state.show_keys;
        if (c == '[' || c == ']') state.levels = moved(state.levels, c == ']' ? 1 : -1, false, deepest);
        if (c == ',' || c == '.')
            state.wipe = std::clamp(state.wipe + (c == '.' ? kWipeStep : -kWipeStep), 0.0f, 1.0f);
        if (c == '{' || c == '}') state.levels = moved(state.levels, c == '}' ? 1 : -1, true, deepest);
    }
}

}  // namespace

std::span<const KeyHelp> key_help() { return kHelp; }

LevelRange moved(const LevelRange& range, int step, bool one_handle, int deepest) {
    const int first = std::min(range.first, deepest), last = std::min(range.last, deepest);
    if (one_handle) return {first, std::clamp(last + step, first, deepest)};
    const int shift = std::clamp(step, -first, deepest - last);
    return {first + shift, last + shift};
}

void handle_keys(ViewerState& state, const PanelInput& input, PanelMemory& memory, const Camera& camera,
                 bool flying, std::vector<Action>& actions) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput) return;
    if (pressed(key::kEscape)) {
        if (state.show_keys) {
            state.show_keys = false;
        } else if (input.progress.running) {
            actions.push_back(CancelWork{});
        } else if (!input.message.empty()) {
            actions.push_back(DismissMessage{});
        } else if (state.side().node != kNoIndex || state.prim != kNoIndex) {
            state.side().node = state.prim = kNoIndex;
        } else {
            state.ray.reset();
        }
    }
    if (io.KeyCtrl) {
        handle_commands(actions, memory);
        return;
    }
    if (flying || io.KeyAlt) return;
    handle_toggles(state);
    handle_compare(state, memory, actions);
    handle_views(state, input, camera, actions);
    handle_nodes(state, input);
    handle_characters(state, input);
}

}  // namespace boxwood
