#pragma once

#include "app/gl/gl_object.h"

namespace boxwood {

/// Part of a frame in pixels; row 0 on top.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;

    bool operator==(const PixelRect&) const = default;
};

/// The image that a frame is drawn into, of the window as of a headless picture: sRGB-coded RGBA of 8 bits,
/// four samples per pixel and a depth buffer for the 3D view, one sample for what is drawn over it.
class RenderTarget {
public:
    RenderTarget(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Makes it this large; the content is lost where that changes anything.
    void resize(int width, int height);
    /// Clears the whole image to this sRGB-coded grey.
    void clear(float grey);

    /// Lets the following calls draw into the samples of `rect`; of them, with GL_SCISSOR_TEST, `part` alone.
    void bind_samples(const PixelRect& rect, const PixelRect& part) const;
    /// Takes the samples of `rect` over into the image.
    void resolve(const PixelRect& rect) const;
    /// Lets the following calls draw into `rect` of the image; with GL_SCISSOR_TEST into `part` alone.
    void bind_image(const PixelRect& rect, const PixelRect& part) const;
    void bind_image(const PixelRect& rect) const { bind_image(rect, rect); }
    /// Copies the image to the window's back buffer, the upper left corners on each other.
    void show(int window_width, int window_height) const;

    GLuint image_framebuffer() const { return image_framebuffer_.name(); }

private:
    void allocate();
    int width_;
    int height_;
    Renderbuffer samples_, depth_;
    Texture image_;
    Framebuffer sample_framebuffer_, image_framebuffer_;
};

}  // namespace boxwood
