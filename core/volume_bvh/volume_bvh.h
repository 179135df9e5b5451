#pragma once

#include <vector>

#include "core/structure/structure.h"

namespace boxwood {

/// How far roundings are off in the tests of volumes; a template argument, so that a test can show that half
/// of it is wrong. u = 2^-53 and room for what is of second order.
struct VolumeBounds {
    static constexpr double kUnit = 0x1p-53 * (1.0 + 0x1p-40);
    static constexpr double kQuotientPad = 5.0 * kUnit;          ///< see OrientedBox::Test
    static constexpr double kDistancePad = 1.0 + 6.0 * 0x1p-53;  ///< see length_above
};

/// Binary bounding volume hierarchy over volumes that are no axis-aligned boxes: `Volume` is Sphere or
/// OrientedBox. Each node's volume contains what the leaves below it hold of their primitives; it may stick
/// out of its parent's. Layout and traversal as in Bvh2.
template <class Volume>
struct VolumeBvh {
    static constexpr const char* kFamily = Volume::kFamily;

    struct Node {
        Volume volume;
        uint32_t first;  ///< inner: the left child, the right one follows; leaf: its first entry of prims
        uint32_t count;  ///< inner: 0; leaf: primitives, at least 1

        bool is_leaf() const { return count != 0; }
    };
    static_assert(sizeof(Node) == sizeof(Volume) + 8);

    std::vector<Node> nodes;
    Array<uint32_t> prims;  ///< of the leaves; no leaf holds one twice
    Box bounds;             ///< of all that the leaves hold

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    NodeList list_nodes() const;
    size_t byte_count() const {
        return sizeof bounds + nodes.size() * sizeof(Node) + prims.size() * sizeof(uint32_t);
    }
};

}  // namespace boxwood
