#include "core/octree/cell_tree.h"

#include <algorithm>
#include <limits>

#include "core/structure/tested_prims.h"

namespace boxwood {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kLongLeaf = 1024;  ///< primitives: some ten microseconds; then a look at a stop

/// A node that the ray meets from parameter `enter` to `leave`.
struct Visit {
    uint32_t node;
    LatticeCell cell;
    double enter, leave;
};

/// The nodes that a ray meets, front to back. A cell's box is met from the largest of its three near(plane)
/// to the smallest of its three far(plane), bounds as of RaySlabs. Of a child's six planes three are its
/// parent's, and three lie in the middle; as near and far are monotonic, the parent's interval, cut at the
/// middle planes, is the child's: what RaySlabs::meets gives for its box. NaN and the wrong infinities, where
/// the ray is parallel to a plane, never compare.
template <Mode mode, class Counter>
class Traversal {
public:
    Traversal(const CellTree& tree, ClosestHit<mode>& ray, Counter& count)
        : tree_(tree), ray_(ray), count_(count) {
        for (uint32_t axis = 0; axis < 3; ++axis)
            flip_ |= (ray.is_negative(static_cast<int>(axis)) ? 1u : 0u) << axis;
    }

    /// As long as visit_leaf(leaf) is true.
    template <class VisitLeaf>
    void run(const VisitLeaf& visit_leaf) {
        if (tree_.nodes.empty()) return;
        Visit root{};
        count_.visit_node(0);
        ray_.enter_scene(tree_.bounds.lower, tree_.bounds.upper);
        if (!ray_.meets(tree_.bounds.lower, tree_.bounds.upper, root.enter)) return;
        root.leave = kInfinity;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& faces = ray_.is_negative(axis) ? tree_.bounds.lower : tree_.bounds.upper;
            const double leave = ray_.slabs().far(axis, double(faces[axis]));
            if (leave < root.leave) root.leave = leave;
        }
        stack_[size_++] = root;
        while (size_ > 0) {
            const Visit current = stack_[--size_];
            if (!ray_.is_open(current.enter)) continue;
            const CellTree::Node& node = tree_.nodes[current.node];
            if (!node.is_leaf()) {
                push_children(current, node);
            } else if (node.count > 0 && !visit_leaf(node)) {
                return;
            }
        }
    }

private:
    /// Halves in the order of the ray: it leaves half 0 at `leave`, and enters half 1 at `enter`.
    struct MiddlePlane {
        double enter = kInfinity, leave = kInfinity;
        uint32_t first = 0, last = 0;  ///< the halves that are met at all
    };

    MiddlePlane cut(const Visit& visit, size_t axis) const {
        const double plane = double(tree_.wall(axis, visit.cell.middle(axis)));
        MiddlePlane result;
        result.enter = ray_.slabs().near(static_cast<int>(axis), plane);
        result.leave = ray_.slabs().far(static_cast<int>(axis), plane);
        result.first = result.leave < visit.enter ? 1 : 0;
        result.last = result.enter > visit.leave ? 0 : 1;
        return result;
    }

    /// The children that are met, the nearest one on top; of equally near ones, in the order of the ray.
    void push_children(const Visit& visit, const CellTree::Node& node) {
        const uint32_t axes = node.split_axes();
        std::array<MiddlePlane, 3> cuts;
        for (size_t axis = 0; axis < 3; ++axis)
            if ((axes >> axis & 1u) != 0) cuts[axis] = cut(visit, axis);
        const uint32_t base = size_;
        for (uint32_t z = cuts[2].first; z <= cuts[2].last; ++z)
            for (uint32_t y = cuts[1].first; y <= cuts[1].last; ++y)
                for (uint32_t x = cuts[0].first; x <= cuts[0].last; ++x)
                    push_child(visit, node, cuts, {x, y, z}, base);
    }

    void push_child(const Visit& visit, const CellTree::Node& node, const std::array<MiddlePlane, 3>& cuts,
                    const std::array<uint32_t, 3>& halves, uint32_t base) {
        double enter = visit.enter, leave = visit.leave;
        for (size_t axis = 0; axis < 3; ++axis) {
            if (halves[axis] == 0) {
                if (cuts[axis].leave < leave) leave = cuts[axis].leave;
            } else {
                if (cuts[axis].enter > enter) enter = cuts[axis].enter;
            }
        }
        if (!(enter <= leave) || !ray_.is_open(enter)) return;
        const uint32_t axes = node.split_axes();
        const uint32_t octant = ((halves[0] | halves[1] << 1 | halves[2] << 2) ^ flip_) & axes;
        const uint32_t child = node.first + child_number(octant, axes);
        count_.visit_node(child);
        uint32_t place = size_++;
        for (; place > base && stack_[place - 1].enter <= enter; --place) stack_[place] = stack_[place - 1];
        stack_[place] = {child, visit.cell.child(octant), enter, leave};
    }

    const CellTree& tree_;
    ClosestHit<mode>& ray_;
    Counter& count_;
    uint32_t flip_ = 0;  // axes along which the ray descends
    uint32_t size_ = 0;
    std::array<Visit, 7 * CellTree::kMaxDepth + 1> stack_;  // each level leaves at most seven siblings
};

/// The primitives of the leaves that the ray meets, each once, as long as test(prim) is true.
template <Mode mode, class Counter, class Test>
void test_prims(const CellTree& tree, ClosestHit<mode>& ray, Counter& count, const Test& test) {
    TestedPrims tested;
    Traversal<mode, Counter>(tree, ray, count).run([&](const CellTree::Node& leaf) {
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            if (!tree.pieces.empty()) {
                double entry;
                if (!ray.meets(tree.pieces[i].lower, tree.pieces[i].upper, entry)) continue;
            }
            if (tested.add(tree.prims[i]) && !test(tree.prims[i])) return false;
        }
        return leaf.count < kLongLeaf || !ray.stopped();
    });
}

}  // namespace

float CellTree::wall(size_t axis, uint32_t number) const {
    // Rounding is monotonic, so walls do not decrease with the number; but the extent, rounded up, may lead
    // beyond the upper face, and rounded down before it.
    constexpr uint32_t kLast = 1u << kMaxDepth;
    const int k = static_cast<int>(axis);
    const float lower = bounds.lower[k], upper = bounds.upper[k];
    if (number == kLast) return upper;
    const double extent = double(upper) - double(lower);
    return std::min(static_cast<float>(double(lower) + extent * (double(number) * (1.0 / kLast))), upper);
}

template <Mode mode, class Counter>
void CellTree::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    test_prims(*this, closest, count, [&](uint32_t prim) {
        closest.test(mesh.triangle(prim), prim, count);
        return true;
    });
}

template <Mode mode, class Counter>
bool CellTree::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    test_prims(*this, ray, count, [&](uint32_t prim) {
        is_hit = ray.occludes(mesh.triangle(prim), count);
        return !is_hit;
    });
    return is_hit;
}

NodeList CellTree::list_nodes() const {
    NodeList list;
    list.nodes.resize(nodes.size());
    list.ref_prims = prims;
    std::vector<LatticeCell> cells(nodes.size());
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        NodeView& view = list.nodes[i];
        if (i == 0) view.bounds = bounds;
        view.kind = node.is_leaf() ? NodeKind::Leaf : NodeKind::Inner;
        if (node.is_leaf()) {
            view.first_ref = node.first;
            view.ref_count = node.count;
            continue;
        }
        const uint32_t axes = node.split_axes();
        for (uint32_t octant = 0; octant < 8; ++octant) {
            if ((octant & ~axes) != 0) continue;
            const uint32_t child = node.first + child_number(octant, axes);
            NodeView& child_view = list.nodes[child];
            child_view = {.bounds = view.bounds, .parent = i, .level = view.level + 1};
            for (size_t axis = 0; axis < 3; ++axis)
                if ((axes >> axis & 1u) != 0)
                    cut_half(child_view.bounds, static_cast<int>(axis), wall(axis, cells[i].middle(axis)),
                             octant >> axis & 1u);
            cells[child] = cells[i].child(octant);
        }
    }
    return list;
}

template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void CellTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool CellTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool CellTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool CellTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool CellTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
