#include "core/wide_bvh/prim_counts.h"

#include <algorithm>
#include <array>

#include "core/base/assert.h"
#include "core/base/parallel.h"

namespace boxwood {

namespace {

constexpr uint32_t kParallelCountDepth = 9;  ///< nodes above it are counted in parallel

/// Makes two ascending lists, [begin, middle) and the rest, one in which each number stands once.
void unite(std::vector<uint32_t>& prims, size_t begin, size_t middle) {
    std::array<uint32_t, size_t{2} * PrimCounts::kMost> both;
    const auto left = prims.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto right = prims.begin() + static_cast<std::ptrdiff_t>(middle);
    const auto end = std::set_union(left, right, right, prims.end(), both.begin());
    const auto count = static_cast<size_t>(end - both.begin());
    std::copy(both.begin(), end, left);
    prims.resize(begin + count);
}

}  // namespace

PrimCounts::PrimCounts(const Mesh& mesh, const Bvh2& bvh, uint32_t most, const Task& task)
    : bvh_(bvh),
      task_(task),
      most_(most),
      may_repeat_(bvh.prims.size() != mesh.triangle_count()),
      counts_(bvh.nodes.size(), kMany) {
    BOXWOOD_ASSERT(most <= kMost);
    std::vector<uint32_t> prims;
    if (!bvh.nodes.empty()) count_below(0, 0, prims);
}

/// Appends the primitives in ascending order where they are few, and nothing where they are not or where none
/// repeats.
void PrimCounts::count_below(uint32_t node, uint32_t depth, std::vector<uint32_t>& prims) {
    const Bvh2::Node& source = bvh_.nodes[node];
    if (source.is_leaf()) {
        if (source.count > most_) return;
        counts_[node] = static_cast<uint8_t>(source.count);
        if (may_repeat_) add_leaf(source, prims);
        return;
    }
    if (task_.stopped()) return;
    const uint32_t left = source.first, right = left + 1;
    const size_t begin = prims.size();
    size_t middle;
    if (depth < kParallelCountDepth) {
        std::vector<uint32_t> right_prims;
        parallel_invoke([&] { count_below(left, depth + 1, prims); },
                        [&] { count_below(right, depth + 1, right_prims); });
        middle = prims.size();
        prims.insert(prims.end(), right_prims.begin(), right_prims.end());
    } else {
        count_below(left, depth + 1, prims);
        middle = prims.size();
        count_below(right, depth + 1, prims);
    }
    uint32_t count = most_ + 1;
    if (are_few(left) && are_few(right)) {
        if (may_repeat_) unite(prims, begin, middle);
        count = may_repeat_ ? static_cast<uint32_t>(prims.size() - begin) : of(left) + of(right);
    }
    if (count <= most_) {
        counts_[node] = static_cast<uint8_t>(count);
    } else {
        prims.resize(begin);
    }
}

void PrimCounts::add_leaf(const Bvh2::Node& leaf, std::vector<uint32_t>& prims) {
    const auto begin = static_cast<std::ptrdiff_t>(prims.size());
    prims.insert(prims.end(), bvh_.prims.begin() + leaf.first, bvh_.prims.begin() + leaf.first + leaf.count);
    std::sort(prims.begin() + begin, prims.end());
}

}  // namespace boxwood
