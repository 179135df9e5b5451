#pragma once

#include <array>

#include "core/bvh/bvh2.h"
#include "core/wide_bvh/prim_counts.h"
#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// A subtree of a binary BVH that becomes a child of a wide node.
struct WidePart {
    uint32_t node;  ///< its root
    bool is_leaf;   ///< all its primitives in one leaf
};

/// The children of one wide node.
template <uint32_t Width>
struct WideParts {
    std::array<WidePart, Width> parts;
    uint32_t count = 0;

    void add(WidePart part) { parts[count++] = part; }
};

/// How a binary BVH is to be cut up, from its root.
template <uint32_t Width>
class WidePlan {
public:
    virtual ~WidePlan() = default;
    /// The children of the wide node that stands for `node`, an inner one or, as the root, a leaf.
    virtual WideParts<Width> children_of(uint32_t node) const = 0;
};

/// Puts a wide hierarchy together, in parallel. `counts` of the binary one; leaves of the plan that are no
/// leaves of it hold few. An empty one after a stop.
template <uint32_t Width>
WideBvh<Width> make_wide(const Mesh& mesh, const Bvh2& bvh, const PrimCounts& counts,
                         const WidePlan<Width>& plan, const Task& task);

}  // namespace boxwood
