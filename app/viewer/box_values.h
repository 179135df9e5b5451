#pragma once

#include <vector>

#include "core/structure/node_list.h"

namespace boxwood {

/// Smallest and largest value of what a colour stands for; both 0 where there is nothing.
struct ValueRange {
    float lower = 0.0f;
    float upper = 0.0f;

    bool operator==(const ValueRange&) const = default;
};

/// What the colour of a node's box can say beside its level; one entry for each node of the list where not
/// said otherwise. Made once
/// for a structure.
struct BoxValues {
    std::vector<float> references;  ///< references in the leaves below; of a leaf its own
    std::vector<float> sah_share;   ///< the node's own term of the SAH cost over the sum of all, in [0, 1]
    /// For each primitive, up to the largest that occurs, the leaves that hold it.
    std::vector<uint32_t> prim_leaves;
    ValueRange references_range;  ///< of the nodes that hold any reference
    ValueRange sah_share_range;   ///< of the nodes with a share above 0

    size_t byte_count() const {
        return (references.size() + sah_share.size()) * sizeof(float) + prim_leaves.size() * sizeof(uint32_t);
    }
};

/// A node's term of the SAH cost: the probability that a ray meets it, times one visit (inner node) or its
/// tests (leaf); see core/structure/sah.h.
BoxValues make_box_values(const NodeList& list);

}  // namespace boxwood
