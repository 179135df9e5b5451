#include "core/bsp/bsp_output.h"

#include <algorithm>
#include <utility>

namespace boxwood {

namespace {

using Node = BspTree::Node;

/// The inner node with other places for its plane and its right child.
Node moved(const Node& node, uint32_t plane, uint32_t right) {
    return node.is_axis_plane() ? Node::inner(node.axis(), node.position(), right)
                                : Node::inner(plane, right);
}

}  // namespace

void BspOutput::add_leaf(std::span<const BspPiece> pieces) {
    const size_t first = tree_.prims.size();
    for (const BspPiece& piece : pieces) tree_.prims.push_back(piece.prim);
    BOXWOOD_ASSERT(tree_.prims.size() < kNoIndex && pieces.size() <= BspTree::kMaxCount);
    tree_.nodes.push_back(Node::leaf(static_cast<uint32_t>(first), static_cast<uint32_t>(pieces.size())));
}

uint32_t BspOutput::add_inner(const BspPlane& plane) {
    if (plane.axis >= 0) {
        tree_.nodes.push_back(Node::inner(plane.axis, plane.position, 0));
    } else {
        tree_.nodes.push_back(Node::inner(static_cast<uint32_t>(tree_.planes.size()), 0));
        tree_.planes.push_back(plane.points);
    }
    return static_cast<uint32_t>(tree_.nodes.size() - 1);
}

void BspOutput::begin_right(uint32_t inner) {
    BOXWOOD_ASSERT(tree_.nodes.size() <= BspTree::kMaxCount);
    Node& node = tree_.nodes[inner];
    node = moved(node, node.plane(), static_cast<uint32_t>(tree_.nodes.size()));
}

void BspOutput::append(const BspOutput& subtree) {
    const auto node_offset = static_cast<uint32_t>(tree_.nodes.size());
    const auto plane_offset = static_cast<uint32_t>(tree_.planes.size());
    const auto prim_offset = static_cast<uint32_t>(tree_.prims.size());
    for (const Node& node : subtree.tree_.nodes)
        tree_.nodes.push_back(node.is_leaf()
                                  ? Node::leaf(node.first() + prim_offset, node.count())
                                  : moved(node, node.plane() + plane_offset, node.right() + node_offset));
    const BspTree& other = subtree.tree_;
    tree_.planes.insert(tree_.planes.end(), other.planes.begin(), other.planes.end());
    tree_.prims.insert(tree_.prims.end(), other.prims.begin(), other.prims.end());
}

BspTree BspOutput::finish(const Box& bounds) {
    tree_.bounds = bounds;
    tree_.nodes.shrink_to_fit();
    tree_.planes.shrink_to_fit();
    tree_.prims.shrink_to_fit();
    return std::move(tree_);
}

}  // namespace boxwood
