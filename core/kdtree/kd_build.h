#pragma once

#include <functional>
#include <optional>

#include "core/kdtree/kd_tree.h"
#include "core/refs/prim_ref.h"
#include "core/structure/ref_budget.h"

namespace boxwood {

/// Plane that divides a cell, strictly between two of its faces.
struct KdSplit {
    int axis = 0;
    float plane = 0.0f;
    bool planar_left = true;  ///< pieces that lie in the plane go to the left child, otherwise to the right
};

/// Children that get a piece.
enum class KdSide : uint8_t { Left = 1, Right = 2, Both = 3 };

/// A piece is the part of a primitive in a cell, given by its box. Both children get it only if it has points
/// strictly on both sides of the plane; one that ends at the plane stays on its side. So each point of the
/// piece lies in the closed cell of a child that gets it. Exact: a face of a piece's box is the float next to
/// the exact one outwards, so both lie on the same side of any float.
inline KdSide side_of(const Box& piece, const KdSplit& split) {
    const float lower = piece.lower[split.axis], upper = piece.upper[split.axis];
    if (lower < split.plane && split.plane < upper) return KdSide::Both;
    if (lower == split.plane && split.plane == upper) return split.planar_left ? KdSide::Left : KdSide::Right;
    return upper <= split.plane ? KdSide::Left : KdSide::Right;
}

/// How pieces are cut, and what bounds depth and memory.
struct KdLimits {
    bool clip = true;        ///< pieces are cut out of the triangle itself; otherwise out of its box
    uint32_t leaf_size = 1;  ///< so few references are not divided
    uint32_t max_depth = 0;  ///< levels below the root; 0: 8 + 1.3 log2 of the references
    uint32_t budget = 16;    ///< references of all leaves at most, for each one that the tree is built over

    /// The levels that a tree over so many references gets, at most KdTree::kMaxDepth.
    uint32_t depth_for(size_t ref_count) const;
};

/// The boxes of both parts of a piece that has points on both sides of the plane.
///
/// Clipping starts from the triangle, not from the piece as clipped before: the piece's box B lies in the
/// cell C and contains all of the triangle's part in C, so the triangle has the same part in B as in C. A
/// part is empty only if the box was that of a reference, and larger than the triangle's part in it.
struct KdParts {
    Box left, right;
};
KdParts cut_piece(const Mesh& mesh, const PrimRef& piece, const KdSplit& split, bool clip);

/// Nodes of a subtree under construction, in their final order.
class KdOutput {
public:
    /// A leaf of the pieces' primitives, each once.
    void add_leaf(std::span<const PrimRef> pieces);
    /// An inner node, whose right child is named later; returns its place.
    uint32_t add_inner(const KdSplit& split);
    /// The next node to be added, or subtree to be appended, is the right child of that inner node.
    void begin_right(uint32_t inner);
    void append(const KdOutput& subtree);
    KdTree finish(const Box& bounds);

private:
    std::vector<KdTree::Node> nodes_;
    std::vector<uint32_t> prims_;
};

/// Chooses the plane of a node from its pieces and its cell; nothing for a leaf. Called from many threads.
using KdChooser = std::function<std::optional<KdSplit>(std::span<const PrimRef> pieces, const Box& cell)>;

/// Ernst, Greiner 2007, algorithm 1 and, where `limits.clip`, algorithm 3, with planes by `choose`: top-down,
/// subtrees in parallel. Empty if the task was stopped.
KdTree build_kd_tree(const Mesh& mesh, std::span<const PrimRef> refs, const KdLimits& limits,
                     const KdChooser& choose, const Task& task);

/// Box of all references.
Box bounds_of_refs(std::span<const PrimRef> refs);

}  // namespace boxwood
