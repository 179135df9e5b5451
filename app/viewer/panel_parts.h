#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/viewer/panels.h"
#include "app/viewer/theme.h"

namespace boxwood::panel {

/// What every part of the panels gets.
struct Context {
    ViewerState& state;
    const PanelInput& input;
    const SideInput& side;  ///< of the active side
    const FrameLayout& layout;
    PanelMemory& memory;
    std::vector<Action>& actions;
    const ThemeColors& colors;
    float scale;  ///< of the interface
};

/// As much of a text's beginning as fits into a width, with dots where something is left out.
std::string beginning_of(const std::string& text, float width);

/// Shows `text` while the last item is hovered, wrapped.
void tooltip(const Context& context, const std::string& text);
/// Heading of a group of widgets; `note` stands dim at its right end.
void heading(const Context& context, const char* title, const std::string& note = {});
/// Dim, small, wrapped.
void note(const Context& context, const std::string& text);
void colored(const Vec4& color, const std::string& text);
/// A name, its beginning where the panel is too narrow, and its value at the right end of the line, with a
/// tooltip for both.
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
/// Head of the recipe's panel: one recipe or two, and which of them is edited.
void compare_part(const Context& context);
void view_part(const Context& context);
void trace_part(const Context& context);
void session_part(const Context& context);
/// Height that session_part needs, in pixels.
float session_height(const Context& context);
void measures_part(const Context& context);
/// A name in a row of which one is shown.
struct Tab {
    std::string name;
    std::string tip;
    Vec4 color;  ///< of the line under the one that is shown
};
/// The one that was clicked.
std::optional<size_t> tabs(const Context& context, std::span<const Tab> all, size_t shown);
/// "copy as TSV, Markdown, JSON" of a table; the functions make its text.
void copy_buttons(const Context& context, const char* id, const std::function<std::string()>& tsv,
                  const std::function<std::string()>& markdown, const std::function<std::string()>& json);
/// Text at the right end of the space that is left.
void right_text(const std::string& text);
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

/// Colour that stands for a side, sRGB: as in the picture of the difference.
Vec3 side_color(Theme theme, Side side);
inline const char* side_name(Side side) { return side == Side::A ? "A" : "B"; }
/// " of A" where two are compared, otherwise nothing.
std::string of_side(const ViewerState& state);
/// Two recipes or one: B is what it was last, or begins as a copy of A.
void toggle_compare(ViewerState& state, PanelMemory& memory);
/// The signed difference of the heat maps, which are shown where nothing else is; again: both heat maps.
void toggle_difference(ViewerState& state);
/// Last level of the deeper tree.
int deepest_level(const PanelInput& input);

/// Hides the selected node, shows it alone or, if it is alone, all; puts back what is not shown.
void hide_selected(ViewerState& state);
void isolate_selected(ViewerState& state);
void put_nodes_back(ViewerState& state);

void legends(const Context& context);
/// Which recipe is where, on the pictures, and the wipe bar.
void side_labels(const Context& context);
/// Room that the labels leave at the top of the pictures, in pixels.
float label_height(const Context& context);
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
