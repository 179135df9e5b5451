#pragma once

#include "app/viewer/state.h"

struct ImGuiContext;

namespace boxwood {

/// Owner of a Dear ImGui context without files of its own; current in the thread that made it.
class UiContext {
public:
    UiContext();
    ~UiContext();
    UiContext(const UiContext&) = delete;
    UiContext& operator=(const UiContext&) = delete;

    /// Style and fonts of the state. True if the fonts changed, so that they must be uploaded again.
    bool prepare(const ViewerState& state);

private:
    ImGuiContext* context_;
    Theme theme_ = Theme::Dark;
    float scale_ = 0.0f;  ///< 0: not prepared yet
};

/// Keys by their codes of the window system (GLFW), which Dear ImGui passes on as they are.
namespace key {
inline constexpr int kEscape = 256, kTab = 258, kHome = 268, kDelete = 261, kRight = 262, kLeft = 263,
                     kDown = 264, kUp = 265;
}

}  // namespace boxwood
