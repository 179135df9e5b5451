#pragma once

#include <memory>

#include "app/gl/render_target.h"
#include "app/gl/scene_renderer.h"
#include "app/gl/ui_renderer.h"
#include "app/viewer/ui_context.h"
#include "app/viewer/view_input.h"
#include "app/viewer/viewer.h"

namespace boxwood {

/// Draws the frame, the same in a window and headless. Made and used with one OpenGL context current.
class Frame {
public:
    Frame();

    /// One frame: takes the input written to Dear ImGui's state since the last one, edits the viewer's state,
    /// draws. io.DisplaySize is the frame's size in pixels.
    void draw(Viewer& viewer);

    /// The picture of the viewer's state once all work is done, without input: as many frames as the
    /// interface needs to settle. Throws Error where scene or recipe are refused.
    Image capture(Viewer& viewer);

    const RenderTarget& target() const { return target_; }
    const SceneRenderer& scene_renderer() const { return scene_renderer_; }
    /// Whether a widget or the mouse was held in the last frame.
    bool editing() const { return editing_; }

private:
    /// What the GPU holds of a side.
    struct Uploaded {
        std::shared_ptr<const Built> built{};
        std::shared_ptr<const Visibility> visibility{};
        std::shared_ptr<const Visits> visits{};
        BoxCounts boxes{}, reference_boxes{};
    };
    void upload(const Viewer& viewer);
    void upload_side(const SideWork& work, size_t set);
    void upload_marks(const SideWork& work, size_t set);
    void run_interface(Viewer& viewer, const FrameLayout& layout);
    void draw_pictures(const Viewer& viewer, const FrameLayout& layout);
    void draw_side(const Viewer& viewer, Side side, const SideLayout& places);

    UiContext ui_;
    RenderTarget target_{16, 16};
    SceneRenderer scene_renderer_;
    std::array<PictureRenderer, 2> picture_renderers_;
    UiRenderer ui_renderer_;
    ViewInput view_input_;
    bool editing_ = false;
    std::shared_ptr<const Scene> uploaded_scene_;
    std::array<Uploaded, 2> uploaded_;
};

}  // namespace boxwood
