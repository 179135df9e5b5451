#pragma once

#include <bit>
#include <vector>

#include "core/base/assert.h"
#include "core/bsp/bsp_plane.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Binary space partition: an inner node's plane, of any direction, divides its convex cell into those of its
/// children. Cells are closed, so that children share the plane; empty cells are leaves without primitives.
/// Depth first, the left child right after its parent; an empty mesh has no node. Triangles are kept whole,
/// by reference in each leaf whose cell they reach; one that only touches a cell's wall may be on one side
/// alone, since rays visit every leaf whose closed cell they meet. Fuchs, Kedem, Naylor, "On Visible Surface
/// Generation by A Priori Tree Structures", SIGGRAPH 1980; lecture (Kerbl), "Binary Space Partition Tree".
struct BspTree {
    static constexpr const char* kFamily = "BSP";
    static constexpr uint32_t kMaxDepth = 64;              ///< levels below the root that a builder may make
    static constexpr uint32_t kMaxCount = (1u << 29) - 1;  ///< nodes, and primitives of one leaf

    class Node {
    public:
        static Node leaf(uint32_t first, uint32_t count) { return {first, count << 3 | kLeaf}; }
        static Node inner(int axis, float position, uint32_t right) {
            return {std::bit_cast<uint32_t>(position), right << 3 | static_cast<uint32_t>(axis)};
        }
        static Node inner(uint32_t plane, uint32_t right) { return {plane, right << 3 | kPlane}; }

        bool is_leaf() const { return (link_ & 7) == kLeaf; }
        uint32_t first() const { return value_; }      ///< leaf: its first entry of prims
        uint32_t count() const { return link_ >> 3; }  ///< leaf: its primitives, perhaps none
        bool is_axis_plane() const { return (link_ & 7) < 3; }
        int axis() const { return static_cast<int>(link_ & 7); }
        float position() const { return std::bit_cast<float>(value_); }
        uint32_t plane() const { return value_; }      ///< inner: entry of planes, where no axis plane
        uint32_t right() const { return link_ >> 3; }  ///< inner: index of the right child
        bool operator==(const Node&) const = default;

    private:
        static constexpr uint32_t kPlane = 3, kLeaf = 4;
        Node(uint32_t value, uint32_t link) : value_(value), link_(link) {}
        uint32_t value_, link_;
    };
    static_assert(sizeof(Node) == 8);

    Box bounds;  ///< the root's cell
    std::vector<Node> nodes;
    std::vector<Triangle> planes;  ///< each through three points
    std::vector<uint32_t> prims;   ///< of the leaves; no leaf holds one twice

    BspPlane plane_of(const Node& node) const {
        return node.is_axis_plane() ? BspPlane::across(node.axis(), node.position())
                                    : BspPlane::through(planes[node.plane()]);
    }

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    /// With the edges of all cells as outlines; boxes of nodes contain their cells.
    NodeList list_nodes() const;
    size_t byte_count() const {
        return nodes.size() * sizeof(Node) + planes.size() * sizeof(Triangle) +
               prims.size() * sizeof(uint32_t);
    }
};

}  // namespace boxwood
