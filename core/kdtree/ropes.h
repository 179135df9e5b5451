#pragma once

#include <array>

#include "core/kdtree/kd_tree.h"
#include "core/structure/method.h"

namespace boxwood {

/// kd-tree whose leaves know their neighbours, so that rays go from leaf to leaf without a stack. Popov,
/// Guenther, Seidel, Slusallek, "Stackless KD-Tree Traversal for High Performance GPU Ray Tracing",
/// Eurographics 2007, section 3; lecture (Kerbl), "What else?", [5]. Differs: where a ray leaves a cell
/// through an edge or a corner, or along a wall, so closely that rounding hides through which face, the next
/// leaf is found by climbing to the parents; see ropes.cpp. So nodes have their cells and parents as well.
struct RopedKdTree {
    static constexpr const char* kFamily = "kd-tree with ropes";

    /// Neighbours of a leaf beyond the faces of its cell: the lowest node of the tree whose cell contains the
    /// face; kNoIndex at the root's faces. faces[axis] beyond the lower one, faces[3 + axis] the upper one.
    struct Ropes {
        std::array<uint32_t, 6> faces;
    };

    KdTree tree;
    std::vector<Box> cells;         ///< of the nodes
    std::vector<uint32_t> parents;  ///< of the nodes; kNoIndex for the root
    std::vector<uint32_t> leaves;   ///< node -> entry of ropes; kNoIndex for an inner node
    std::vector<Ropes> ropes;       ///< of the leaves

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const { return tree.list_nodes(); }
    size_t byte_count() const {
        return tree.byte_count() + cells.size() * sizeof(Box) + ropes.size() * sizeof(Ropes) +
               (parents.size() + leaves.size()) * sizeof(uint32_t);
    }
};

/// Adds ropes to a kd-tree.
struct AddRopes {
    using Input = KdTree;
    using Output = RopedKdTree;

    void describe(ParamVisitor&) {}
    RopedKdTree apply(const Mesh& mesh, std::span<const PrimRef> refs, const KdTree& input, Task& task) const;
};

}  // namespace boxwood
