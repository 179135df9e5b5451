#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"
#include "core/scene/frame.h"

namespace boxwood::panel {
namespace {

constexpr int kFramesPerSecond = 24;

void built_in_list(const Context& context) {
    for (const BuiltInScene& scene : built_in_scenes()) {
        const bool selected = context.state.scene == scene.name;
        if (ImGui::Selectable(scene.name, selected)) context.actions.push_back(OpenPath{scene.name});
        const std::string options = scene.options;
        tooltip(context, scene.description + (options.empty() ? "" : "\nOptions: @" + options));
    }
}

void recent_list(const Context& context) {
    if (context.input.recent.empty()) return;
    ImGui::Separator();
    colored(context.colors.dim, "recent files");
    int id = 0;
    for (const std::string& path : context.input.recent) {
        ImGui::PushID(id++);
        const std::string name = path.substr(path.rfind('/') + 1);
        if (ImGui::Selectable(name.c_str())) context.actions.push_back(OpenPath{path});
        tooltip(context, path);
        ImGui::PopID();
    }
}

void skipped_and_warnings(const Context& context, const Scene& scene) {
    uint64_t skipped = 0;
    std::string reasons;
    for (const auto& [reason, count] : scene.skipped) {
        skipped += count;
        reasons += (reasons.empty() ? "" : "\n") + grouped(count) + ": " + reason;
    }
    if (skipped > 0)
        value_row(context, "left out", grouped(skipped), "Triangles of the file left out:\n" + reasons);
    if (!scene.mesh.points.positions.empty()) {
        value_row(context, "points", grouped(scene.mesh.points.positions.size()),
                  "Points have no surface: structures and rays ignore them.");
    }
    for (const std::string& warning : scene.warnings) note(context, warning);
}

/// Slider of an animated scene's frame, and what plays it: the next frame comes once this one is on screen.
void frame_slider(const Context& context) {
    PanelMemory& memory = context.memory;
    const std::optional<SceneFrame> wanted = scene_frame(context.state.scene);
    memory.playing = memory.playing && wanted.has_value();
    if (!wanted) return;
    const float width = 64.0f * context.scale;
    ImGui::SetNextItemWidth(-width - ImGui::GetStyle().ItemSpacing.x);
    int frame = wanted->frame;
    ImGui::SliderInt("##frame", &frame, 0, wanted->count - 1, "frame %d", ImGuiSliderFlags_AlwaysClamp);
    tooltip(context,
            "Frame of the animation; the view stays. A recipe that ends in refit(from=F) keeps the tree "
            "of frame F and fits its boxes to this one.");
    const bool is_held = ImGui::IsItemActive();
    ImGui::SameLine();
    if (ImGui::Button(memory.playing ? "Pause" : "Play", {width, 0.0f})) memory.playing = !memory.playing;
    tooltip(context, "Shows one frame after another, each as soon as its structure is built, at most " +
                         std::to_string(kFramesPerSecond) + " a second.");
    const bool is_shown = context.side.built != nullptr && !context.input.progress.running &&
                          context.side.built->scene->spec == context.state.scene;
    memory.frame_seconds = memory.playing ? memory.frame_seconds + ImGui::GetIO().DeltaTime : 0.0f;
    if (is_shown && !is_held && memory.frame_seconds * kFramesPerSecond >= 1.0f) {
        frame = (frame + 1) % wanted->count;
        memory.frame_seconds = 0.0f;
    }
    if (frame != wanted->frame) context.state.scene = with_frame(context.state.scene, frame);
}

}  // namespace

void scene_part(const Context& context) {
    const Scene* scene = context.input.scene;
    heading(context, "Scene");
    const std::string title = scene != nullptr ? scene->title : context.state.scene;
    const float open_width = 64.0f * context.scale;
    ImGui::SetNextItemWidth(-open_width - ImGui::GetStyle().ItemSpacing.x);
    if (ImGui::BeginCombo("##scene", title.c_str(), ImGuiComboFlags_HeightLarge)) {
        built_in_list(context);
        recent_list(context);
        ImGui::EndCombo();
    }
    tooltip(context, "Built-in scenes and recent files. A file can be dropped on the window too.\n" +
                         context.state.scene);
    ImGui::SameLine();
    if (ImGui::Button("Open...", {open_width, 0.0f})) context.memory.ask_open = true;
    tooltip(context, "Ctrl+O: a scene (glTF, OBJ, PLY, STL, ...), a session, or a picture that carries one.");
    if (scene == nullptr) return;
    frame_slider(context);
    value_row(context, "triangles", grouped(scene->mesh.triangle_count()),
              "Triangles kept: " + grouped(scene->mesh.triangle_count()) + " in " +
                  grouped(scene->mesh.objects.size()) + " objects, " + byte_text(scene->mesh.byte_count()) +
                  (context.state.show_times ? ".\nRead in " + time_text(scene->load_ms) + "." : "."));
    skipped_and_warnings(context, *scene);
}

}  // namespace boxwood::panel
