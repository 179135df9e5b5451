#include "app/gl/mesh_layer.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/render/image.h"

namespace boxwood {
namespace {

constexpr uint32_t kChunkTriangles = 1u << 22;  // triangles

struct TriangleData {
    uint32_t color;   ///< sRGB bytes, red lowest
    uint32_t normal;  ///< octahedral, two signed 16-bit numbers
};

uint32_t pack_signed(double x) {
    const auto value = static_cast<int32_t>(std::lround(std::clamp(x, -1.0, 1.0) * 32767.0));
    return static_cast<uint32_t>(value) & 0xffffu;
}

/// See unpack_normal in shaders/mesh.frag.
uint32_t pack_normal(const Triangle& triangle) {
    DVec3 n = glm::cross(DVec3(triangle.b) - DVec3(triangle.a), DVec3(triangle.c) - DVec3(triangle.a));
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0.0 && std::isfinite(sum))) return pack_signed(0.0);
    n /= sum;
    const double sign_x = n.x >= 0.0 ? 1.0 : -1.0, sign_y = n.y >= 0.0 ? 1.0 : -1.0;
    const double x = n.z >= 0.0 ? n.x : (1.0 - std::abs(n.y)) * sign_x;
    const double y = n.z >= 0.0 ? n.y : (1.0 - std::abs(n.x)) * sign_y;
    return pack_signed(x) | pack_signed(y) << 16;
}

uint32_t pack_color(const Vec3& linear) {
    return uint32_t{srgb_byte(linear.x)} | uint32_t{srgb_byte(linear.y)} << 8 |
           uint32_t{srgb_byte(linear.z)} << 16 | 0xff000000u;
}

size_t mark_words(size_t triangle_count) { return (triangle_count + 7) / 8; }

/// Four bits for each triangle.
std::vector<uint32_t> pack_marks(std::span<const uint8_t> marks) {
    std::vector<uint32_t> words(mark_words(marks.size()), 0u);
    for (size_t i = 0; i < marks.size(); ++i) words[i / 8] |= uint32_t{marks[i]} << (4 * (i % 8));
    return words;
}

VertexArray make_corner_array(const Buffer& corners) {
    VertexArray array = make_vertex_array();
    glVertexArrayVertexBuffer(array.name(), 0, corners.name(), 0, sizeof(Vec3));
    glEnableVertexArrayAttrib(array.name(), 0);
    glVertexArrayAttribFormat(array.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array.name(), 0, 0);
    return array;
}

}  // namespace

void MeshLayer::upload(const Mesh& mesh, const UnitSpace& space) {
    chunks_.clear();
    std::vector<uint32_t> colors;
    for (const MeshObject& object : mesh.objects) colors.push_back(pack_color(object.base_color));
    const auto triangle_count = static_cast<uint32_t>(mesh.triangle_count());
    for (uint32_t first = 0; first < triangle_count; first += kChunkTriangles) {
        Chunk chunk;
        chunk.first = first;
        chunk.count = std::min(triangle_count - first, kChunkTriangles);
        std::vector<Vec3> corners(size_t{3} * chunk.count);
        std::vector<TriangleData> triangles(chunk.count);
        parallel_for(chunk.count, 4096, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const auto prim = static_cast<uint32_t>(first + i);
                const Triangle triangle = mesh.triangle(prim);
                corners[3 * i] = space.from_world(triangle.a);
                corners[3 * i + 1] = space.from_world(triangle.b);
                corners[3 * i + 2] = space.from_world(triangle.c);
                triangles[i] = {colors[mesh.object[prim]], pack_normal(triangle)};
            }
        });
        chunk.corners = make_buffer(std::as_bytes(std::span(corners)));
        chunk.triangles = make_buffer(std::as_bytes(std::span(triangles)));
        for (Buffer& marks : chunk.marks)
            marks = make_empty_buffer(mark_words(chunk.count) * sizeof(uint32_t));
        chunk.vertex_array = make_corner_array(chunk.corners);
        chunks_.push_back(std::move(chunk));
        ++upload_count_;
    }
}

void MeshLayer::upload_marks(std::span<const uint8_t> marks, size_t set) {
    for (Chunk& chunk : chunks_) {
        const std::vector<uint32_t> words = pack_marks(marks.subspan(chunk.first, chunk.count));
        chunk.marks[set] = make_buffer(std::as_bytes(std::span(words)));
        ++upload_count_;
    }
}

void MeshLayer::clear_marks(size_t set) {
    for (Chunk& chunk : chunks_)
        chunk.marks[set] = make_empty_buffer(mark_words(chunk.count) * sizeof(uint32_t));
}

void MeshLayer::draw(const Program& program, uint32_t selected, size_t set) const {
    for (const Chunk& chunk : chunks_) {
        const bool is_here = selected >= chunk.first && selected - chunk.first < chunk.count;
        program.set("selected", is_here ? static_cast<int>(selected - chunk.first) : -1);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, chunk.triangles.name());
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, chunk.marks[set].name());
        glBindVertexArray(chunk.vertex_array.name());
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * chunk.count));
    }
}

size_t MeshLayer::byte_count() const {
    size_t bytes = 0;
    for (const Chunk& chunk : chunks_) {
        bytes += chunk.count * (3 * sizeof(Vec3) + sizeof(TriangleData)) + 2 * mark_words(chunk.count) * 4;
    }
    return bytes;
}

}  // namespace boxwood
