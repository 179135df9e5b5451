#include "core/refs/early_split_clipping.h"

#include <array>

#include "core/base/assert.h"
#include "core/refs/clip_polygon.h"

namespace boxwood {

namespace {

// Bounds the stack. Each split halves the longest extent: an area is down to S / 2^s after about s splits,
// and after one more for each halving that makes a needle's box a cube. What would be deeper stays whole.
constexpr int kMaxDepth = 256;

struct Piece {
    Box box;
    int depth;
};

/// Algorithm 4. The stack holds boxes of pieces: the smallest ones around the triangle's part in a cell. The
/// part of a piece beyond a plane is the original triangle inside the piece's box, cut by the plane.
void cut(const Triangle& triangle, double max_area, const EmitBox& emit) {
    std::array<Piece, kMaxDepth + 1> stack;
    size_t size = 0;
    stack[size++] = {triangle.bounds(), 0};
    while (size > 0) {
        const Piece piece = stack[--size];
        const int axis = piece.box.largest_axis();
        const float lower = piece.box.lower[axis], upper = piece.box.upper[axis];
        const float middle = 0.5f * lower + 0.5f * upper;
        const bool is_split = piece.box.surface_area() > max_area && lower < middle && middle < upper &&
                              piece.depth < kMaxDepth;
        if (!is_split) {
            if (!emit(piece.box)) return;
            continue;
        }
        const auto [left, right] = clip_halves(triangle, piece.box, axis, middle);
        BOXWOOD_ASSERT(size + 2 <= stack.size());
        if (!right.is_empty()) stack[size++] = {right, piece.depth + 1};
        if (!left.is_empty()) stack[size++] = {left, piece.depth + 1};
    }
}

}  // namespace

References EarlySplitClipping::make(const Mesh& mesh, Task& task) const {
    const double scene_area = mesh.bounds().surface_area();
    const SubdivisionRule rule = {
        .limit = limit.max_area(scene_area),
        .largest = scene_area,
        .growth = 1.0,  // four pieces of a surface have a quarter of the area each
        .measure = [](const Triangle& triangle) { return triangle.bounds().surface_area(); },
        .cut = cut};
    return subdivide(mesh, rule, budget, task);
}

}  // namespace boxwood
