#pragma once

#include "core/base/array.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Binary bounding volume hierarchy over axis-aligned boxes. Children are adjacent, parents before children,
/// the root first; an empty mesh has no node. Traversed front to back, pruned by the nearest hit.
struct Bvh2 {
    static constexpr const char* kFamily = "binary BVH";
    static constexpr uint32_t kMaxDepth = 64;  ///< levels below the root that a builder may make

    struct Node {
        Vec3 lower;
        uint32_t first;  ///< inner: the left child, the right one follows; leaf: its first entry of prims
        Vec3 upper;
        uint32_t count;  ///< inner: 0; leaf: primitives, at least 1

        bool is_leaf() const { return count != 0; }
        double half_area() const { return Box{lower, upper}.half_area(); }
        bool operator==(const Node&) const = default;
    };
    static_assert(sizeof(Node) == 32);

    Array<Node> nodes;
    Array<uint32_t> prims;  ///< of the leaves; no leaf holds one twice

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const { return nodes.size() * sizeof(Node) + prims.size() * sizeof(uint32_t); }
};

/// Views of nodes in the layout of Bvh2, all of whose boxes and leaves are what they say.
NodeList list_bvh_nodes(std::span<const Bvh2::Node> nodes, std::span<const uint32_t> prims);

}  // namespace boxwood
