#pragma once

#include <deque>
#include <mutex>

#include "core/base/array.h"
#include "core/wide_bvh/part_tree.h"

namespace boxwood {

/// What a part of the mesh becomes in a sixteen-wide hierarchy: a subtree, or, where there is no node, a
/// leaf. Nodes, leaves and packs are numbered from 0.
struct WidePiece {
    std::span<const WideBvh<16>::Node> nodes;  ///< of PieceNodes
    uint32_t leaf_count = 0, pack_count = 0;
    Box4 box{};
    double cost = 0.0;  ///< see PartTree

    bool is_leaf() const { return nodes.empty(); }
};

/// Memory for the nodes of all pieces, in few large arrays: what is allocated and freed in small ones is not
/// kept from one build to the next, and the system clears it each time.
class PieceNodes {
public:
    /// Of all pieces there will be so many at most.
    explicit PieceNodes(size_t most) : most_(most) {}
    /// Unused ones for the next pieces of a thread, `least` or more. Thread-safe.
    std::span<WideBvh<16>::Node> take(size_t least);

private:
    const size_t most_;
    std::mutex mutex_;
    std::deque<Array<WideBvh<16>::Node>> arrays_;
};

/// Makes pieces out of trees, for one thread.
class PieceWriter {
public:
    explicit PieceWriter(PieceNodes& memory) : memory_(memory) {}
    /// Of a tree with `pack_count` leaves.
    WidePiece write(const PartTree& tree, const PartRoot& root, uint32_t pack_count);

private:
    uint32_t add_node(const PartTree& tree, uint32_t root, WidePiece& piece);

    PieceNodes& memory_;
    std::span<WideBvh<16>::Node> room_;  ///< for the next piece
    uint32_t node_count_ = 0;            ///< that this piece has of it
};

/// A hierarchy whose top is a tree with pieces as its parts, each of which occurs once.
struct JoinedPieces {
    WideBvh<16> bvh;                    ///< without packs
    std::vector<uint32_t> first_packs;  ///< where the packs of each piece begin: in the order of the tree
    uint32_t pack_count = 0;            ///< of all pieces
};

/// In parallel.
JoinedPieces join_pieces(const PartTree& top, std::span<const WidePiece> pieces);

}  // namespace boxwood
