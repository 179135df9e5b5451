#pragma once

#include "core/base/task.h"
#include "core/wide_bvh/part_tree.h"

namespace boxwood {

/// What a part of the mesh becomes in an eight-wide hierarchy: a subtree, or, where there is no node, a leaf.
/// Nodes, leaves and packs are numbered from 0.
struct WidePiece {
    Array<WideBvh<8>::Node> nodes;
    uint32_t leaf_count = 0, pack_count = 0;
    Box4 box{};
    double cost = 0.0;  ///< see PartTree

    bool is_leaf() const { return nodes.empty(); }
};

/// The piece that a tree with `pack_count` leaves becomes.
WidePiece make_piece(const PartTree& tree, const PartRoot& root, uint32_t pack_count);

/// A hierarchy whose top is a tree with pieces as its parts, each of which occurs once.
struct JoinedPieces {
    WideBvh<8> bvh;                     ///< without packs
    std::vector<uint32_t> first_packs;  ///< where the packs of each piece begin: in the order of the tree
    uint32_t pack_count = 0;            ///< of all pieces
};

/// In parallel.
JoinedPieces join_pieces(const PartTree& top, std::span<const WidePiece> pieces);

}  // namespace boxwood
