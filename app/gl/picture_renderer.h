#pragma once

#include <cstdint>

#include "app/gl/program.h"
#include "app/gl/render_target.h"
#include "core/render/image.h"

namespace boxwood {

/// Draws a picture into a rect of the target, over what is there. Keeps one picture on the GPU and uploads it
/// where `version` differs from the last one's; versions begin with 1.
class PictureRenderer {
public:
    /// opacity in [0, 1]. Scaled to fill the rect, of which only `part` is drawn.
    void draw(const Image& image, uint64_t version, float opacity, RenderTarget& target,
              const PixelRect& rect, const PixelRect& part);

    /// The two halves of draw(), for a picture that something else is drawn over.
    void set(const Image& image, uint64_t version);
    bool is_set() const { return version_ != 0; }
    void clear() { version_ = 0; }
    /// Fills the viewport that is bound.
    void fill(float opacity) const;

private:
    Program program_{"picture.vert", "picture.frag"};
    VertexArray no_vertices_ = make_vertex_array();
    Texture texture_;
    int width_ = 0;
    int height_ = 0;
    uint64_t version_ = 0;  ///< 0: none
};

}  // namespace boxwood
