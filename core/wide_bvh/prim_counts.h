#pragma once

#include <limits>
#include <vector>

#include "core/base/task.h"
#include "core/bvh/bvh2.h"

namespace boxwood {

/// How many primitives are below each node of a binary BVH, each counted once, where they are few.
class PrimCounts {
public:
    static constexpr uint32_t kMost = 254;  ///< `most` is at most that

    /// Numbers up to `most` are told. In time O(most) for each node, in parallel; right only if the task is
    /// not stopped.
    PrimCounts(const Mesh& mesh, const Bvh2& bvh, uint32_t most, const Task& task);

    /// Whether at most `most` primitives are below the node.
    bool are_few(uint32_t node) const { return counts_[node] != kMany; }
    /// Only where they are few.
    uint32_t of(uint32_t node) const { return counts_[node]; }

private:
    static constexpr uint8_t kMany = std::numeric_limits<uint8_t>::max();

    void count_below(uint32_t node, uint32_t depth, std::vector<uint32_t>& prims);
    void add_leaf(const Bvh2::Node& leaf, std::vector<uint32_t>& prims);

    const Bvh2& bvh_;
    const Task& task_;
    uint32_t most_;
    bool may_repeat_;  ///< two leaves hold the same primitive: every one occurs, and there are more places
    std::vector<uint8_t> counts_;
};

}  // namespace boxwood
