#pragma once

#include <span>
#include <vector>

#include "core/base/task.h"
#include "core/bvh/bvh2.h"

namespace boxwood {

/// What a leaf holds of a primitive: the part of its triangle inside the leaf's box.
struct Piece {
    Box box;  ///< the smallest box around that part
    uint32_t prim;
    bool is_whole;  ///< the part is all of the triangle
};

/// What each node of a binary BVH has to contain, whatever its references were made of: each reference's box
/// lies in its leaf's box, so the union of a triangle's pieces in its leaves contains the triangle.
class NodeContent {
public:
    NodeContent(const Mesh& mesh, const Bvh2& bvh, const Task& task);

    /// Pieces of all leaves below a node, or of the leaf itself; one or more.
    std::span<const Piece> of(uint32_t node) const {
        return std::span(pieces_).subspan(begin_[node], end_[node] - begin_[node]);
    }

private:
    std::vector<Piece> pieces_;          // leaves from left to right
    std::vector<uint32_t> begin_, end_;  // of each node
};

/// A corner of a piece to take means of: that of the triangle, moved into the piece's box.
inline Vec3 corner_inside(const Piece& piece, const Vec3& corner) {
    return glm::clamp(corner, piece.box.lower, piece.box.upper);
}

}  // namespace boxwood
