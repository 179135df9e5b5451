#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/assert.h"

namespace boxwood {

/// References that the leaves below a node may hold in all, where a builder makes more of them. It is shared
/// out among the children by their references, so that the tree does not depend on the order in which nodes
/// are built.
struct RefBudget {
    uint64_t refs = 0;

    bool allows(size_t left_count, size_t right_count) const { return left_count + right_count <= refs; }
    /// What the left child gets of it; the right one gets the rest. Requires allows(left_count, right_count),
    /// and counts below 2^31, with which no product overflows.
    RefBudget left_share(size_t left_count, size_t right_count) const {
        BOXWOOD_ASSERT(allows(left_count, right_count));
        const uint64_t sum = left_count + right_count;
        if (sum == 0) return {refs / 2};
        return {left_count + (refs - sum) / sum * left_count + (refs - sum) % sum * left_count / sum};
    }
};

/// Levels below the root for a tree of cells over so many references: 8 + 1.3 log2 of them, at most 64.
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd edition 2016, section 4.4.1.
uint32_t default_depth(size_t ref_count);

}  // namespace boxwood
