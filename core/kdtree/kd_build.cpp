#include "core/kdtree/kd_build.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/refs/clip_polygon.h"

namespace boxwood {

namespace {

constexpr size_t kSerialCount = 2048;  ///< smaller nodes are built by one thread

/// The build with planes by a chooser.
class ChosenBuild {
public:
    ChosenBuild(const Mesh& mesh, const KdLimits& limits, uint32_t max_depth, const KdChooser& choose,
                const Task& task)
        : mesh_(mesh), limits_(limits), max_depth_(max_depth), choose_(choose), task_(task) {}

    void build_node(std::vector<PrimRef> pieces, const Box& cell, uint32_t depth, RefBudget budget,
                    KdOutput& output) const {
        std::optional<KdSplit> split;
        if (pieces.size() > limits_.leaf_size && depth < max_depth_ && !task_.stopped())
            split = choose_(pieces, cell);
        if (!split) return output.add_leaf(pieces);
        std::vector<PrimRef> left, right;
        divide(pieces, *split, left, right);
        if (!budget.allows(left.size(), right.size())) return output.add_leaf(pieces);
        const bool is_large = pieces.size() > kSerialCount;
        pieces = {};  // so that pieces of one node on each path are kept alone

        const RefBudget left_budget = budget.left_share(left.size(), right.size());
        const RefBudget right_budget{budget.refs - left_budget.refs};
        Box left_cell = cell, right_cell = cell;
        left_cell.upper[split->axis] = right_cell.lower[split->axis] = split->plane;
        const auto build_left = [&](KdOutput& out) {
            build_node(std::move(left), left_cell, depth + 1, left_budget, out);
        };
        const auto build_right = [&](KdOutput& out) {
            build_node(std::move(right), right_cell, depth + 1, right_budget, out);
        };
        const uint32_t inner = output.add_inner(*split);
        if (is_large) {
            KdOutput left_output, right_output;
            parallel_invoke([&] { build_left(left_output); }, [&] { build_right(right_output); });
            output.append(left_output);
            output.begin_right(inner);
            output.append(right_output);
        } else {
            build_left(output);
            output.begin_right(inner);
            build_right(output);
        }
    }

private:
    void divide(const std::vector<PrimRef>& pieces, const KdSplit& split, std::vector<PrimRef>& left,
                std::vector<PrimRef>& right) const {
        for (const PrimRef& piece : pieces) {
            switch (side_of(piece.bounds, split)) {
                case KdSide::Left:
                    left.push_back(piece);
                    break;
                case KdSide::Right:
                    right.push_back(piece);
                    break;
                case KdSide::Both:
                    const KdParts parts = cut_piece(mesh_, piece, split, limits_.clip);
                    if (!parts.left.is_empty()) left.push_back({parts.left, piece.prim});
                    if (!parts.right.is_empty()) right.push_back({parts.right, piece.prim});
                    break;
            }
        }
    }

    const Mesh& mesh_;
    const KdLimits& limits_;
    uint32_t max_depth_;
    const KdChooser& choose_;
    const Task& task_;
};

}  // namespace

uint32_t KdLimits::depth_for(size_t ref_count) const {
    return max_depth > 0 ? std::min(max_depth, KdTree::kMaxDepth) : default_depth(ref_count);
}

KdParts cut_piece(const Mesh& mesh, const PrimRef& piece, const KdSplit& split, bool clip) {
    KdParts parts{piece.bounds, piece.bounds};
    parts.left.upper[split.axis] = split.plane;
    parts.right.lower[split.axis] = split.plane;
    if (!clip) return parts;
    const Triangle triangle = mesh.triangle(piece.prim);
    return {clip_bounds(triangle, parts.left), clip_bounds(triangle, parts.right)};
}

void KdOutput::add_leaf(std::span<const PrimRef> pieces) {
    const size_t first = prims_.size();
    for (const PrimRef& piece : pieces) prims_.push_back(piece.prim);
    const auto begin = prims_.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, prims_.end());
    prims_.erase(std::unique(begin, prims_.end()), prims_.end());
    const size_t count = prims_.size() - first;
    BOXWOOD_ASSERT(prims_.size() < kNoIndex && count <= KdTree::kMaxCount);
    nodes_.push_back(KdTree::Node::leaf(static_cast<uint32_t>(first), static_cast<uint32_t>(count)));
}

uint32_t KdOutput::add_inner(const KdSplit& split) {
    nodes_.push_back(KdTree::Node::inner(split.axis, split.plane, 0));
    return static_cast<uint32_t>(nodes_.size() - 1);
}

void KdOutput::begin_right(uint32_t inner) {
    BOXWOOD_ASSERT(nodes_.size() <= KdTree::kMaxCount);
    KdTree::Node& node = nodes_[inner];
    node = KdTree::Node::inner(node.axis(), node.plane(), static_cast<uint32_t>(nodes_.size()));
}

void KdOutput::append(const KdOutput& subtree) {
    const auto node_offset = static_cast<uint32_t>(nodes_.size());
    const auto prim_offset = static_cast<uint32_t>(prims_.size());
    for (const KdTree::Node& node : subtree.nodes_)
        nodes_.push_back(node.is_leaf()
                             ? KdTree::Node::leaf(node.first() + prim_offset, node.count())
                             : KdTree::Node::inner(node.axis(), node.plane(), node.right() + node_offset));
    prims_.insert(prims_.end(), subtree.prims_.begin(), subtree.prims_.end());
}

KdTree KdOutput::finish(const Box& bounds) {
    nodes_.shrink_to_fit();
    prims_.shrink_to_fit();
    KdTree tree;
    tree.bounds = bounds;
    tree.nodes = std::move(nodes_);
    tree.prims = std::move(prims_);
    return tree;
}

Box bounds_of_refs(std::span<const PrimRef> refs) {
    Box bounds;
    for (const PrimRef& ref : refs) bounds.extend(ref.bounds);
    return bounds;
}

KdTree build_kd_tree(const Mesh& mesh, std::span<const PrimRef> refs, const KdLimits& limits,
                     const KdChooser& choose, const Task& task) {
    if (refs.empty()) return {};
    const Box bounds = bounds_of_refs(refs);
    const ChosenBuild build(mesh, limits, limits.depth_for(refs.size()), choose, task);
    KdOutput output;
    build.build_node({refs.begin(), refs.end()}, bounds, 0, {uint64_t{limits.budget} * refs.size()}, output);
    if (task.stopped()) return {};
    return output.finish(bounds);
}

}  // namespace boxwood
