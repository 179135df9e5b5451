#include "core/kdtree/kd_tree.h"

namespace boxwood {

namespace {

/// A node to be visited, and the parameters for which the ray may be in its cell.
struct Visit {
    uint32_t node;
    double entry, exit;
};

/// The ray's parameters inside the root's cell; none if entry > exit.
template <Mode mode>
Visit visit_root(const ClosestHit<mode>& ray, const Box& cell) {
    Visit root{0, ray.slabs().t_min(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_negative = ray.is_negative(axis);
        const double lower = double(cell.lower[axis]), upper = double(cell.upper[axis]);
        const double entry = ray.slabs().near(axis, is_negative ? upper : lower);
        const double exit = ray.slabs().far(axis, is_negative ? lower : upper);
        root.entry = entry > root.entry ? entry : root.entry;
        root.exit = exit < root.exit ? exit : root.exit;
    }
    return root;
}

/// Visits leaves front to back as long as visit_leaf(leaf) is true.
///
/// Nothing is missed: a node is visited if and only if RaySlabs::meets says so of its cell and no hit is
/// nearer. `entry` is the largest of t_min and of near(plane) over the planes that the ray enters the cell
/// through, `exit` the smallest far(plane) over those that it leaves through: near and far grow with the
/// plane in the ray's direction, so that a cell's own faces decide among all the planes above it. A child has
/// one more plane, which is the last of its near side's exits or of its far side's entries; a NaN (the origin
/// on the plane, no direction along the axis) leaves the interval as it is, and the ray visits both. With
/// that, what holds for `meets` holds here, in fast mode too, whose slabs are widened: a hit in the closed
/// cell has its parameter in the interval. A hit beyond the cell that is visited is a hit all the same and is
/// kept; the search ends when no node is left whose entry is as near as the best hit.
template <Mode mode, class Counter, class VisitLeaf>
void traverse(const KdTree& tree, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    if (tree.nodes.empty()) return;
    ray.enter_scene(tree.bounds.lower, tree.bounds.upper);
    Visit visit = visit_root(ray, tree.bounds);
    count.visit_node(0);
    if (!(visit.entry <= visit.exit) || !ray.is_open(visit.entry)) return;
    Visit stack[KdTree::kMaxDepth];
    uint32_t size = 0;
    while (true) {
        const KdTree::Node& node = tree.nodes[visit.node];
        bool goes_down = false;
        if (node.is_leaf()) {
            if (!visit_leaf(node)) return;
        } else {
            const int axis = node.axis();
            const double plane = double(node.plane());
            const double far = ray.slabs().far(axis, plane), near = ray.slabs().near(axis, plane);
            const bool is_negative = ray.is_negative(axis);
            const uint32_t left = visit.node + 1, right = node.right();
            const Visit first{is_negative ? right : left, visit.entry, far < visit.exit ? far : visit.exit};
            const Visit second{is_negative ? left : right, near > visit.entry ? near : visit.entry,
                               visit.exit};
            const bool visits_first = first.entry <= first.exit;
            const bool visits_second = second.entry <= second.exit && ray.is_open(second.entry);
            if (visits_first && visits_second) {
                BOXWOOD_ASSERT(size < KdTree::kMaxDepth);
                stack[size++] = second;
            }
            visit = visits_first ? first : second;
            goes_down = visits_first || visits_second;
        }
        if (!goes_down) {
            do {
                if (size == 0) return;
                --size;
            } while (!ray.is_open(stack[size].entry));
            visit = stack[size];
        }
        count.visit_node(visit.node);
    }
}

}  // namespace

template <Mode mode, class Counter>
void KdTree::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
            closest.test(mesh.triangle(prims[i]), prims[i], count);
        return true;
    });
}

template <Mode mode, class Counter>
bool KdTree::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count() && !is_hit; ++i)
            is_hit = ray.occludes(mesh.triangle(prims[i]), count);
        return !is_hit;
    });
    return is_hit;
}

NodeList KdTree::list_nodes() const {
    NodeList list;
    list.nodes.resize(nodes.size());
    list.ref_prims = prims;
    if (!nodes.empty()) list.nodes[0].bounds = bounds;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        NodeView& view = list.nodes[i];
        if (node.is_leaf()) {
            view.first_ref = node.first();
            view.ref_count = node.count();
            continue;
        }
        view.kind = NodeKind::Inner;
        for (const uint32_t child : {i + 1, node.right()}) {
            list.nodes[child].parent = i;
            list.nodes[child].level = view.level + 1;
        }
        list.nodes[i + 1].bounds = left_cell(node, view.bounds);
        list.nodes[node.right()].bounds = right_cell(node, view.bounds);
    }
    return list;
}

template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void KdTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool KdTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool KdTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool KdTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool KdTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
