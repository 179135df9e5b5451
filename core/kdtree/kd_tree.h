#pragma once

#include <bit>
#include <vector>

#include "core/base/assert.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Tree of cells: an inner node's plane, perpendicular to an axis, divides its cell into those of its
/// children. Cells are closed, so that children share the plane; empty cells are leaves without primitives.
/// Depth first, the left child (the cell below the plane) right after its parent; an empty mesh has no node.
///
/// A primitive is in every leaf whose cell's inside it meets. Where it only touches a cell's wall it may be
/// on one side alone: each point of it that lies in a cell lies in the cell of some child that holds it, and
/// hence of some leaf that does. That is enough: rays visit every leaf whose closed cell they meet.
/// Bentley, "Multidimensional Binary Search Trees Used for Associative Searching", CACM 1975; for rays:
/// Kaplan 1985, MacDonald and Booth 1990; lecture (Kerbl), "k-d tree".
struct KdTree {
    static constexpr const char* kFamily = "kd-tree";
    static constexpr uint32_t kMaxDepth = 64;              ///< levels below the root that a builder may make
    static constexpr uint32_t kMaxCount = (1u << 30) - 1;  ///< nodes, and primitives of one leaf

    class Node {
    public:
        static Node leaf(uint32_t first, uint32_t count) { return {first, count << 2 | kLeaf}; }
        static Node inner(int axis, float plane, uint32_t right) {
            return {std::bit_cast<uint32_t>(plane), right << 2 | static_cast<uint32_t>(axis)};
        }
        bool is_leaf() const { return (link_ & 3) == kLeaf; }
        uint32_t first() const { return value_; }      ///< leaf: its first entry of prims
        uint32_t count() const { return link_ >> 2; }  ///< leaf: its primitives, perhaps none
        int axis() const { return static_cast<int>(link_ & 3); }
        float plane() const { return std::bit_cast<float>(value_); }
        uint32_t right() const { return link_ >> 2; }  ///< inner: index of the child above the plane
        bool operator==(const Node&) const = default;

    private:
        static constexpr uint32_t kLeaf = 3;
        Node(uint32_t value, uint32_t link) : value_(value), link_(link) {}
        uint32_t value_, link_;
    };
    static_assert(sizeof(Node) == 8);

    Box bounds;  ///< the root's cell
    std::vector<Node> nodes;
    std::vector<uint32_t> prims;  ///< of the leaves; no leaf holds one twice

    /// The cells of the children of an inner node with that cell.
    static Box left_cell(const Node& node, Box cell) {
        cell.upper[node.axis()] = node.plane();
        return cell;
    }
    static Box right_cell(const Node& node, Box cell) {
        cell.lower[node.axis()] = node.plane();
        return cell;
    }

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const { return nodes.size() * sizeof(Node) + prims.size() * sizeof(uint32_t); }
};

}  // namespace boxwood
