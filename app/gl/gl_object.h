#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include <glad/gl.h>

namespace boxwood {

/// Owner of one OpenGL name. Create and Delete are the functions of its kind; empty: name 0.
template <class Kind>
class GlObject {
public:
    GlObject() = default;
    explicit GlObject(GLuint name) : name_(name) {}
    ~GlObject() {
        if (name_ != 0) Kind::destroy(name_);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0u)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    GLuint name_ = 0;
};

struct BufferKind {
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayKind {
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureKind {
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct RenderbufferKind {
    static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferKind {
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};

using Buffer = GlObject<BufferKind>;
using VertexArray = GlObject<VertexArrayKind>;
using Texture = GlObject<TextureKind>;
using Renderbuffer = GlObject<RenderbufferKind>;
using Framebuffer = GlObject<FramebufferKind>;

/// A buffer of these bytes, never changed by the CPU again; of no bytes: a buffer of 16 zero bytes.
Buffer make_buffer(std::span<const std::byte> bytes);
/// A buffer of this many zero bytes, at least 16, for the GPU to write.
Buffer make_empty_buffer(size_t byte_count);
/// A buffer of this many bytes, for glNamedBufferSubData.
Buffer make_dynamic_buffer(size_t byte_count);
VertexArray make_vertex_array();
Framebuffer make_framebuffer();
/// Two-dimensional, one level, linear filter, clamped to its edge.
Texture make_texture(GLenum internal_format, int width, int height);
Renderbuffer make_renderbuffer(GLenum internal_format, int width, int height, int sample_count);

}  // namespace boxwood
