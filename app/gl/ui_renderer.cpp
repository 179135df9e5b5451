#include "app/gl/ui_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <imgui.h>

#include "app/gl/program.h"

namespace boxwood {
namespace {

static_assert(sizeof(ImTextureID) >= sizeof(GLuint));
constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;

void set_attribute(const VertexArray& array, GLuint index, GLint size, GLenum type, GLboolean normalized,
                   size_t offset) {
    glEnableVertexArrayAttrib(array.name(), index);
    glVertexArrayAttribFormat(array.name(), index, size, type, normalized, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(array.name(), index, 0);
}

Buffer make_stream() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return Buffer(name);
}

template <class T>
void stream(const Buffer& buffer, const ImVector<T>& items) {
    glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(items.size_in_bytes()), items.Data,
                      GL_STREAM_DRAW);
}

}  // namespace

struct UiRenderer::Impl {
    Program program{"ui.vert", "ui.frag"};
    VertexArray array = make_vertex_array();
    Buffer vertices = make_stream();
    Buffer indices = make_stream();
    Texture atlas;

    void draw_list(const ImDrawList& list, const ImDrawData& data, int target_height);
    void draw_command(const ImDrawCmd& command, const ImDrawData& data, int target_height);
};

UiRenderer::UiRenderer() : impl_(std::make_unique<Impl>()) {
    glVertexArrayVertexBuffer(impl_->array.name(), 0, impl_->vertices.name(), 0, sizeof(ImDrawVert));
    glVertexArrayElementBuffer(impl_->array.name(), impl_->indices.name());
    set_attribute(impl_->array, 0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    set_attribute(impl_->array, 1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    set_attribute(impl_->array, 2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
}

UiRenderer::~UiRenderer() = default;

void UiRenderer::set_fonts(ImFontAtlas& atlas) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsRGBA32(&pixels, &width, &height);
    impl_->atlas = make_texture(GL_RGBA8, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(impl_->atlas.name(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    atlas.SetTexID(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(impl_->atlas.name())));
}

void UiRenderer::draw(const ImDrawData& data, RenderTarget& target) {
    if (!data.Valid || data.CmdListsCount == 0 || data.DisplaySize.x <= 0.0f || data.DisplaySize.y <= 0.0f) {
        return;
    }
    target.bind_image({0, 0, target.width(), target.height()});
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    impl_->program.set("display",
                       Vec4(data.DisplayPos.x, data.DisplayPos.y, data.DisplaySize.x, data.DisplaySize.y));
    impl_->program.use();
    glBindVertexArray(impl_->array.name());
    for (int i = 0; i < data.CmdListsCount; ++i) impl_->draw_list(*data.CmdLists[i], data, target.height());
    glDisable(GL_SCISSOR_TEST);
}

void UiRenderer::Impl::draw_list(const ImDrawList& list, const ImDrawData& data, int target_height) {
    stream(vertices, list.VtxBuffer);
    stream(indices, list.IdxBuffer);
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback == nullptr) {
            draw_command(command, data, target_height);
        } else if (command.UserCallback != ImDrawCallback_ResetRenderState) {
            command.UserCallback(&list, &command);
        }
    }
}

void UiRenderer::Impl::draw_command(const ImDrawCmd& command, const ImDrawData& data, int target_height) {
    const ImVec2 scale = data.FramebufferScale;
    const auto pixel = [](float position) { return static_cast<int>(std::floor(position)); };
    const int left = std::max(pixel((command.ClipRect.x - data.DisplayPos.x) * scale.x), 0);
    const int top = std::max(pixel((command.ClipRect.y - data.DisplayPos.y) * scale.y), 0);
    const int right = pixel((command.ClipRect.z - data.DisplayPos.x) * scale.x);
    const int bottom = pixel((command.ClipRect.w - data.DisplayPos.y) * scale.y);
    if (right <= left || bottom <= top || command.ElemCount == 0) return;
    glScissor(left, target_height - bottom, right - left, bottom - top);
    glBindTextureUnit(0, static_cast<GLuint>(reinterpret_cast<intptr_t>(command.GetTexID())));
    const size_t first_byte = command.IdxOffset * sizeof(ImDrawIdx);
    glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                             reinterpret_cast<const void*>(first_byte),
                             static_cast<GLint>(command.VtxOffset));
}

}  // namespace boxwood
