#include "app/viewer/frame.h"

#include <imgui.h>

#include <cfloat>

#include "app/gl/read_pixels.h"
#include "app/viewer/keys.h"
#include "app/viewer/theme.h"

namespace boxwood {
namespace {

PixelRect pixel_rect(const ViewRect& rect) {
    return {static_cast<int>(rect.x), static_cast<int>(rect.y), static_cast<int>(rect.width),
            static_cast<int>(rect.height)};
}

}  // namespace

Frame::Frame() = default;

void Frame::upload(const Viewer& viewer) {
    if (uploaded_scene_ != viewer.scene()) {
        uploaded_scene_ = viewer.scene();
        uploaded_built_.reset();
        scene_renderer_.set_mesh(uploaded_scene_->mesh);
    }
    if (uploaded_built_ != viewer.built()) {
        uploaded_built_ = viewer.built();
        scene_renderer_.set_boxes(*uploaded_built_->levels, *viewer.values());
        scene_renderer_.set_references(uploaded_built_->references->refs,
                                       uploaded_scene_->mesh.triangle_count());
        uploaded_visibility_.reset();
    }
    upload_marks(viewer);
}

void Frame::upload_marks(const Viewer& viewer) {
    if (!uploaded_built_ || !viewer.visibility()) return;
    const bool is_other = uploaded_visibility_ != viewer.visibility();
    const std::shared_ptr<const Visits>& visits = viewer.cast().visits;
    if (is_other) {
        scene_renderer_.set_triangle_marks(triangle_marks(uploaded_built_->references->refs, *viewer.values(),
                                                          *viewer.visibility(),
                                                          uploaded_scene_->mesh.triangle_count()));
    }
    if (is_other || uploaded_visits_ != visits)
        scene_renderer_.set_box_marks(*uploaded_built_->levels,
                                      box_marks(*viewer.visibility(), visits.get()));
    uploaded_visibility_ = viewer.visibility();
    uploaded_visits_ = visits;
}

DrawList Frame::draw_list(const Viewer& viewer) const {
    static const LevelTable kNoLevels{};
    static const BoxValues kNoValues{};
    const bool has_boxes = viewer.built() != nullptr;
    return make_draw_list(viewer.state, has_boxes ? *viewer.built()->levels : kNoLevels,
                          has_boxes ? *viewer.values() : kNoValues, viewer.cast());
}

void Frame::run_interface(Viewer& viewer, const FrameLayout& layout) {
    if (ui_.prepare(viewer.state)) ui_renderer_.set_fonts(*ImGui::GetIO().Fonts);
    ImGui::NewFrame();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    PanelInput input = viewer.panel_input(Vec2(mouse.x, mouse.y));
    const DrawList shown = draw_list(viewer);
    input.scale = shown.colors;
    input.empty_color = srgb_from_linear(shown.empty_color);
    input.unvisited_color = srgb_from_linear(shown.unvisited_color);
    input.shared_color = srgb_from_linear(shown.shared_color);
    input.boxes = boxes_;
    input.reference_boxes = reference_boxes_;
    input.gpu_bytes = scene_renderer_.byte_count();

    std::vector<Action> actions = edit(viewer.state, input, layout, viewer.panel_memory);
    const bool moving =
        move_camera(viewer.state, view_input_, layout, viewer.camera(), viewer.scene_bounds(), actions);
    handle_keys(viewer.state, input, viewer.panel_memory, viewer.camera(),
                view_input_.drag == ViewInput::Drag::Look, actions);
    editing_ = moving || ImGui::IsAnyItemActive();
    viewer.apply(actions);
    ImGui::Render();
}

void Frame::draw_pictures(const Viewer& viewer, const FrameLayout& layout) {
    const ViewerState& state = viewer.state;
    const bool traced = state.traced != TracedView::Off && viewer.traced_version() > 0;
    if (traced && state.traced == TracedView::Over) {
        scene_renderer_.set_picture(viewer.traced_image(), viewer.traced_version());
    } else {
        scene_renderer_.clear_picture();
    }
    scene_renderer_.draw(draw_list(viewer), viewer.camera(), target_, pixel_rect(layout.scene));
    boxes_ = scene_renderer_.box_counts();
    reference_boxes_ = scene_renderer_.reference_box_counts();
    if (traced && state.traced == TracedView::Beside) {
        picture_renderer_.draw(viewer.traced_image(), viewer.traced_version(), 1.0f, target_,
                               pixel_rect(layout.traced));
    }
}

void Frame::draw(Viewer& viewer) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(static_cast<float>(viewer.state.width), static_cast<float>(viewer.state.height));
    viewer.update(editing_);
    run_interface(viewer, make_layout(viewer.state));
    viewer.update(editing_);
    upload(viewer);

    target_.resize(viewer.state.width, viewer.state.height);
    target_.clear(clear_grey(viewer.state.theme));
    draw_pictures(viewer, make_layout(viewer.state));
    ui_renderer_.draw(*ImGui::GetDrawData(), target_);
}

Image Frame::capture(Viewer& viewer) {
    ImGui::GetIO().MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
    viewer.wait();
    // A window that sizes itself is hidden in its first frame, and panels show the boxes of the frame before.
    constexpr int kFramesToSettle = 4;
    for (int i = 0; i < kFramesToSettle; ++i) {
        draw(viewer);
        viewer.wait();
    }
    return read_pixels(target_);
}

}  // namespace boxwood
