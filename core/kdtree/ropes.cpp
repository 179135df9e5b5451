#include "core/kdtree/ropes.h"

#include <algorithm>
#include <cmath>

// Which leaves a ray must visit, and in which order.
//
// For a ray every inner node has a near child, which lies before the plane in the ray's direction, and a far
// one. Depth first, near before far, is an order of all leaves; KdTree visits in this order those whose cells
// the ray meets, by RaySlabs::meets. So does `climb` below, without a stack: it goes up from a node until it
// comes from a near child whose sibling's cell is met. It would do alone. Ropes only save steps:
//
// Let the ray leave leaf L, through the face of its cell on axis a, in the sense that for each other axis b
//   (1) far(b, L's entry wall) < near(a, L's exit wall)   and   (2) far(a, L's exit wall) < near(b, L's exit
//   wall),
// as computed, with near(a, L's exit wall) > 0. Rounding keeps the order of what is compared (see RaySlabs:
// near <= far wherever it is so exactly, for parameters that are not negative; a negative one is certainly
// below a positive one), so both hold exactly, of the ray widened by fast mode's margin as well: before it
// touches a's plane it has left the entry walls of all other axes, and when it has left a's plane it has not
// reached their exit walls. Let R be the rope of that face, its plane that of inner node A, so that L is in
// the near child of A and R in the far one. The claim: no leaf M between L and R in the order has a point in
// common with the ray. Let B be the lowest common ancestor, with axis b and plane p, and t any parameter at
// which the ray touches M's cell.
//   M in A's near child, after L: B divides L from M, L on p's near side, M on the far one. b = a is
//     impossible, since between L and A's plane there is nothing of the near child. So t >= near(b, p) >=
//     near(b, L's exit wall) > far(a, A's plane) by (2), but M lies before A's plane, so t <= far(a, A's
//     plane).
//   M in A's far child, before R: B divides M from R, R on p's far side. b = a is impossible, since R's cell
//     begins at A's plane. R's cell contains the face of L, so L's entry wall on b is at p or beyond it: t <=
//     far(b, p) <= far(b, L's entry wall) < near(a, A's plane) by (1), but M lies beyond A's plane.
// A face of the root has no A; then the first case shows that nothing comes after L. Where (1) or (2) fails
// (a NaN fails both), the ray climbs. Ropes and climbs go forward in one order of finitely many leaves, so
// each ray ends.

namespace boxwood {

namespace {

template <Mode mode, class Counter>
class Walk {
public:
    Walk(const RopedKdTree& roped, ClosestHit<mode>& ray, Counter& count)
        : roped_(roped), ray_(ray), count_(count) {}

    /// Visits leaves front to back as long as visit_leaf(leaf) is true.
    template <class VisitLeaf>
    void run(VisitLeaf&& visit_leaf) {
        if (roped_.tree.nodes.empty()) return;
        ray_.enter_scene(roped_.tree.bounds.lower, roped_.tree.bounds.upper);
        uint32_t node = 0;
        count_.visit_node(0);
        if (!meets(0)) return;
        while (node != kNoIndex) {
            node = descend(node);
            if (node == kNoIndex) return;
            if (!visit_leaf(roped_.tree.nodes[node])) return;
            node = next(node);
        }
    }

private:
    bool meets(uint32_t node) const {
        double entry;
        return ray_.meets(roped_.cells[node].lower, roped_.cells[node].upper, entry);
    }
    uint32_t near_child(uint32_t node) const {
        const KdTree::Node& inner = roped_.tree.nodes[node];
        return ray_.is_negative(inner.axis()) ? inner.right() : node + 1;
    }
    uint32_t far_child(uint32_t node) const {
        const KdTree::Node& inner = roped_.tree.nodes[node];
        return ray_.is_negative(inner.axis()) ? node + 1 : inner.right();
    }

    /// The first leaf below a node that is met, or the first one after it that is.
    uint32_t descend(uint32_t node) {
        while (node != kNoIndex && !roped_.tree.nodes[node].is_leaf()) {
            const uint32_t near = near_child(node), far = far_child(node);
            count_.visit_node(near);
            if (meets(near)) {
                node = near;
                continue;
            }
            count_.visit_node(far);
            node = meets(far) ? far : climb(node);
        }
        return node;
    }

    /// The first node after this one's subtree that is met and whose parent is an ancestor of it.
    uint32_t climb(uint32_t node) {
        for (uint32_t parent = roped_.parents[node]; parent != kNoIndex; parent = roped_.parents[node]) {
            if (node == near_child(parent)) {
                const uint32_t far = far_child(parent);
                count_.visit_node(far);
                if (meets(far)) return far;
            }
            node = parent;
        }
        return kNoIndex;
    }

    /// Where the search goes on after a leaf; kNoIndex where it ends.
    uint32_t next(uint32_t leaf) {
        const Box& cell = roped_.cells[leaf];
        double exit_near[3], exit_far[3], entry_far[3];
        int first = 0;  // axis with the nearest exit
        // Each later leaf is divided from this one by a plane that is an exit wall of it or lies beyond one:
        // none is entered before the first of these is reached. A NaN says nothing.
        double later = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double lower = double(cell.lower[axis]), upper = double(cell.upper[axis]);
            const double exit = ray_.is_negative(axis) ? lower : upper;
            exit_near[axis] = ray_.slabs().near(axis, exit);
            exit_far[axis] = ray_.slabs().far(axis, exit);
            entry_far[axis] = ray_.slabs().far(axis, ray_.is_negative(axis) ? upper : lower);
            later = std::isnan(exit_near[axis]) ? -std::numeric_limits<double>::infinity()
                                                : std::min(later, exit_near[axis]);
            if (exit_near[axis] < exit_near[first]) first = axis;
        }
        if (!ray_.is_open(later)) return kNoIndex;
        bool is_certain = exit_near[first] > 0.0;
        for (const int axis : {(first + 1) % 3, (first + 2) % 3}) {
            is_certain = is_certain && entry_far[axis] < exit_near[first] &&  // (1)
                         exit_far[first] < exit_near[axis];                   // (2)
        }
        if (!is_certain) return climb(leaf);
        const size_t face = static_cast<size_t>(ray_.is_negative(first) ? first : 3 + first);
        const uint32_t rope = roped_.ropes[roped_.leaves[leaf]].faces[face];
        if (rope == kNoIndex) return kNoIndex;
        count_.visit_node(rope);
        return meets(rope) ? rope : climb(rope);
    }

    const RopedKdTree& roped_;
    ClosestHit<mode>& ray_;
    Counter& count_;
};

/// Fills in the ropes below a node from those of its cell, depth first.
class RopeMaker {
public:
    explicit RopeMaker(RopedKdTree& roped) : roped_(roped), tree_(roped.tree) {}

    void make(uint32_t node, RopedKdTree::Ropes ropes) {
        for (size_t face = 0; face < 6; ++face) push_down(ropes.faces[face], face, roped_.cells[node]);
        const KdTree::Node& current = tree_.nodes[node];
        if (current.is_leaf()) {
            roped_.leaves[node] = static_cast<uint32_t>(roped_.ropes.size());
            roped_.ropes.push_back(ropes);
            return;
        }
        const uint32_t left = node + 1, right = current.right();
        const auto axis = static_cast<size_t>(current.axis());
        RopedKdTree::Ropes left_ropes = ropes, right_ropes = ropes;
        left_ropes.faces[3 + axis] = right;
        right_ropes.faces[axis] = left;
        make(left, left_ropes);
        make(right, right_ropes);
    }

private:
    /// Replaces a rope by the lowest node below it whose cell contains the face of `cell`.
    void push_down(uint32_t& rope, size_t face, const Box& cell) const {
        const bool is_upper = face >= 3;
        const int face_axis = static_cast<int>(face % 3);
        while (rope != kNoIndex && !tree_.nodes[rope].is_leaf()) {
            const KdTree::Node& inner = tree_.nodes[rope];
            const int axis = inner.axis();
            const uint32_t left = rope + 1, right = inner.right();
            if (axis == face_axis) {
                rope = is_upper ? left : right;
            } else if (inner.plane() >= cell.upper[axis]) {
                rope = left;
            } else if (inner.plane() <= cell.lower[axis]) {
                rope = right;
            } else {
                return;
            }
        }
    }

    RopedKdTree& roped_;
    const KdTree& tree_;
};

}  // namespace

template <Mode mode, class Counter>
void RopedKdTree::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    Walk<mode, Counter>(*this, closest, count).run([&](const KdTree::Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
            closest.test(mesh.triangle(tree.prims[i]), tree.prims[i], count);
        return true;
    });
}

template <Mode mode, class Counter>
bool RopedKdTree::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    Walk<mode, Counter>(*this, ray, count).run([&](const KdTree::Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count() && !is_hit; ++i)
            is_hit = ray.occludes(mesh.triangle(tree.prims[i]), count);
        return !is_hit;
    });
    return is_hit;
}

RopedKdTree AddRopes::apply(const Mesh&, std::span<const PrimRef>, const KdTree& input, Task& task) const {
    RopedKdTree roped;
    roped.tree = input;
    const size_t node_count = input.nodes.size();
    roped.cells.resize(node_count);
    roped.parents.assign(node_count, kNoIndex);
    roped.leaves.assign(node_count, kNoIndex);
    roped.ropes.reserve(node_count / 2 + 1);
    if (node_count == 0) return roped;
    roped.cells[0] = input.bounds;
    for (uint32_t i = 0; i < node_count && !task.stopped(); ++i) {
        const KdTree::Node& node = input.nodes[i];
        if (node.is_leaf()) continue;
        const uint32_t left = i + 1, right = node.right();
        roped.parents[left] = roped.parents[right] = i;
        roped.cells[left] = KdTree::left_cell(node, roped.cells[i]);
        roped.cells[right] = KdTree::right_cell(node, roped.cells[i]);
    }
    if (task.stopped()) return {};
    RopeMaker(roped).make(0, {{kNoIndex, kNoIndex, kNoIndex, kNoIndex, kNoIndex, kNoIndex}});
    return roped;
}

template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void RopedKdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool RopedKdTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool RopedKdTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool RopedKdTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool RopedKdTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
