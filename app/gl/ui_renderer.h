#pragma once

#include <memory>

#include "app/gl/render_target.h"

struct ImDrawData;
struct ImFontAtlas;

namespace boxwood {

/// Draws the data of Dear ImGui into a target, whichever context made it.
class UiRenderer {
public:
    UiRenderer();
    ~UiRenderer();
    UiRenderer(const UiRenderer&) = delete;
    UiRenderer& operator=(const UiRenderer&) = delete;

    /// Uploads the atlas (building it if needed) and gives it its texture id. Call again when fonts changed,
    /// such as after a change of the interface's scale.
    void set_fonts(ImFontAtlas& atlas);
    /// Over what is in the target. Texture ids are OpenGL names of textures.
    void draw(const ImDrawData& data, RenderTarget& target);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood
