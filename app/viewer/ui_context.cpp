#include "app/viewer/ui_context.h"

#include <imgui.h>

#include "app/viewer/theme.h"

namespace boxwood {
namespace {

/// What Dear ImGui itself needs to know of the key codes; with a window its own backend says the same.
void name_keys(ImGuiIO& io) {
    io.KeyMap[ImGuiKey_Tab] = key::kTab;
    io.KeyMap[ImGuiKey_LeftArrow] = 263;
    io.KeyMap[ImGuiKey_RightArrow] = 262;
    io.KeyMap[ImGuiKey_UpArrow] = 265;
    io.KeyMap[ImGuiKey_DownArrow] = 264;
    io.KeyMap[ImGuiKey_Home] = key::kHome;
    io.KeyMap[ImGuiKey_End] = 269;
    io.KeyMap[ImGuiKey_Delete] = key::kDelete;
    io.KeyMap[ImGuiKey_Backspace] = 259;
    io.KeyMap[ImGuiKey_Enter] = 257;
    io.KeyMap[ImGuiKey_Escape] = key::kEscape;
    io.KeyMap[ImGuiKey_A] = 'A';
    io.KeyMap[ImGuiKey_C] = 'C';
    io.KeyMap[ImGuiKey_V] = 'V';
    io.KeyMap[ImGuiKey_X] = 'X';
    io.KeyMap[ImGuiKey_Y] = 'Y';
    io.KeyMap[ImGuiKey_Z] = 'Z';
}

}  // namespace

UiContext::UiContext() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DeltaTime = 1.0f / 60.0f;
    io.ConfigInputTextCursorBlink = false;
    name_keys(io);
}

UiContext::~UiContext() { ImGui::DestroyContext(context_); }

bool UiContext::prepare(const ViewerState& state) {
    if (scale_ == state.interface_scale && theme_ == state.theme) return false;
    set_style(state.theme, state.interface_scale);
    theme_ = state.theme;
    if (scale_ == state.interface_scale) return false;
    set_fonts(*ImGui::GetIO().Fonts, state.interface_scale);
    ImGui::GetIO().Fonts->Build();
    scale_ = state.interface_scale;
    return true;
}

}  // namespace boxwood
