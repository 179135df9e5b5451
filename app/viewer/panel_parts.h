#pragma once

#include <string>
#include <vector>

#include "app/viewer/panels.h"
#include "app/viewer/theme.h"

namespace boxwood::panel {

/// What every part of the panels gets.
struct Context {
    ViewerState& state;
    const PanelInput& input;
    const FrameLayout& layout;
    PanelMemory& memory;
    std::vector<Action>& actions;
    const ThemeColors& colors;
    float scale;  ///< of the interface
};

/// Shows `text` while the last item is hovered, wrapped.
void tooltip(const Context& context, const std::string& text);
/// Heading of a group of widgets; `note` stands dim at its right end.
void heading(const Context& context, const char* title, const std::string& note = {});
/// Dim, small, wrapped.
void note(const Context& context, const std::string& text);
void colored(const Vec4& color, const std::string& text);
/// A name, and its value at the right end of the line, with a tooltip for both.
void value_row(const Context& context, const char* name, const std::string& value, const std::string& tip);
/// A check box for a switch of the state; marked if it is not its default, put back by a right click.
void toggle(const Context& context, const char* label, bool& value, bool default_value, const char* tip);
/// A combo box of names for an enum; the same marks.
bool choice(const Context& context, const char* label, int& value, int default_value,
            std::span<const char* const> names, const char* tip);
/// Whether the last item was right clicked: puts its value back.
bool put_back();

void scene_part(const Context& context);
void recipe_part(const Context& context);
void view_part(const Context& context);
void trace_part(const Context& context);
void session_part(const Context& context);
void measures_part(const Context& context);
/// The tabs of the lower half of the right panel.
void side_tabs(const Context& context);
void level_table_part(const Context& context);
void node_part(const Context& context);
void verify_part(const Context& context);

/// Colour of what "Verify" found wrong, sRGB.
inline constexpr Vec3 kWrongColor{1.0f, 0.35f, 0.95f};
/// Marks the wrong pixels in the traced view.
void wrong_marks(const Context& context);
/// A colour and what it stands for.
void swatch(const Context& context, const Vec3& srgb, const std::string& text);

/// Hides the selected node, shows it alone or, if it is alone, all; puts back what is not shown.
void hide_selected(ViewerState& state);
void isolate_selected(ViewerState& state);
void put_nodes_back(ViewerState& state);

void legends(const Context& context);
void status_line(const Context& context);
void message_line(const Context& context);
void work_line(const Context& context);
void key_list(const Context& context);
void dialogs(const Context& context);

/// Two-handled slider of the level range; true if it changed.
bool level_slider(const Context& context, LevelRange& range, int deepest);

/// Widgets for the parameters of a stage, generated from its describe; true if one changed.
bool stage_widgets(const Context& context, Stage& stage);

}  // namespace boxwood::panel
