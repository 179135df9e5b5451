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
    void upload(const Viewer& viewer);
    void upload_marks(const Viewer& viewer);
    void run_interface(Viewer& viewer, const FrameLayout& layout);
    void draw_pictures(const Viewer& viewer, const FrameLayout& layout);
    DrawList draw_list(const Viewer& viewer) const;

    UiContext ui_;
    RenderTarget target_{16, 16};
    SceneRenderer scene_renderer_;
    PictureRenderer picture_renderer_;
    UiRenderer ui_renderer_;
    ViewInput view_input_;
    bool editing_ = false;
    std::shared_ptr<const Scene> uploaded_scene_;
    std::shared_ptr<const Built> uploaded_built_;
    std::shared_ptr<const Visibility> uploaded_visibility_;
    std::shared_ptr<const Visits> uploaded_visits_;
    BoxCounts boxes_, reference_boxes_;
};

}  // namespace boxwood
