#pragma once

#include <array>
#include <vector>

#include "core/structure/structure.h"

namespace boxwood {

/// Octree; or quadtree, where cells are halved along two axes only. A cell is halved along each of its split
/// axes at once, and its children together fill it; leaves may be empty. Cells are closed, and a leaf has
/// every primitive that touches its cell. A ray visits leaves front to back and tests no primitive twice.
///
/// Cells have whole-number coordinates on a lattice of 2^kMaxDepth cells along each axis, and a wall's place
/// is a function of its number alone, so that neighbours of any size share its bits.
struct CellTree {
    static constexpr const char* kFamily = "octree";
    static constexpr uint32_t kMaxDepth = 20;  ///< levels below the root that a builder may make

    /// Children are adjacent, parents before children, the root first. Child number: one bit for each split
    /// axis, x lowest; 1 for the upper half.
    struct Node {
        uint32_t first;  ///< inner: the first child; leaf: its first entry of prims
        uint32_t count;  ///< inner: kInner + split axes, bit 0 for x; leaf: primitives, perhaps none

        static constexpr uint32_t kInner = 1u << 31;
        bool is_leaf() const { return (count & kInner) == 0; }
        uint32_t split_axes() const { return count & 7u; }
        bool operator==(const Node&) const = default;
    };
    static_assert(sizeof(Node) == 8);

    Box bounds;  ///< of all primitives
    std::vector<Node> nodes;
    std::vector<uint32_t> prims;  ///< of the leaves, ascending in each
    /// Split at the border: box of the part of each entry of prims inside its leaf's cell, which the ray must
    /// meet for the primitive to be tested there. Empty where primitives are referenced whole.
    std::vector<Box> pieces;

    /// Place of a wall: number / 2^kMaxDepth of the way from the lower to the upper face of bounds.
    float wall(size_t axis, uint32_t number) const;

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const {
        return nodes.size() * sizeof(Node) + prims.size() * sizeof(uint32_t) + pieces.size() * sizeof(Box);
    }
};

/// Where a cell is halved: number of its lower wall on each axis, and half the edge of all cells of its level
/// in lattice cells. A cell is longer along an axis where it was not halved at every level above: there no
/// float lay between the walls, or the tree does not split that axis.
struct LatticeCell {
    std::array<uint32_t, 3> lower{};
    uint32_t level = 0;

    static constexpr uint32_t half_edge(uint32_t level) { return 1u << (CellTree::kMaxDepth - 1 - level); }
    uint32_t middle(size_t axis) const { return lower[axis] + half_edge(level); }
    /// Child with the given bits, bit 0 for x.
    LatticeCell child(uint32_t octant) const {
        LatticeCell result{lower, level + 1};
        for (size_t axis = 0; axis < 3; ++axis)
            if ((octant >> axis & 1u) != 0) result.lower[axis] += half_edge(level);
        return result;
    }
};

/// The child's number among the children of a node that is split along `axes`.
inline uint32_t child_number(uint32_t octant, uint32_t axes) {
    const uint32_t x = axes & 1u, y = axes >> 1 & 1u;
    return (octant & 1u) | (octant >> 1 & 1u) << x | (octant >> 2 & 1u) << (x + y);
}

/// The half of a box on one side of a plane: side 1 is the upper one.
inline void cut_half(Box& box, int axis, float plane, uint32_t side) {
    (side == 0 ? box.upper : box.lower)[axis] = plane;
}

}  // namespace boxwood
