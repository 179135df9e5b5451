#pragma once

#include <span>

#include "core/bsp/bsp_piece.h"
#include "core/bsp/bsp_tree.h"

namespace boxwood {

/// Nodes of a subtree under construction, in their final order.
class BspOutput {
public:
    /// A leaf of the pieces' primitives.
    void add_leaf(std::span<const BspPiece> pieces);
    /// An inner node, whose right child is named later; returns its place.
    uint32_t add_inner(const BspPlane& plane);
    /// The next node to be added, or subtree to be appended, is the right child of that inner node.
    void begin_right(uint32_t inner);
    void append(const BspOutput& subtree);
    BspTree finish(const Box& bounds);

private:
    BspTree tree_;
};

}  // namespace boxwood
