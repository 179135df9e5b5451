#include "app/gl/picture_renderer.h"

namespace boxwood {

void PictureRenderer::draw(const Image& image, uint64_t version, float opacity, RenderTarget& target,
                           const PixelRect& rect, const PixelRect& part) {
    if (rect.width <= 0 || rect.height <= 0 || part.width <= 0 || part.height <= 0) return;
    set(image, version);
    target.bind_image(rect, part);
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    fill(opacity);
    glDisable(GL_SCISSOR_TEST);
}

void PictureRenderer::set(const Image& image, uint64_t version) {
    if (version == version_ || image.width <= 0 || image.height <= 0) return;
    if (!texture_ || image.width != width_ || image.height != height_) {
        texture_ = make_texture(GL_RGBA8, image.width, image.height);
        width_ = image.width;
        height_ = image.height;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(texture_.name(), 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.rgba.data());
    version_ = version;
}

void PictureRenderer::fill(float opacity) const {
    if (!is_set()) return;
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    program_.set("opacity", opacity);
    program_.use();
    glBindTextureUnit(0, texture_.name());
    glBindVertexArray(no_vertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace boxwood
