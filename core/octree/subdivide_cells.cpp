#include "core/octree/subdivide_cells.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/parallel.h"
#include "core/refs/clip_polygon.h"
#include "core/refs/triangle_touches_box.h"

namespace boxwood {

namespace {

/// A node of the level at work: its references are entries [begin, begin + count) of the level's.
struct OpenNode {
    uint32_t node;
    uint32_t begin, count;
    LatticeCell cell;
    Box box;
    uint32_t axes = 0;                       ///< that it is split along; 0: it stays a leaf
    Vec3 middle{0.0f};                       ///< of those axes
    std::array<uint32_t, 8> child_counts{};  ///< by octant

    uint32_t child_count() const { return axes == 0 ? 0 : 1u << std::popcount(axes); }
    bool has_child(uint32_t octant) const { return (octant & ~axes) == 0; }
    uint32_t child_ref_count() const {
        uint32_t sum = 0;
        for (const uint32_t n : child_counts) sum += n;
        return sum;
    }
    Box child_box(uint32_t octant) const {
        Box child = box;
        for (int axis = 0; axis < 3; ++axis)
            if ((axes >> axis & 1u) != 0) cut_half(child, axis, middle[axis], octant >> axis & 1u);
        return child;
    }
};

class Subdivision {
public:
    Subdivision(const Mesh& mesh, std::span<const PrimRef> refs, const CellTreeRule& rule, Task& task)
        : mesh_(mesh), rule_(rule), task_(task), prims_(prims_of(refs)) {
        const auto per_triangle = static_cast<size_t>(rule.budget.per_triangle);
        budget_ = std::min(std::max(per_triangle * prims_.size(), rule.budget.at_least), kMaxReferences);
    }

    CellTree build() {
        if (prims_.empty()) return {};
        for (const uint32_t prim : prims_) tree_.bounds.extend(mesh_.triangle(prim).bounds());
        tree_.nodes.push_back({0, 0});
        open_.push_back({.node = 0,
                         .begin = 0,
                         .count = static_cast<uint32_t>(prims_.size()),
                         .cell = {},
                         .box = tree_.bounds});
        while (!open_.empty() && !task_.stopped()) {
            split_level();
            make_leaves();
            open_children();
        }
        if (task_.stopped()) return {};
        tree_.nodes.shrink_to_fit();
        tree_.prims.shrink_to_fit();
        if (rule_.split) make_pieces();
        return std::move(tree_);
    }

private:
    static constexpr size_t kNodeGrain = 16, kRefGrain = 2048;

    /// Decides which open nodes are split, and which of their children each reference touches.
    void split_level() {
        touched_.resize(prims_.size());
        parallel_for(open_.size(), kNodeGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end && !task_.stopped(); ++i) split(open_[i]);
        });
        size_t refs = tree_.prims.size(), nodes = tree_.nodes.size();
        uint64_t split_count = 0;
        for (const OpenNode& open : open_) {
            refs += open.axes == 0 ? open.count : open.child_ref_count();
            nodes += open.child_count();
            split_count += open.axes == 0 ? 0 : 1;
        }
        if (refs <= budget_ && nodes <= budget_) return;
        for (OpenNode& open : open_) open.axes = 0;
        task_.skipped.add("octree cells left whole: reference budget", split_count);
    }

    void split(OpenNode& open) {
        if (open.count <= rule_.max_leaf_size || open.cell.level >= rule_.max_depth) return;
        for (int axis = 0; axis < 3; ++axis) {
            if ((rule_.axes >> axis & 1u) == 0) continue;
            const auto k = static_cast<size_t>(axis);
            const float middle = tree_.wall(k, open.cell.middle(k));
            if (!(open.box.lower[axis] < middle && middle < open.box.upper[axis])) continue;
            open.middle[axis] = middle;
            open.axes |= 1u << axis;
        }
        if (open.axes == 0) return;
        parallel_for(open.count, kRefGrain, [&](size_t begin, size_t end) {
            for (size_t i = open.begin + begin; i < open.begin + end && !task_.stopped(); ++i)
                touched_[i] = touched_children(open, mesh_.triangle(prims_[i]));
        });
        for (uint32_t i = open.begin; i < open.begin + open.count; ++i)
            for (uint32_t octant = 0; octant < 8; ++octant)
                open.child_counts[octant] += touched_[i] >> octant & 1u;
        if (parts_nothing(open)) open.axes = 0;
    }

    /// One bit for each octant. The triangle touches the node's box.
    static uint8_t touched_children(const OpenNode& open, const Triangle& triangle) {
        const Box bounds = triangle.bounds();
        uint32_t lower = 7, upper = 0;  // axes on which the triangle's box reaches that side
        for (int axis = 0; axis < 3; ++axis) {
            if ((open.axes >> axis & 1u) == 0) continue;
            if (!(bounds.lower[axis] <= open.middle[axis])) lower &= ~(1u << axis);
            if (bounds.upper[axis] >= open.middle[axis]) upper |= 1u << axis;
        }
        const auto is_reached = [&](uint32_t octant) {
            return open.has_child(octant) && (octant & ~upper) == 0 && (~octant & 7u & ~lower) == 0;
        };
        uint32_t reached = 0;
        for (uint32_t octant = 0; octant < 8; ++octant)
            if (is_reached(octant)) reached |= 1u << octant;
        if (std::popcount(reached) == 1) return static_cast<uint8_t>(reached);  // the children fill the node
        const TriangleBoxTest test(triangle);
        uint32_t touched = 0;
        for (uint32_t octant = 0; octant < 8; ++octant)
            if ((reached >> octant & 1u) != 0 && test.touches_near(open.child_box(octant)))
                touched |= 1u << octant;
        return static_cast<uint8_t>(touched);
    }

    static bool parts_nothing(const OpenNode& open) {
        uint32_t full = 0;
        for (const uint32_t n : open.child_counts) {
            if (n != 0 && n != open.count) return false;
            full += n == 0 ? 0 : 1;
        }
        return full > 1;
    }

    void make_leaves() {
        for (const OpenNode& open : open_) {
            if (open.axes != 0) continue;
            tree_.nodes[open.node] = {static_cast<uint32_t>(tree_.prims.size()), open.count};
            tree_.prims.insert(tree_.prims.end(), prims_.begin() + open.begin,
                               prims_.begin() + open.begin + open.count);
            if (rule_.split) leaves_.push_back({open.node, open.box});
        }
    }

    /// The children of the nodes that are split become the level at work.
    void open_children() {
        std::vector<OpenNode> children;
        uint32_t ref_count = 0;
        for (const OpenNode& open : open_) {
            if (open.axes == 0) continue;
            const auto first = static_cast<uint32_t>(tree_.nodes.size());
            tree_.nodes[open.node] = {first, CellTree::Node::kInner | open.axes};
            tree_.nodes.resize(tree_.nodes.size() + open.child_count());
            for (uint32_t octant = 0; octant < 8; ++octant) {
                if (!open.has_child(octant)) continue;
                children.push_back({.node = first + child_number(octant, open.axes),
                                    .begin = ref_count,
                                    .count = open.child_counts[octant],
                                    .cell = open.cell.child(octant),
                                    .box = open.child_box(octant)});
                ref_count += open.child_counts[octant];
            }
        }
        std::vector<uint32_t> child_prims(ref_count);
        std::vector<size_t> first_child(open_.size() + 1, 0);
        for (size_t i = 0; i < open_.size(); ++i)
            first_child[i + 1] = first_child[i] + open_[i].child_count();
        parallel_for(open_.size(), kNodeGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end && !task_.stopped(); ++i)
                hand_down(open_[i], std::span(children).subspan(first_child[i], open_[i].child_count()),
                          child_prims);
        });
        prims_ = std::move(child_prims);
        open_ = std::move(children);
    }

    /// Copies the references of a node to its children, which stand in the order of octants.
    void hand_down(const OpenNode& open, std::span<const OpenNode> children, std::vector<uint32_t>& prims) {
        size_t child = 0;
        for (uint32_t octant = 0; octant < 8 && child < children.size(); ++octant) {
            if (!open.has_child(octant)) continue;
            uint32_t next = children[child++].begin;
            for (uint32_t i = open.begin; i < open.begin + open.count; ++i)
                if ((touched_[i] >> octant & 1u) != 0) prims[next++] = prims_[i];
        }
    }

    void make_pieces() {
        tree_.pieces.resize(tree_.prims.size());
        parallel_for(leaves_.size(), kNodeGrain, [&](size_t begin, size_t end) {
            for (size_t l = begin; l < end && !task_.stopped(); ++l) {
                const CellTree::Node& leaf = tree_.nodes[leaves_[l].node];
                for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
                    tree_.pieces[i] = clip_bounds(mesh_.triangle(tree_.prims[i]), leaves_[l].box);
            }
        });
    }

    struct LeafBox {
        uint32_t node;
        Box box;
    };

    const Mesh& mesh_;
    const CellTreeRule& rule_;
    Task& task_;
    size_t budget_;
    CellTree tree_;
    std::vector<uint32_t> prims_;   // references of the level at work
    std::vector<uint8_t> touched_;  // children that each of them touches, a bit for each octant
    std::vector<OpenNode> open_;
    std::vector<LeafBox> leaves_;  // where pieces are wanted
};

}  // namespace

CellTree subdivide_cells(const Mesh& mesh, std::span<const PrimRef> refs, const CellTreeRule& rule,
                         Task& task) {
    return Subdivision(mesh, refs, rule, task).build();
}

}  // namespace boxwood
