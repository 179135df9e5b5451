#include "app/gl/render_target.h"

#include <algorithm>

namespace boxwood {
namespace {

constexpr int kSampleCount = 4;

/// OpenGL's rows go upwards.
int lower_row(const PixelRect& rect, int height) { return height - rect.y - rect.height; }

void bind(GLuint framebuffer, const PixelRect& rect, const PixelRect& part, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(rect.x, lower_row(rect, height), rect.width, rect.height);
    glScissor(part.x, lower_row(part, height), part.width, part.height);
}

}  // namespace

RenderTarget::RenderTarget(int width, int height) : width_(std::max(width, 1)), height_(std::max(height, 1)) {
    allocate();
}

void RenderTarget::resize(int width, int height) {
    width = std::max(width, 1);
    height = std::max(height, 1);
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    allocate();
}

void RenderTarget::allocate() {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &largest);
    const int sample_count = std::min(kSampleCount, static_cast<int>(largest));
    samples_ = make_renderbuffer(GL_RGBA8, width_, height_, sample_count);
    depth_ = make_renderbuffer(GL_DEPTH_COMPONENT32F, width_, height_, sample_count);
    image_ = make_texture(GL_RGBA8, width_, height_);
    sample_framebuffer_ = make_framebuffer();
    glNamedFramebufferRenderbuffer(sample_framebuffer_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   samples_.name());
    glNamedFramebufferRenderbuffer(sample_framebuffer_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                   depth_.name());
    image_framebuffer_ = make_framebuffer();
    glNamedFramebufferTexture(image_framebuffer_.name(), GL_COLOR_ATTACHMENT0, image_.name(), 0);
    clear(0.0f);
}

void RenderTarget::clear(float grey) {
    const float color[] = {grey, grey, grey, 1.0f};
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(image_framebuffer_.name(), GL_COLOR, 0, color);
}

void RenderTarget::bind_samples(const PixelRect& rect, const PixelRect& part) const {
    bind(sample_framebuffer_.name(), rect, part, height_);
}

void RenderTarget::resolve(const PixelRect& rect) const {
    const int row = lower_row(rect, height_);
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(sample_framebuffer_.name(), image_framebuffer_.name(), rect.x, row,
                           rect.x + rect.width, row + rect.height, rect.x, row, rect.x + rect.width,
                           row + rect.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void RenderTarget::bind_image(const PixelRect& rect, const PixelRect& part) const {
    bind(image_framebuffer_.name(), rect, part, height_);
}

void RenderTarget::show(int window_width, int window_height) const {
    const int width = std::min(width_, window_width);
    const int height = std::min(height_, window_height);
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(image_framebuffer_.name(), 0, 0, height_ - height, width, height_, 0,
                           window_height - height, width, window_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace boxwood
