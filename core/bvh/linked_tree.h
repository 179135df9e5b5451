#pragma once

#include <optional>

#include "core/bvh/box4.h"
#include "core/bvh/bvh2.h"

namespace boxwood {

/// A binary tree whose subtrees can be moved. Nodes keep their indices: those of the Bvh2 that it was made
/// from.
class LinkedTree {
public:
    /// The best place found for a node: it becomes the sibling of `to`.
    struct Move {
        double gain;  ///< by how much the sum of half areas of inner nodes falls
        uint32_t node, to;
    };

    explicit LinkedTree(const Bvh2& bvh);
    /// Where the node is best put, in the tree as it is; nothing where it is best left. Not for the root and
    /// its children.
    std::optional<Move> best_move(uint32_t node) const;
    /// By how much the sum of half areas of inner nodes would fall; nothing if the move is none, or would
    /// leave a leaf too deep.
    std::optional<double> gain(uint32_t node, uint32_t to) const;
    /// Requires gain(node, to).
    void move(uint32_t node, uint32_t to);
    /// How promising it is to move the node: what taking it out may save at most right above it, its parent's
    /// area less its own, and more so the smaller it is in comparison. 0 or more.
    double inefficiency(uint32_t node) const;
    bool is_movable(uint32_t node) const { return node != 0 && links_[node].parent != 0; }
    /// Nodes in depth-first order; leaves of `source`, which the tree was made from.
    Bvh2 bvh(const Bvh2& source) const;

private:
    struct Node {
        Vec3 lower;
        uint32_t left;  ///< kNoIndex: a leaf
        Vec3 upper;
        uint32_t right;
    };
    static_assert(sizeof(Node) == 32);
    struct Links {
        uint32_t parent;
        uint32_t height;  ///< levels below the node
    };

    Box4 box(uint32_t node) const;
    double half_area(uint32_t node) const;
    uint32_t sibling(uint32_t node) const {
        const Node& parent = nodes_[links_[node].parent];
        return parent.left == node ? parent.right : parent.left;
    }
    bool is_leaf(uint32_t node) const { return nodes_[node].left == kNoIndex; }
    void replace_child(uint32_t parent, uint32_t from, uint32_t to);
    void refit_upwards(uint32_t node);

    Array<Node> nodes_;
    Array<Links> links_;
};

}  // namespace boxwood
