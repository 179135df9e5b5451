#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <optional>

#include "core/base/parallel.h"
#include "core/bvh/bvh2.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// References [begin, end) of a node under construction.
struct RefRange {
    uint32_t begin, end;

    uint32_t count() const { return end - begin; }
};

/// Box of the references of a node, and box of half their centres.
struct NodeBounds {
    Box box;
    Box half_centers;
};
NodeBounds bounds_of(std::span<const PrimRef> refs);

/// Half the centre of a box: what top-down builders sort and bin by. Half, so that neither it nor the
/// difference of two overflows for any finite box.
inline Vec3 half_center(const Box& box) { return 0.25f * box.lower + 0.25f * box.upper; }

/// Nodes of a tree under construction. The children of a node that is split at `mid` (a position in the
/// references) stand at 2 mid - 1 and 2 mid: every mid occurs at most once, so threads need no common
/// counter, and the result does not depend on their number.
struct NodeScratch {
    std::unique_ptr<Bvh2::Node[]> nodes;  ///< not initialised: touched first by the thread that builds them

    explicit NodeScratch(size_t ref_count)
        : nodes(std::make_unique_for_overwrite<Bvh2::Node[]>(2 * ref_count + 1)) {}
    void set_leaf(uint32_t node, const Box& bounds, RefRange range) {
        nodes[node] = {bounds.lower, range.begin, bounds.upper, range.count()};
    }
    /// Returns the left child.
    uint32_t set_inner(uint32_t node, uint32_t mid) {
        nodes[node].first = 2 * mid - 1;
        nodes[node].count = 0;
        return nodes[node].first;
    }
};

/// The finished tree: nodes in depth-first order without gaps, duplicates of one primitive removed in every
/// leaf (Dammertz, Keller 2008, section 2.3). `prims` is the primitive of each reference in build order.
Bvh2 finish(const NodeScratch& scratch, std::span<const uint32_t> prims);

/// Moves the references with is_left to the front and returns how many they are. Lomuto's scheme without a
/// branch that depends on the outcome, which no processor could predict.
template <class IsLeft>
uint32_t partition_refs(std::span<PrimRef> refs, const IsLeft& is_left) {
    uint32_t left = 0;
    for (PrimRef& ref : refs) {
        const PrimRef current = ref;
        ref = refs[left];
        refs[left] = current;
        left += is_left(current) ? 1 : 0;
    }
    return left;
}

/// Whether a node at `depth` with `count` references must be split in the middle by count, so that the tree
/// stays within kMaxDepth for every input: halving needs at most ceil(log2 count) further levels.
inline bool must_halve(uint32_t depth, uint32_t count) {
    return depth + static_cast<uint32_t>(std::bit_width(count)) >= Bvh2::kMaxDepth;
}

/// Ernst, Greiner 2007, Algorithm 2: the recursion of every top-down build, in parallel.
/// `bounds_of(range)` gives the Box or the NodeBounds of a node's references;
/// `partition(range, bounds, depth)` reorders them and returns how many go left, or nothing where a leaf is
/// cheaper. Both are called from many threads, for ranges that do not overlap.
template <class BoundsOf, class Partition>
class TopDownRecursion {
public:
    TopDownRecursion(NodeScratch& scratch, const BoundsOf& bounds_of, const Partition& partition,
                     const Task& task)
        : scratch_(scratch), bounds_of_(bounds_of), partition_(partition), task_(task) {}

    void build_node(uint32_t node, RefRange range, uint32_t depth) {
        const auto bounds = bounds_of_(range);
        scratch_.set_leaf(node, box_of(bounds), range);
        if (range.count() == 1 || depth == Bvh2::kMaxDepth || task_.stopped()) return;
        const std::optional<uint32_t> left_count = partition_(range, bounds, depth);
        if (!left_count) return;  // a leaf is cheaper
        const uint32_t mid = range.begin + *left_count;
        const uint32_t left = scratch_.set_inner(node, mid);
        const auto build_left = [&] { build_node(left, {range.begin, mid}, depth + 1); };
        const auto build_right = [&] { build_node(left + 1, {mid, range.end}, depth + 1); };
        if (range.count() > kSerialCount) {
            parallel_invoke(build_left, build_right);
        } else {
            build_left();
            build_right();
        }
    }

private:
    static constexpr uint32_t kSerialCount = 2048;  ///< smaller nodes are built by one thread

    static const Box& box_of(const Box& box) { return box; }
    static const Box& box_of(const NodeBounds& bounds) { return bounds.box; }

    NodeScratch& scratch_;
    const BoundsOf& bounds_of_;
    const Partition& partition_;
    const Task& task_;
};

/// A top-down build over a copy of the references. `partition(refs, bounds, depth)` gets a node's references
/// and its NodeBounds; see TopDownRecursion.
template <class Partition>
Bvh2 build_top_down(std::span<const PrimRef> input, const Partition& partition, const Task& task) {
    if (input.empty()) return {};
    std::vector<PrimRef> refs(input.begin(), input.end());
    const auto refs_of = [&](RefRange range) { return std::span(refs).subspan(range.begin, range.count()); };
    const auto bounds_of_range = [&](RefRange range) { return bounds_of(refs_of(range)); };
    const auto partition_range = [&](RefRange range, const NodeBounds& bounds, uint32_t depth) {
        return partition(refs_of(range), bounds, depth);
    };
    NodeScratch scratch(refs.size());
    TopDownRecursion(scratch, bounds_of_range, partition_range, task)
        .build_node(0, {0, static_cast<uint32_t>(refs.size())}, 0);
    if (task.stopped()) return {};
    std::vector<uint32_t> prims(refs.size());
    for (size_t i = 0; i < refs.size(); ++i) prims[i] = refs[i].prim;
    return finish(scratch, prims);
}

}  // namespace boxwood
