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

DrawList draw_list(const Viewer& viewer, Side side) {
    static const LevelTable kNoLevels{};
    const SideWork& work = viewer.work(side);
    return make_draw_list(viewer.state, side, work.built() ? *work.built()->levels : kNoLevels,
                          work.rays.cast(), viewer.box_ranges());
}

}  // namespace

Frame::Frame() = default;

void Frame::upload(const Viewer& viewer) {
    if (uploaded_scene_ != viewer.scene()) {
        uploaded_scene_ = viewer.scene();
        uploaded_ = {};
        scene_renderer_.set_mesh(uploaded_scene_->mesh);
        // Another viewer counts its pictures from the beginning again.
        for (const Side side : kSides) {
            scene_renderer_.clear_picture(index_of(side));
            picture_renderers_[index_of(side)].clear();
        }
    }
    if (!uploaded_scene_) return;
    for (const Side side : kSides) upload_side(viewer.work(side), index_of(side));
}

void Frame::upload_side(const SideWork& work, size_t set) {
    Uploaded& there = uploaded_[set];
    if (there.built != work.built()) {
        there = Uploaded{.built = work.built()};
        if (there.built) {
            scene_renderer_.set_boxes(*there.built->levels, *work.values(), set);
            scene_renderer_.set_references(there.built->references->refs,
                                           uploaded_scene_->mesh.triangle_count(), set);
        } else {
            scene_renderer_.clear(set);
        }
    }
    if (there.built && work.visibility()) upload_marks(work, set);
}

void Frame::upload_marks(const SideWork& work, size_t set) {
    Uploaded& there = uploaded_[set];
    const bool is_other = there.visibility != work.visibility();
    const std::shared_ptr<const Visits>& visits = work.rays.cast().visits;
    if (is_other) {
        scene_renderer_.set_triangle_marks(
            triangle_marks(there.built->references->refs, *work.values(), *work.visibility(),
                           uploaded_scene_->mesh.triangle_count()),
            set);
    }
    if (is_other || there.visits != visits) {
        scene_renderer_.set_box_marks(*there.built->levels, box_marks(*work.visibility(), visits.get()), set);
    }
    there.visibility = work.visibility();
    there.visits = visits;
}

void Frame::run_interface(Viewer& viewer, const FrameLayout& layout) {
    if (ui_.prepare(viewer.state)) ui_renderer_.set_fonts(*ImGui::GetIO().Fonts);
    ImGui::NewFrame();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    PanelInput input = viewer.panel_input(Vec2(mouse.x, mouse.y));
    const DrawList shown = draw_list(viewer, viewer.state.active_side());
    input.scale = shown.colors;
    input.empty_color = srgb_from_linear(shown.empty_color);
    input.unvisited_color = srgb_from_linear(shown.unvisited_color);
    input.shared_color = srgb_from_linear(shown.shared_color);
    for (size_t set = 0; set < uploaded_.size(); ++set) {
        input.sides[set].boxes = uploaded_[set].boxes;
        input.sides[set].reference_boxes = uploaded_[set].reference_boxes;
    }
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
    for (const Side side : kSides) {
        if (viewer.state.has(side)) draw_side(viewer, side, layout.side(side));
    }
}

void Frame::draw_side(const Viewer& viewer, Side side, const SideLayout& places) {
    const ViewerState& state = viewer.state;
    const size_t set = index_of(side);
    const Viewer::TracedPicture traced =
        state.traced != TracedView::Off ? viewer.traced_picture(side) : Viewer::TracedPicture{};
    if (traced.image != nullptr && state.traced == TracedView::Over) {
        scene_renderer_.set_picture(*traced.image, traced.version, set);
    } else {
        scene_renderer_.clear_picture(set);
    }
    scene_renderer_.draw(draw_list(viewer, side), viewer.camera(), target_, pixel_rect(places.scene.rect),
                         pixel_rect(places.scene.part), set);
    uploaded_[set].boxes = scene_renderer_.box_counts(set);
    uploaded_[set].reference_boxes = scene_renderer_.reference_box_counts(set);
    const bool is_drawn = side == Side::B && state.shows_difference();  // one picture for both
    if (traced.image != nullptr && state.traced == TracedView::Beside && !is_drawn) {
        picture_renderers_[set].draw(*traced.image, traced.version, 1.0f, target_,
                                     pixel_rect(places.traced.rect), pixel_rect(places.traced.part));
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
