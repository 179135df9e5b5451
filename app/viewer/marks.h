#pragma once

#include <span>
#include <vector>

#include "app/viewer/box_values.h"
#include "app/viewer/state.h"
#include "app/viewer/visits.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// What hiding and isolating nodes leaves to be seen. Empty vectors: all of it.
struct Visibility {
    std::vector<uint8_t> nodes;      ///< 1: visible
    std::vector<uint8_t> triangles;  ///< 1: in a visible leaf

    bool is_whole() const { return nodes.empty(); }
    bool shows(uint32_t node) const { return nodes.empty() || nodes[node] != 0; }
};

/// Of the state's hidden and isolated nodes; those that the list does not have are passed over.
Visibility visible_parts(const SideState& state, const NodeList& list, size_t triangle_count);

/// A BoxMark for each node; none where all are 0. `visits`: null, or of the same nodes.
std::vector<uint32_t> box_marks(const Visibility& visibility, const Visits* visits);

/// TriangleMark bits for each triangle.
std::vector<uint8_t> triangle_marks(std::span<const PrimRef> refs, const BoxValues& values,
                                    const Visibility& visibility, size_t triangle_count);

}  // namespace boxwood
