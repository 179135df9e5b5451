#pragma once

#include <span>
#include <vector>

#include "app/viewer/action.h"
#include "app/viewer/panels.h"

namespace boxwood {

/// A row of the list of all keys.
struct KeyHelp {
    const char* group;
    const char* keys;
    const char* what;
};
std::span<const KeyHelp> key_help();

/// Does what the keys of this ImGui frame ask; nothing while a text field has the focus. `flying`: letters
/// move the camera. `camera`: what the frame shows.
void handle_keys(ViewerState& state, const PanelInput& input, PanelMemory& memory, const Camera& camera,
                 bool flying, std::vector<Action>& actions);

/// Moves both ends of the range, or its last alone, within the levels 0 to `deepest`.
LevelRange moved(const LevelRange& range, int step, bool one_handle, int deepest);

}  // namespace boxwood
