#include "core/bsp/bsp_tree.h"

namespace boxwood {

namespace {

/// A node to be visited, and the parameters for which the ray may be in its cell.
struct Visit {
    uint32_t node;
    double entry, exit;
};

/// The parameters of an interval for which a + b t <= 0 may hold, a and b being lower bounds of what is
/// meant: for t >= 0 nothing is lost. Quotient and factor round by u each, which the factor makes up for.
Visit clip_interval(Visit visit, double a, double b) {
    constexpr double kPad = 4.0 * 0x1p-53;
    if (b > 0.0 || (b == 0.0 && a > 0.0)) {
        // Empty for a > 0. NaN, from 0 / 0, does not occur.
        const double last = b > 0.0 ? -a / b : -1.0;
        visit.exit = std::min(visit.exit, last > 0.0 ? last * (1.0 + kPad) : last);
    } else if (a > 0.0) {
        visit.entry = std::max(visit.entry, a / -b * (1.0 - kPad));
    }
    return visit;
}

/// The children of an inner node, the one to be visited first in front.
///
/// A hit q = o + t d lies in the left child's closed cell only if h(q) = h(o) + t (n.d) <= 0, h being the
/// plane's function, and in the right one's only if it is >= 0. h(o) and n.d are known up to the errors of
/// PlaneValue: with bounds in the place of both, the inequality holds for all t >= 0 for which it holds
/// exactly. In fast mode q is off the ray by at most `margin` along each axis, so h(q) is off by `slope`
/// times that.
template <Mode mode>
void divide(const BspTree& tree, const ClosestHit<mode>& ray, const Visit& visit, Visit (&children)[2]) {
    const BspTree::Node& node = tree.nodes[visit.node];
    const PlaneValue value(tree.plane_of(node));
    const DVec3 origin(ray.ray().origin), direction(ray.ray().direction);
    const double h = value.at(origin), slope = value.along(direction);
    const double h_error = value.error_at(origin) + ray.margin() * value.slope() * (1.0 + PlaneValue::kUnit);
    const double slope_error = value.error_along(direction);
    const Visit left{visit.node + 1, visit.entry, visit.exit}, right{node.right(), visit.entry, visit.exit};
    children[0] = clip_interval(left, h - h_error, slope - slope_error);
    children[1] = clip_interval(right, -h - h_error, -slope - slope_error);
    const bool left_first =
        children[0].entry < children[1].entry || (children[0].entry == children[1].entry && h <= 0.0);
    if (!left_first) std::swap(children[0], children[1]);
}

/// The ray's parameters inside the root's box. What RaySlabs::near gives may be above the exact parameter by
/// a factor of kPad, which does no harm among slabs; here it is taken off.
template <Mode mode>
Visit visit_root(const ClosestHit<mode>& ray, const Box& box) {
    constexpr double kUnpad = 1.0 - 8.0 * 0x1p-53;
    Visit root{0, ray.slabs().t_min(), std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        const bool is_negative = ray.is_negative(axis);
        const double lower = double(box.lower[axis]), upper = double(box.upper[axis]);
        const double entry = ray.slabs().near(axis, is_negative ? upper : lower);
        const double exit = ray.slabs().far(axis, is_negative ? lower : upper);
        root.entry = entry > root.entry ? entry : root.entry;
        root.exit = exit < root.exit ? exit : root.exit;
    }
    if (root.entry <= root.exit) root.entry *= kUnpad;
    return root;
}

/// Visits leaves front to back as long as visit_leaf(leaf) is true.
template <Mode mode, class Counter, class VisitLeaf>
void traverse(const BspTree& tree, ClosestHit<mode>& ray, Counter& count, VisitLeaf&& visit_leaf) {
    if (tree.nodes.empty()) return;
    ray.enter_scene(tree.bounds.lower, tree.bounds.upper);
    Visit visit = visit_root(ray, tree.bounds);
    count.visit_node(0);
    if (!(visit.entry <= visit.exit) || !ray.is_open(visit.entry)) return;
    Visit stack[BspTree::kMaxDepth];
    uint32_t size = 0;
    while (true) {
        const BspTree::Node& node = tree.nodes[visit.node];
        bool goes_down = false;
        if (node.is_leaf()) {
            if (!visit_leaf(node)) return;
        } else {
            Visit children[2];
            divide(tree, ray, visit, children);
            const auto is_visited = [&](const Visit& child) {
                return child.entry <= child.exit && ray.is_open(child.entry);
            };
            const bool visits_first = is_visited(children[0]), visits_second = is_visited(children[1]);
            if (visits_first && visits_second) {
                BOXWOOD_ASSERT(size < BspTree::kMaxDepth);
                stack[size++] = children[1];
            }
            visit = visits_first ? children[0] : children[1];
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
void BspTree::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    traverse(*this, closest, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
            closest.test(mesh.triangle(prims[i]), prims[i], count);
        return true;
    });
}

template <Mode mode, class Counter>
bool BspTree::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    traverse(*this, ray, count, [&](const Node& leaf) {
        for (uint32_t i = leaf.first(); i < leaf.first() + leaf.count() && !is_hit; ++i)
            is_hit = ray.occludes(mesh.triangle(prims[i]), count);
        return !is_hit;
    });
    return is_hit;
}

template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void BspTree::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool BspTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool BspTree::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool BspTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool BspTree::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
