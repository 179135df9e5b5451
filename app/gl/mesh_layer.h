#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/gl/program.h"
#include "app/gl/view_transform.h"
#include "core/refs/prim_ref.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// The surface on the GPU: three corners for each triangle, its colour, its normal, and its mark.
class MeshLayer {
public:
    void upload(const Mesh& mesh, const UnitSpace& space);
    /// TriangleMark bits of each triangle, for one of two structures over the surface: set 0 or 1.
    void upload_marks(std::span<const uint8_t> marks, size_t set);
    void clear_marks(size_t set);

    /// Draws all triangles, marked by that set, with the program in use, which is `program`; selected:
    /// triangle or kNoIndex.
    void draw(const Program& program, uint32_t selected, size_t set) const;

    size_t byte_count() const;
    uint64_t upload_count() const { return upload_count_; }

private:
    struct Chunk {
        VertexArray vertex_array;
        Buffer corners, triangles;
        std::array<Buffer, 2> marks;
        uint32_t first = 0;
        uint32_t count = 0;
    };
    std::vector<Chunk> chunks_;
    uint64_t upload_count_ = 0;
};

}  // namespace boxwood
