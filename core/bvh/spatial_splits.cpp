#include "core/bvh/spatial_splits.h"

#include <atomic>
#include <memory>

#include "core/base/parallel.h"
#include "core/bvh/object_bins.h"
#include "core/bvh/sweep_subtree.h"
#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

constexpr uint32_t kRefBlock = 1u << 14;  ///< references that one thread takes at a time

/// A node of the upper part of the tree: two branches, or a finished subtree.
struct Branch {
    Box box;
    std::unique_ptr<Branch> left, right;
    Subtree subtree;
    size_t node_count = 0, prim_count = 0;  ///< below it; its own node not counted
};

/// References of a node: a range of one of two arrays, with room for what its budget allows.
struct Segment {
    uint64_t begin, most_refs;
    uint32_t count;
    SetBounds bounds;
};

class SpatialBuild {
public:
    SpatialBuild(const SpatialSplits& params, const Mesh& mesh, std::span<const PrimRef> refs, Task& task)
        : params_(params), mesh_(mesh), task_(task) {
        const auto wanted = static_cast<uint64_t>(double(params.budget) * static_cast<double>(refs.size()));
        most_refs_ = std::clamp<uint64_t>(wanted, refs.size(), kMostRefs);
        for (auto& array : refs_) array = std::make_unique_for_overwrite<SplitRef[]>(most_refs_);
        root_ = {0, most_refs_, static_cast<uint32_t>(refs.size()), {}};
        for_blocks(
            root_.count,
            [&](uint32_t begin, uint32_t end, SetBounds& bounds) {
                for (uint32_t i = begin; i < end; ++i) {
                    refs_[0][i] = {refs[i].bounds.lower, refs[i].prim, refs[i].bounds.upper};
                    bounds.extend(refs_[0][i]);
                }
            },
            [&](const SetBounds& bounds) { root_.bounds.extend(bounds); });
    }

    Bvh2 build() {
        root_area_ = half_area(root_.bounds.box);
        Branch branch;
        build_branch(branch, root_, 0, 0);
        if (task_.stopped()) return {};
        task_.skipped.add("children do not overlap", without_overlap_);
        task_.skipped.add("over the reference budget", over_budget_);
        Bvh2 bvh;
        bvh.nodes.resize(branch.node_count + 1);
        bvh.prims.resize(branch.prim_count);
        write(branch, bvh, 0, 1, 0);
        return bvh;
    }

private:
    static constexpr uint64_t kMostRefs = uint64_t{1} << 31;

    /// body(begin, end, local) for blocks of the range, in parallel; then merge(local) in their order.
    template <class Body, class Merge>
    void for_blocks(uint32_t count, const Body& body, const Merge& merge) {
        const size_t block_count = (count + kRefBlock - 1) / kRefBlock;
        std::vector<SetBounds> locals(block_count);
        parallel_for(count, kRefBlock, [&](size_t begin, size_t end) {
            body(static_cast<uint32_t>(begin), static_cast<uint32_t>(end), locals[begin / kRefBlock]);
        });
        for (const SetBounds& local : locals) merge(local);
    }

    void build_branch(Branch& out, const Segment& set, size_t buffer, uint32_t depth) {
        out.box = set.bounds.box.box();
        if (task_.stopped()) return;
        if (set.count <= SpatialSplits::kSweepCount) return build_subtree(out, set, buffer, depth);
        Segment left, right;
        divide(set, buffer, depth, left, right);
        out.left = std::make_unique<Branch>();
        out.right = std::make_unique<Branch>();
        parallel_invoke([&] { build_branch(*out.left, left, 1 - buffer, depth + 1); },
                        [&] { build_branch(*out.right, right, 1 - buffer, depth + 1); });
        out.node_count = out.left->node_count + out.right->node_count + 2;
        out.prim_count = out.left->prim_count + out.right->prim_count;
    }

    void build_subtree(Branch& out, const Segment& set, size_t buffer, uint32_t depth) {
        SweepSubtree builder(params_, mesh_, root_area_);
        out.subtree = builder.build({&refs_[buffer][set.begin], set.count}, set.most_refs, depth);
        without_overlap_ += builder.counts().without_overlap;
        over_budget_ += builder.counts().over_budget;
        out.node_count = out.subtree.nodes.size() - 1;
        out.prim_count = out.subtree.prims.size();
    }

    void divide(const Segment& set, size_t buffer, uint32_t depth, Segment& left, Segment& right) {
        const SplitRef* refs = &refs_[buffer][set.begin];
        if (!must_halve(depth, set.count)) {
            ObjectBins bins(set.bounds.half_centers);
            for (uint32_t i = 0; i < set.count; ++i) bins.add(refs[i]);
            const SpatialSplit split = bins.cheapest_split(set.count);
            if (split.axis >= 0 &&
                common_half_area(split.left_box, split.right_box) <= double(params_.overlap) * root_area_) {
                ++without_overlap_;
            } else if (set.count >= set.most_refs) {
                ++over_budget_;
            } else if (divide_space(set, buffer, split.cost, left, right)) {
                return;
            }
            if (split.axis >= 0) {
                place(set, buffer, split, left, right, [&](const SplitRef& ref) {
                    return bins.is_left(ref, split) ? Side::Left : Side::Right;
                });
                return;
            }
        }
        uint32_t i = 0;
        SpatialSplit halves;
        halves.left_count = set.count / 2;
        halves.right_count = set.count - halves.left_count;
        halves.left_box = halves.right_box = set.bounds.box;
        place(set, buffer, halves, left, right,
              [&](const SplitRef&) { return i++ < halves.left_count ? Side::Left : Side::Right; });
    }

    bool divide_space(const Segment& set, size_t buffer, double object_cost, Segment& left, Segment& right) {
        const SplitRef* refs = &refs_[buffer][set.begin];
        SpatialBins bins(set.bounds.box, bins_for(params_, set.count));
        for (uint32_t i = 0; i < set.count; ++i) bins.add(refs[i], mesh_);
        const SpatialSplit split = bins.cheapest_split();
        if (split.axis < 0 || !(split.cost < object_cost)) return false;
        if (uint64_t{split.left_count} + split.right_count > set.most_refs) {
            ++over_budget_;
            return false;
        }
        const std::vector<uint32_t> both = place(set, buffer, split, left, right,
                                                 [&](const SplitRef& ref) { return bins.side(ref, split); });
        SpatialCutter cutter(mesh_, split);
        for (const uint32_t i : both) {
            const SpatialCutter::Parts parts = cutter.cut(refs[i]);
            if (parts.has_left) put(left, parts.left, 1 - buffer);
            if (parts.has_right) put(right, parts.right, 1 - buffer);
        }
        return left.count > 0 && right.count > 0;
    }

    /// Copies the references that lie on one side to the other array; returns the places of the rest.
    template <class SideOf>
    std::vector<uint32_t> place(const Segment& set, size_t buffer, const SpatialSplit& split, Segment& left,
                                Segment& right, const SideOf& side_of) {
        const uint64_t share =
            left_budget(set.most_refs, split.left_count, split.left_box, split.right_count, split.right_box);
        left = {set.begin, share, 0, {}};
        right = {set.begin + share, set.most_refs - share, 0, {}};
        std::vector<uint32_t> both;
        for (uint32_t i = 0; i < set.count; ++i) {
            const SplitRef& ref = refs_[buffer][set.begin + i];
            const Side side = side_of(ref);
            if (side == Side::Both) {
                both.push_back(i);
            } else {
                put(side == Side::Left ? left : right, ref, 1 - buffer);
            }
        }
        return both;
    }

    void put(Segment& side, const SplitRef& ref, size_t buffer) {
        refs_[buffer][side.begin + side.count++] = ref;
        side.bounds.extend(ref);
    }

    /// Node `at` and, from `first_node` and `first_prim` on, all that is below it.
    void write(const Branch& branch, Bvh2& bvh, size_t at, size_t first_node, size_t first_prim) {
        if (branch.left) {
            bvh.nodes[at] = {branch.box.lower, static_cast<uint32_t>(first_node), branch.box.upper, 0};
            const Branch &left = *branch.left, &right = *branch.right;
            const auto write_left = [&] { write(left, bvh, first_node, first_node + 2, first_prim); };
            const auto write_right = [&] {
                write(right, bvh, first_node + 1, first_node + 2 + left.node_count,
                      first_prim + left.prim_count);
            };
            parallel_invoke(write_left, write_right);
            return;
        }
        const std::vector<Bvh2::Node>& nodes = branch.subtree.nodes;
        for (size_t i = 0; i < nodes.size(); ++i) {
            Bvh2::Node node = nodes[i];
            node.first += static_cast<uint32_t>(node.is_leaf() ? first_prim : first_node - 1);
            bvh.nodes[i == 0 ? at : first_node + i - 1] = node;
        }
        std::copy(branch.subtree.prims.begin(), branch.subtree.prims.end(),
                  bvh.prims.begin() + static_cast<std::ptrdiff_t>(first_prim));
    }

    const SpatialSplits& params_;
    const Mesh& mesh_;
    Task& task_;
    std::unique_ptr<SplitRef[]> refs_[2];
    uint64_t most_refs_ = 0;
    Segment root_{};
    double root_area_ = 0.0;
    std::atomic<uint64_t> without_overlap_{0}, over_budget_{0};
};

}  // namespace

Bvh2 SpatialSplits::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    return SpatialBuild(*this, mesh, refs, task).build();
}

}  // namespace boxwood
