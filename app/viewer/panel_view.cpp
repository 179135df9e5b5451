#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

const ViewerState kDefault{};

std::string level_text(const LevelRange& range, int deepest) {
    const int first = std::min(range.first, deepest), last = std::min(range.last, deepest);
    if (first == last) return "level " + std::to_string(first) + " of " + std::to_string(deepest);
    return "levels " + std::to_string(first) + " to " + std::to_string(last) + " of " +
           std::to_string(deepest);
}

void two_columns(const Context& context) { ImGui::SameLine(138.0f * context.scale); }

void labelled_choice(const Context& context, const char* label, int& value, int default_value,
                     std::span<const char* const> names, const char* tip) {
    ImGui::AlignTextToFramePadding();
    colored(value != default_value ? context.colors.changed : context.colors.dim, label);
    ImGui::SameLine(104.0f * context.scale);
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::PushID(label);
    choice(context, "##choice", value, default_value, names, tip);
    ImGui::PopID();
}

template <class Enum>
void enum_choice(const Context& context, const char* label, Enum& value, Enum default_value,
                 std::span<const char* const> names, const char* tip) {
    int index = static_cast<int>(value);
    labelled_choice(context, label, index, static_cast<int>(default_value), names, tip);
    value = static_cast<Enum>(index);
}

void scale_choice(const Context& context) {
    constexpr std::array<const char*, 7> kScales{"75 %",  "100 %", "125 %", "150 %",
                                                 "200 %", "250 %", "300 %"};
    constexpr std::array<float, 7> kFactors{0.75f, 1.0f, 1.25f, 1.5f, 2.0f, 2.5f, 3.0f};
    float& scale = context.state.interface_scale;
    ImGui::SetNextItemWidth(-1.0f);
    const std::string now = "scale " + percent_text(static_cast<double>(scale), 1.0);
    if (ImGui::BeginCombo("##scale", now.c_str())) {
        for (size_t i = 0; i < kScales.size(); ++i) {
            if (ImGui::Selectable(kScales[i], scale == kFactors[i])) scale = kFactors[i];
        }
        ImGui::EndCombo();
    }
    tooltip(context, "Scale of the interface.");
}

constexpr std::array<const char*, 4> kColors{"level", "primitives below", "share of SAH cost",
                                             "visits of rays"};
constexpr std::array<const char*, 2> kVisitRays{"the picked ray", "all of the view"};
constexpr std::array<const char*, 3> kTraced{"off", "beside", "over the mesh"};
constexpr std::array<const char*, 6> kShadings{"primary",     "normals",     "ambient occlusion",
                                               "heat: nodes", "heat: tests", "heat: exact"};
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

/// What goes with boxes coloured by visits.
void visits_rows(const Context& context) {
    ViewerState& s = context.state;
    enum_choice(context, "visits by", s.visit_rays, kDefault.visit_rays, kVisitRays,
                "Whose visits are counted: those of the ray that was picked by a click (Shift + click at any "
                "time), or of all rays through the pixel centres of the view.");
    toggle(context, "not visited", s.show_unvisited, kDefault.show_unvisited,
           "Boxes that no ray visited are drawn too, faint.");
    two_columns(context);
    ImGui::BeginDisabled(!s.ray.has_value());
    if (ImGui::Button("Forget the ray")) s.ray.reset();
    ImGui::EndDisabled();
    tooltip(context, "Takes the picked ray away.");
}

}  // namespace

int deepest_level(const PanelInput& input) {
    int deepest = 0;
    for (const SideInput& side : input.sides) {
        if (side.built != nullptr)
            deepest = std::max(deepest, static_cast<int>(side.built->levels->level_count()) - 1);
    }
    return deepest;
}

void view_part(const Context& context) {
    ViewerState& s = context.state;
    const int deepest = deepest_level(context.input);
    heading(context, "Levels", level_text(s.levels, deepest));
    level_slider(context, s.levels, deepest);
    toggle(context, "leaves above", s.leaves_above, kDefault.leaves_above,
           "Leaves above the first level are drawn too (L), so that the picture is whole where the tree is "
           "uneven.");
    two_columns(context);
    toggle(context, "see-through", s.see_through, kDefault.see_through,
           "Boxes are seen through what is in front of them (K); otherwise hidden lines are not drawn.");
    toggle(context, "boxes", s.show_boxes, kDefault.show_boxes, "Boxes of the nodes of the level range (B).");
    two_columns(context);
    toggle(context, "boxes of pieces", s.show_reference_boxes, kDefault.show_reference_boxes,
           "The reference boxes of subdivided triangles, coloured by the triangle they belong to (P).");
    toggle(context, "mesh", s.show_mesh, kDefault.show_mesh, "The surface (M).");
    two_columns(context);
    toggle(context, "wire", s.show_wire, kDefault.show_wire, "The edges of the triangles (W).");
    toggle(context, "empty cells", s.show_empty, kDefault.show_empty,
           "Leaves without primitives are drawn too (E), in a colour of their own.");
    two_columns(context);
    toggle(context, "in several leaves", s.show_shared, kDefault.show_shared,
           "Triangles in blue that the builder put into several leaves, though the references stage made one "
           "reference of them (D).");
    toggle(context, "red pieces", s.show_red, kDefault.show_red,
           "Triangles with more than one reference in red (R).");
    two_columns(context);
    bool orthographic = context.input.camera.orthographic;
    toggle(context, "orthographic", orthographic, false, "Parallel instead of perspective projection (O).");
    if (orthographic != context.input.camera.orthographic) {
        s.camera = context.input.camera;
        s.camera->orthographic = orthographic;
    }
    enum_choice(
        context, "box colour", s.box_color, kDefault.box_color, kColors,
        "What the colour of a box says: its level, the references below it, its own share of the SAH cost "
        "(half area x visits or tests), or how often rays visit it (V).");
    if (s.box_color == BoxColor::Visits) visits_rows(context);
    enum_choice(context, "colour map", s.color_map, kDefault.color_map, kColorMapNames,
                "Perceptual colour maps that colour-blind eyes read too: for boxes and the heat map.");
    const UpAxis old_axis = s.up_axis;
    enum_choice(context, "up axis", s.up_axis, kDefault.up_axis, kAxes, "Axis that points up (U).");
    if (s.up_axis != old_axis && s.camera) s.camera->up = up_vector(s.up_axis);
}

void trace_part(const Context& context) {
    ViewerState& s = context.state;
    const TraceState& trace = context.side.trace;
    std::string done;
    if (s.traced != TracedView::Off) {
        done = trace.converged ? "converged" : percent_text(trace.progress, 1.0);
    }
    heading(context, "Ray-traced view", done);
    enum_choice(context, "where", s.traced, kDefault.traced, kTraced,
                "The live CPU ray-traced picture, same camera (T).");
    if (s.traced == TracedView::Off) return;
    enum_choice(context, "shading", s.shading, kDefault.shading, kShadings,
                "What a pixel shows; a heat map (H) counts the nodes visited, the primitives tested, or the "
                "decisions left to exact arithmetic by its primary ray.");
    if (is_heat(s.shading)) {
        if (s.compares()) {
            toggle(
                context, "difference A \u2212 B", s.heat_difference, kDefault.heat_difference,
                "The signed difference of both heat maps in one picture, zero in the middle of its colours "
                "(J): orange where A does more, blue where B does more.");
        }
        toggle(context, "logarithmic", s.log_heat, kDefault.log_heat, "Logarithmic scale of the heat map.");
        two_columns(context);
        ImGui::SetNextItemWidth(-1.0f);
        ImGui::DragFloat("##max", &s.heat_max, 1.0f, 0.0f, 1e6f,
                         s.heat_max > 0.0f ? "up to %.0f" : "scale: automatic", ImGuiSliderFlags_AlwaysClamp);
        if (put_back()) s.heat_max = 0.0f;
        tooltip(context,
                "Upper end of the heat scale; 0: from the picture. A fixed end makes two pictures "
                "comparable. Right click: automatic.");
    }
    constexpr std::array<const char*, 2> kModes{"exact", "fast"};
    enum_choice(
        context, "intersection", s.mode, kDefault.mode, kModes,
        "exact: the answer of exact arithmetic; fast: float arithmetic, wrong only at edges and ties.");
}

float session_height(const Context& context) {
    const float spacing = ImGui::GetStyle().ItemSpacing.y;
    const float title = 2.0f * context.scale + ImGui::GetTextLineHeight() + 4.0f * spacing + 1.0f;
    return std::ceil(title + 2.0f * ImGui::GetFrameHeight() + spacing);
}

void session_part(const Context& context) {
    ViewerState& s = context.state;
    heading(context, "Session");
    if (ImGui::Button("Save...")) context.memory.ask_save = true;
    tooltip(context, "Ctrl+S: writes a session file; every picture carries its session too.");
    ImGui::SameLine();
    if (ImGui::Button("Copy")) context.actions.push_back(CopySession{});
    tooltip(context, "Ctrl+C: the session as text. Ctrl+V pastes one.");
    ImGui::SameLine();
    ImGui::BeginDisabled(context.input.undo_count == 0);
    if (ImGui::Button("Undo")) context.actions.push_back(UndoStep{});
    ImGui::EndDisabled();
    tooltip(context, "Ctrl+Z: one setting back, " + grouped(context.input.undo_count) + " steps to go.");
    ImGui::SameLine();
    ImGui::BeginDisabled(context.input.redo_count == 0);
    if (ImGui::Button("Redo")) context.actions.push_back(RedoStep{});
    ImGui::EndDisabled();
    tooltip(context, "Ctrl+Shift+Z: one setting forward again.");
    ImGui::SameLine();
    if (ImGui::Button("Keys")) s.show_keys = !s.show_keys;
    tooltip(context, "?: all keys.");
    constexpr std::array<const char*, 2> kThemes{"dark", "light"};
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    int theme = static_cast<int>(s.theme);
    ImGui::SetNextItemWidth(half);
    choice(context, "##theme", theme, 0, kThemes, "Colours of the interface.");
    s.theme = static_cast<Theme>(theme);
    ImGui::SameLine();
    scale_choice(context);
}

}  // namespace boxwood::panel
