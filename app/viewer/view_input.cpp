#include "app/viewer/view_input.h"

#include <imgui.h>

#include <cmath>

namespace boxwood {
namespace {

constexpr float kRadiansPerPixel = 0.006f;
constexpr float kZoomPerNotch = 0.85f;
constexpr float kFlySpeed = 0.35f;  ///< scene sizes a second
constexpr float kWheelPause = 0.4f;
constexpr float kClickReach = 3.0f;  ///< pixels that the pointer may move within a click

Vec3 fly_direction() {
    const auto axis = [](int plus, int minus) {
        return (ImGui::IsKeyDown(plus) ? 1.0f : 0.0f) - (ImGui::IsKeyDown(minus) ? 1.0f : 0.0f);
    };
    return {axis('D', 'A'), axis('E', 'Q'), axis('W', 'S')};
}

ViewInput::Drag started_drag() {
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return ViewInput::Drag::Orbit;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) return ViewInput::Drag::Pan;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return ViewInput::Drag::Look;
    return ViewInput::Drag::None;
}

bool is_held(ViewInput::Drag drag) {
    switch (drag) {
        case ViewInput::Drag::Orbit:
        case ViewInput::Drag::Wipe:
            return ImGui::IsMouseDown(ImGuiMouseButton_Left);
        case ViewInput::Drag::Pan:
            return ImGui::IsMouseDown(ImGuiMouseButton_Middle);
        case ViewInput::Drag::Look:
            return ImGui::IsMouseDown(ImGuiMouseButton_Right);
        case ViewInput::Drag::None:
            break;
    }
    return false;
}

Camera look_and_fly(const Camera& camera, const Vec3& up, const Vec2& delta, const Box& scene) {
    const ImGuiIO& io = ImGui::GetIO();
    const Camera turned =
        look_around(camera, up, -delta.x * kRadiansPerPixel * 0.5f, -delta.y * kRadiansPerPixel * 0.5f);
    const float speed = kFlySpeed * scene_size(scene) * (io.KeyShift ? 10.0f : io.KeyAlt ? 0.1f : 1.0f);
    const Vec3 direction = fly_direction();
    if (direction == Vec3(0.0f) || io.KeyCtrl) return turned;
    return fly(turned, up, direction * (speed * std::min(io.DeltaTime, 0.1f)));
}

/// Left button down and up at one place: selects the node there; with Shift, or where boxes show the picked
/// ray's visits, picks the ray.
void handle_click(const ViewerState& state, ViewInput& input, const Vec2& pointer, bool over_view,
                  std::vector<Action>& actions) {
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        input.may_click = over_view;
        input.pressed = pointer;
    }
    if (glm::distance(pointer, input.pressed) > kClickReach) input.may_click = false;
    if (!input.may_click || !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return;
    input.may_click = false;
    const bool picks_rays = state.box_color == BoxColor::Visits && state.visit_rays == VisitRays::Picked;
    if (ImGui::GetIO().KeyShift || picks_rays) {
        actions.push_back(PickRay{pointer});
    } else {
        actions.push_back(PickNode{pointer});
    }
}

/// True while a wipe bar is held; a double click puts it back to the middle.
bool drag_wipe(ViewerState& state, ViewInput& input, const FrameLayout& layout, const Vec2& pointer,
               bool may_begin) {
    const std::optional<WipeBar> bar = bar_at(layout, pointer, state.interface_scale);
    const bool is_over = bar && may_begin && input.drag == ViewInput::Drag::None;
    if (is_over || input.drag == ViewInput::Drag::Wipe) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (is_over && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        input.drag = ViewInput::Drag::Wipe;
        input.bar = *bar;
        input.pressed = pointer;
        input.may_click = false;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) state.wipe = ViewerState{}.wipe;
    }
    if (input.drag != ViewInput::Drag::Wipe) return false;
    if (!is_held(input.drag)) {
        input.drag = ViewInput::Drag::None;
        return false;
    }
    if (pointer != input.pressed) state.wipe = wipe_at(input.bar, input.bar.x + pointer.x - input.pressed.x);
    return true;
}

}  // namespace

bool move_camera(ViewerState& state, ViewInput& input, const FrameLayout& layout, const Camera& camera,
                 const Box& scene, std::vector<Action>& actions) {
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2 pointer(io.MousePos.x, io.MousePos.y);
    const std::optional<PictureHit> picture = picture_at(layout, pointer);
    const ViewRect view = picture ? picture->rect : layout.side(Side::A).scene.rect;
    const bool over_view = picture && !io.WantCaptureMouse;
    const Vec3 up = up_vector(state.up_axis);

    if (drag_wipe(state, input, layout, pointer, !io.WantCaptureMouse)) return true;
    if (over_view && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        actions.push_back(FocusPoint{pointer});
        input.may_click = false;
        return false;
    }
    handle_click(state, input, pointer, over_view, actions);
    if (!is_held(input.drag)) input.drag = over_view ? started_drag() : ViewInput::Drag::None;
    const Vec2 delta(io.MouseDelta.x, io.MouseDelta.y);
    if (input.drag == ViewInput::Drag::Orbit && delta != Vec2(0.0f)) {
        state.camera = orbit(camera, up, -delta.x * kRadiansPerPixel, delta.y * kRadiansPerPixel);
    } else if (input.drag == ViewInput::Drag::Pan && delta != Vec2(0.0f)) {
        state.camera = pan(camera, delta, layout.side(Side::A).scene.rect);
    } else if (input.drag == ViewInput::Drag::Look &&
               (delta != Vec2(0.0f) || fly_direction() != Vec3(0.0f))) {
        state.camera = look_and_fly(camera, up, delta, scene);
    }
    input.wheel_pause += io.DeltaTime;
    if (over_view && io.MouseWheel != 0.0f) {
        const Camera& now = state.camera ? *state.camera : camera;
        state.camera = zoom_to(now, pointer, std::pow(kZoomPerNotch, io.MouseWheel), view);
        input.wheel_pause = 0.0f;
    }
    return input.drag != ViewInput::Drag::None || input.wheel_pause < kWheelPause;
}

}  // namespace boxwood
