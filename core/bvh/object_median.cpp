#include "core/bvh/object_median.h"

#include <tuple>

#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

/// Twice the centre on an axis, exact or rounded once: monotonic in the centre.
double center_of(const PrimRef& ref, int axis) {
    return static_cast<double>(ref.bounds.lower[axis]) + static_cast<double>(ref.bounds.upper[axis]);
}

/// A strict order in which only references that are the same are equal.
bool comes_first(const PrimRef& a, const PrimRef& b, int axis) {
    const double center_a = center_of(a, axis), center_b = center_of(b, axis);
    if (center_a != center_b) return center_a < center_b;
    if (a.prim != b.prim) return a.prim < b.prim;
    const auto corners = [](const Box& box) {
        return std::tie(box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z);
    };
    return corners(a.bounds) < corners(b.bounds);
}

}  // namespace

Bvh2 ObjectMedian::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    const auto partition = [&](std::span<PrimRef> node_refs, const NodeBounds&,
                               uint32_t depth) -> std::optional<uint32_t> {
        const auto count = static_cast<uint32_t>(node_refs.size());
        if (count <= static_cast<uint32_t>(max_leaf_size)) return std::nullopt;
        const int axis = static_cast<int>(depth % 3);
        std::nth_element(node_refs.begin(), node_refs.begin() + count / 2, node_refs.end(),
                         [axis](const PrimRef& a, const PrimRef& b) { return comes_first(a, b, axis); });
        return count / 2;
    };
    return build_top_down(refs, partition, task);
}

}  // namespace boxwood
