#include "core/bvh/late_split_clipping.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/refs/clip_polygon.h"

namespace boxwood {

namespace {

/// A leaf that is too large, and what may be made of it.
struct LargeLeaf {
    uint32_t node;
    uint32_t depth;
    size_t most_added = 0;  ///< references beyond those it has
};

/// The tree below one leaf. Node 0 is the leaf itself; places in `nodes` and `prims` count from 0.
struct DeepTree {
    std::vector<Bvh2::Node> nodes;
    std::vector<uint32_t> prims;
    uint64_t left_large = 0;  ///< boxes above SA_max for which the budget did not do
};

/// Cuts leaves one after the other, with arrays that are kept from one to the next.
class LeafCutter {
public:
    LeafCutter(const Mesh& mesh, const Bvh2& bvh, double max_area)
        : mesh_(mesh), bvh_(bvh), max_area_(max_area) {}

    DeepTree cut(const LargeLeaf& leaf, const Task& task) {
        const Bvh2::Node& node = bvh_.nodes[leaf.node];
        DeepTree tree;
        parts_.clear();
        cells_.clear();
        heap_.clear();
        for (uint32_t i = node.first; i < node.first + node.count; ++i) {
            const uint32_t prim = bvh_.prims[i];
            const Box box = clip_bounds(mesh_.triangle(prim), {node.lower, node.upper});
            if (!box.is_empty()) parts_.push_back({box, prim});
        }
        add_cell({node.lower, node.upper}, 0, static_cast<uint32_t>(parts_.size()), leaf.depth, tree);
        size_t left = leaf.most_added;
        while (!heap_.empty() && !task.stopped()) {
            std::pop_heap(heap_.begin(), heap_.end());
            const uint32_t cell = heap_.back().cell;
            heap_.pop_back();
            split(cell, left, tree);
        }
        for (size_t i = 0; i < cells_.size(); ++i) {
            if (tree.nodes[i].count == 0) continue;
            tree.nodes[i].first = static_cast<uint32_t>(tree.prims.size());
            for (uint32_t p = 0; p < cells_[i].count; ++p)
                tree.prims.push_back(parts_[cells_[i].first + p].prim);
        }
        return tree;
    }

private:
    /// The smallest box around the part of a primitive in a cell.
    struct Part {
        Box box;
        uint32_t prim;
    };
    struct Cell {
        size_t first;  ///< of its parts
        uint32_t count, depth;
    };
    struct Waiting {
        double area;
        uint32_t cell;
        bool operator<(const Waiting& other) const {
            return area < other.area || (area == other.area && cell > other.cell);
        }
    };

    /// A leaf for now; waits to be cut if it is too large.
    void add_cell(const Box& box, size_t first, uint32_t count, uint32_t depth, DeepTree& tree) {
        const auto cell = static_cast<uint32_t>(cells_.size());
        cells_.push_back({first, count, depth});
        tree.nodes.push_back({box.lower, 0, box.upper, count});
        const double area = box.surface_area();
        const LateSplitPlane plane = late_split_plane(box);
        const bool has_middle =
            box.lower[plane.axis] < plane.position && plane.position < box.upper[plane.axis];
        if (area > max_area_ && has_middle && depth < Bvh2::kMaxDepth) {
            heap_.push_back({area, cell});
            std::push_heap(heap_.begin(), heap_.end());
        }
    }

    /// Cuts a cell in two; not if that takes more references than are `left`, which it counts down.
    void split(uint32_t cell, size_t& left, DeepTree& tree) {
        const Cell parent = cells_[cell];
        const Bvh2::Node& node = tree.nodes[cell];
        const LateSplitPlane plane = late_split_plane({node.lower, node.upper});
        const size_t first = parts_.size();
        const Sides sides = add_sides(parent, plane);
        const Side &lower = sides.lower, &upper = sides.upper;
        const size_t added = size_t{lower.count} + upper.count - parent.count;
        // One side is empty only where a leaf's box is larger than what it holds.
        const bool is_cut = added <= left && lower.count > 0 && upper.count > 0;
        if (!is_cut) {
            if (added > left) ++tree.left_large;
            parts_.resize(first);
            return;
        }
        left -= added;
        tree.nodes[cell].first = static_cast<uint32_t>(tree.nodes.size());
        tree.nodes[cell].count = 0;
        add_cell(lower.box, first, lower.count, parent.depth + 1, tree);
        add_cell(upper.box, first + lower.count, upper.count, parent.depth + 1, tree);
    }

    struct Side {
        uint32_t count = 0;
        Box box;
    };
    struct Sides {
        Side lower, upper;
    };
    /// Appends the parts of the parent's parts on the closed lower side of the plane, then those on the
    /// upper.
    Sides add_sides(const Cell& parent, const LateSplitPlane& plane) {
        Sides sides;
        upper_parts_.clear();
        const auto add = [](const Box& box, uint32_t prim, Side& side, std::vector<Part>& parts) {
            if (box.is_empty()) return;
            side.box.extend(box);
            ++side.count;
            parts.push_back({box, prim});
        };
        for (size_t p = parent.first; p < parent.first + parent.count; ++p) {
            const auto [box, prim] = parts_[p];
            const float lower = box.lower[plane.axis], upper = box.upper[plane.axis];
            ClippedHalves halves;
            if (upper < plane.position)
                halves.lower = box;
            else if (lower > plane.position)
                halves.upper = box;
            else
                halves = clip_halves(mesh_.triangle(prim), box, plane.axis, plane.position);
            add(halves.lower, prim, sides.lower, parts_);
            add(halves.upper, prim, sides.upper, upper_parts_);
        }
        parts_.insert(parts_.end(), upper_parts_.begin(), upper_parts_.end());
        return sides;
    }

    const Mesh& mesh_;
    const Bvh2& bvh_;
    double max_area_;
    std::vector<Part> parts_;
    std::vector<Part> upper_parts_;  ///< of the cut under way
    std::vector<Cell> cells_;
    std::vector<Waiting> heap_;
};

/// Leaves with an area above the limit, each with its share of the references that may be added.
std::vector<LargeLeaf> large_leaves(const Bvh2& bvh, double max_area, size_t most_added, Task& task) {
    std::vector<LargeLeaf> leaves;
    std::vector<double> wanted;
    std::vector<uint8_t> depth(bvh.nodes.size(), 0);
    double sum = 0.0;
    uint64_t tight_count = 0;
    for (uint32_t i = 0; i < bvh.nodes.size(); ++i) {
        const Bvh2::Node& node = bvh.nodes[i];
        if (!node.is_leaf()) {
            depth[node.first] = depth[node.first + 1] = static_cast<uint8_t>(depth[i] + 1);
            continue;
        }
        const double area = Box{node.lower, node.upper}.surface_area();
        if (area > max_area) {
            leaves.push_back({i, depth[i]});
            wanted.push_back(node.count * area);
            sum += wanted.back();
        } else {
            ++tight_count;
        }
    }
    for (size_t l = 0; l < leaves.size(); ++l)
        leaves[l].most_added = static_cast<size_t>(static_cast<double>(most_added) * (wanted[l] / sum));
    task.skipped.add("tight", tight_count);
    return leaves;
}

/// The primitives of leaves that were not cut, in their order.
void keep_prims_of_the_rest(const Bvh2& input, const std::vector<LargeLeaf>& leaves,
                            const std::vector<DeepTree>& trees, LateSplitBvh& result) {
    std::vector<uint8_t> is_kept(input.prims.size(), 1);
    for (size_t l = 0; l < leaves.size(); ++l) {
        const Bvh2::Node& leaf = input.nodes[leaves[l].node];
        if (trees[l].nodes.size() > 1) std::fill_n(is_kept.begin() + leaf.first, leaf.count, uint8_t{0});
    }
    std::vector<uint32_t> place(input.prims.size());
    for (size_t i = 0; i < input.prims.size(); ++i) {
        place[i] = static_cast<uint32_t>(result.prims.size());
        if (is_kept[i] != 0) result.prims.push_back(input.prims[i]);
    }
    for (Bvh2::Node& node : result.nodes)
        if (node.is_leaf()) node.first = place[node.first];
}

/// Appends the trees to the nodes of the original one, those of leaves with one primitive first.
LateSplitBvh join(const Bvh2& input, const std::vector<LargeLeaf>& leaves,
                  const std::vector<DeepTree>& trees) {
    LateSplitBvh result;
    result.nodes = input.nodes;
    result.original_count = static_cast<uint32_t>(input.nodes.size());
    keep_prims_of_the_rest(input, leaves, trees, result);
    for (const bool are_single : {true, false}) {
        for (size_t l = 0; l < leaves.size(); ++l) {
            const std::vector<Bvh2::Node>& nodes = trees[l].nodes;
            if (nodes.size() == 1 || (input.nodes[leaves[l].node].count == 1) != are_single) continue;
            // Node 0 of the tree is the leaf; the others come here.
            const auto before_first = static_cast<uint32_t>(result.nodes.size()) - 1;
            const auto first_prim = static_cast<uint32_t>(result.prims.size());
            result.nodes[leaves[l].node].first = before_first + nodes[0].first;
            result.nodes[leaves[l].node].count = 0;
            for (size_t i = 1; i < nodes.size(); ++i) {
                result.nodes.push_back(nodes[i]);
                result.nodes.back().first += nodes[i].is_leaf() ? first_prim : before_first;
            }
            result.prims.insert(result.prims.end(), trees[l].prims.begin(), trees[l].prims.end());
        }
        if (are_single) result.single_end = static_cast<uint32_t>(result.nodes.size());
    }
    return result;
}

}  // namespace

LateSplitBvh LateSplitClipping::apply(const Mesh& mesh, std::span<const PrimRef>, const Bvh2& input,
                                      Task& task) const {
    if (input.nodes.empty()) return {};
    const double root_area = Box{input.nodes[0].lower, input.nodes[0].upper}.surface_area();
    const double max_area = limit.max_area(root_area);
    const size_t most_added = input.prims.size() * (static_cast<size_t>(budget) - 1);
    const std::vector<LargeLeaf> leaves = large_leaves(input, max_area, most_added, task);
    std::vector<DeepTree> trees(leaves.size());
    task.total = leaves.size();
    parallel_for(leaves.size(), 8, [&](size_t begin, size_t end) {
        LeafCutter cutter(mesh, input, max_area);
        uint64_t left_large = 0;
        for (size_t l = begin; l < end && !task.stopped(); ++l) {
            trees[l] = cutter.cut(leaves[l], task);
            left_large += trees[l].left_large;
        }
        task.skipped.add("over the reference budget", left_large);
        task.done += end - begin;
    });
    if (task.stopped()) return {};
    return join(input, leaves, trees);
}

}  // namespace boxwood
