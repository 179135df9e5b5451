#include "app/gl/gl_object.h"

#include <algorithm>

namespace boxwood {

namespace {

constexpr size_t kSmallestBuffer = 16;  // a buffer of no bytes cannot be bound

Buffer make_buffer_of(size_t byte_count, const void* data, GLbitfield flags) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(byte_count), data, flags);
    return Buffer(name);
}

}  // namespace

Buffer make_buffer(std::span<const std::byte> bytes) {
    return bytes.empty() ? make_empty_buffer(0) : make_buffer_of(bytes.size(), bytes.data(), 0);
}

Buffer make_empty_buffer(size_t byte_count) {
    Buffer buffer = make_buffer_of(std::max(byte_count, kSmallestBuffer), nullptr, 0);
    glClearNamedBufferData(buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    return buffer;
}

Buffer make_dynamic_buffer(size_t byte_count) {
    return make_buffer_of(byte_count, nullptr, GL_DYNAMIC_STORAGE_BIT);
}

VertexArray make_vertex_array() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return VertexArray(name);
}

Framebuffer make_framebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return Framebuffer(name);
}

Texture make_texture(GLenum internal_format, int width, int height) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, internal_format, width, height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return Texture(name);
}

Renderbuffer make_renderbuffer(GLenum internal_format, int width, int height, int sample_count) {
    GLuint name = 0;
    glCreateRenderbuffers(1, &name);
    glNamedRenderbufferStorageMultisample(name, sample_count, internal_format, width, height);
    return Renderbuffer(name);
}

}  // namespace boxwood
