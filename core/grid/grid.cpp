#include "core/grid/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/structure/tested_prims.h"

namespace boxwood {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr uint32_t kLongCell = 1024;  ///< primitives: some ten microseconds; then a look at a stop

/// The cells of one axis in the order in which the ray meets them: cell i lies between the planes i and i +
/// 1. Of the parameter t the ray is in cell i from enter(i) to leave(i), bounds as of RaySlabs: they grow
/// with i, and enter(i + 1) <= leave(i) where that is not behind the origin. NaN and the wrong infinities,
/// where the ray is parallel to the planes, never compare: such a cell holds the ray always or never.
class AxisWalk {
public:
    AxisWalk(const RaySlabs& slabs, int axis, const std::vector<float>& walls, int64_t stride)
        : slabs_(&slabs), axis_(axis), count_(static_cast<int32_t>(walls.size()) - 1) {
        const bool is_negative = slabs.is_negative(axis);
        planes_ = is_negative ? walls.data() + count_ : walls.data();
        step_ = is_negative ? -1 : 1;
        first_number_ = is_negative ? (count_ - 1) * stride : 0;
        stride_ = is_negative ? -stride : stride;
    }

    /// To the cells that hold the ray at t, from a guess of one of them.
    void start(double t, double guess) {
        int32_t i = guess >= 0.0 ? static_cast<int32_t>(std::min(guess, double(count_ - 1))) : 0;
        while (i + 1 < count_ && !(enter(i + 1) > t)) ++i;
        while (i >= 0 && enter(i) > t) --i;
        last_ = i;
        i = std::max(i, 0);
        while (i > 0 && !(leave(i - 1) < t)) --i;
        while (i < count_ && leave(i) < t) ++i;
        first_ = i;
        set_next_enter();
        set_first_leave();
    }
    /// To the next cell as well.
    void enter_next() {
        ++last_;
        set_next_enter();
    }
    /// Without the cells that are left before t; false if none are to come.
    bool leave_before(double t) {
        while (first_leave_ < t) {
            if (++first_ == count_) return false;
            set_first_leave();
        }
        return true;
    }

    double next_enter() const { return next_enter_; }
    int32_t first() const { return first_; }
    int32_t last() const { return last_; }
    /// Of a cell's number, what this axis adds to it.
    int64_t number(int32_t i) const { return first_number_ + i * stride_; }

private:
    double enter(int32_t i) const { return slabs_->near(axis_, double(planes_[i * step_])); }
    double leave(int32_t i) const { return slabs_->far(axis_, double(planes_[(i + 1) * step_])); }
    void set_next_enter() { next_enter_ = last_ + 1 < count_ ? enter(last_ + 1) : kInfinity; }
    void set_first_leave() { first_leave_ = first_ < count_ ? leave(first_) : kInfinity; }

    const RaySlabs* slabs_;
    int axis_;
    int32_t count_;
    const float* planes_;
    int32_t step_;
    int64_t first_number_, stride_;
    int32_t first_ = 0, last_ = -1;  // the cells that hold the ray
    double next_enter_ = kInfinity;  // of the cell after last_; infinity: there is none
    double first_leave_ = kInfinity;
};

/// Visits every cell whose closed box the ray meets (RaySlabs::meets), once, by ascending entry, as long as
/// visit_cell(number) is true and the entry is open.
///
/// Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987. Differs: the
/// parameters of the walls come from their index and are not accumulated; a cell that is left overlaps the
/// next one by the bounds of rounding (and the margin of fast mode), so that an axis may hold more than one
/// cell at a time, and a ray in a wall walks on both sides of it.
///
/// A cell is met from the largest of its three enter(i) to the smallest of its leave(i). So the cells met
/// from t on, of which none is met earlier, are those that are entered on one axis at t, with all cells of
/// the other two axes that hold the ray at t.
template <Mode mode, class VisitCell>
void walk(const Grid& grid, const ClosestHit<mode>& ray, double entry, VisitCell&& visit_cell) {
    const RaySlabs& slabs = ray.slabs();
    const auto x_stride = int64_t{1}, y_stride = x_stride * grid.cell_count(0),
               z_stride = y_stride * grid.cell_count(1);
    AxisWalk axes[3] = {AxisWalk(slabs, 0, grid.walls[0], x_stride),
                        AxisWalk(slabs, 1, grid.walls[1], y_stride),
                        AxisWalk(slabs, 2, grid.walls[2], z_stride)};
    const Box bounds = grid.bounds();
    for (int axis = 0; axis < 3; ++axis) {
        const double from = double(slabs.is_negative(axis) ? bounds.upper[axis] : bounds.lower[axis]);
        const double to = double(slabs.is_negative(axis) ? bounds.lower[axis] : bounds.upper[axis]);
        const double at = double(ray.ray().origin[axis]) + entry * double(ray.ray().direction[axis]);
        axes[axis].start(entry, (at - from) / (to - from) * grid.cell_count(static_cast<size_t>(axis)));
    }
    const auto visit_block = [&] {
        for (int32_t z = axes[2].first(); z <= axes[2].last(); ++z)
            for (int32_t y = axes[1].first(); y <= axes[1].last(); ++y)
                for (int32_t x = axes[0].first(); x <= axes[0].last(); ++x)
                    if (!visit_cell(axes[0].number(x) + axes[1].number(y) + axes[2].number(z))) return false;
        return true;
    };
    const auto visit_entered = [&](size_t axis) {
        const AxisWalk &u = axes[(axis + 1) % 3], &v = axes[(axis + 2) % 3];
        const int64_t number = axes[axis].number(axes[axis].last());
        for (int32_t j = v.first(); j <= v.last(); ++j)
            for (int32_t i = u.first(); i <= u.last(); ++i)
                if (!visit_cell(number + u.number(i) + v.number(j))) return false;
        return true;
    };
    if (!visit_block()) return;
    while (true) {
        const double x = axes[0].next_enter(), y = axes[1].next_enter(), z = axes[2].next_enter();
        const size_t axis = x <= y ? (x <= z ? 0 : 2) : (y <= z ? 1 : 2);
        const double t = axes[axis].next_enter();
        if (t == kInfinity || !ray.is_open(t)) return;
        axes[axis].enter_next();
        for (AxisWalk& each : axes)
            if (!each.leave_before(t)) return;
        if (!visit_entered(axis)) return;
    }
}

/// The primitives of the cells that the ray meets, each once, as long as test(prim) is true.
template <Mode mode, class Counter, class Test>
void test_prims(const Grid& grid, ClosestHit<mode>& ray, Counter& count, Test&& test) {
    if (grid.is_empty()) return;
    const Box bounds = grid.bounds();
    double entry;
    count.visit_node(0);
    ray.enter_scene(bounds.lower, bounds.upper);
    if (!ray.meets(bounds.lower, bounds.upper, entry)) return;
    TestedPrims tested;
    walk(grid, ray, entry, [&](int64_t cell) {
        count.visit_node(static_cast<uint32_t>(cell) + 1);
        const auto number = static_cast<size_t>(cell);
        for (uint32_t i = grid.cell_begin[number]; i < grid.cell_begin[number + 1]; ++i)
            if (tested.add(grid.prims[i]) && !test(grid.prims[i])) return false;
        return grid.cell_begin[number + 1] - grid.cell_begin[number] < kLongCell || !ray.stopped();
    });
}

}  // namespace

template <Mode mode, class Counter>
void Grid::closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
    test_prims(*this, closest, count, [&](uint32_t prim) {
        closest.test(mesh.triangle(prim), prim, count);
        return true;
    });
}

template <Mode mode, class Counter>
bool Grid::any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
    bool is_hit = false;
    test_prims(*this, ray, count, [&](uint32_t prim) {
        is_hit = ray.occludes(mesh.triangle(prim), count);
        return !is_hit;
    });
    return is_hit;
}

NodeList Grid::list_nodes() const {
    NodeList list;
    if (is_empty()) return list;
    list.nodes.reserve(cell_begin.size());
    list.ref_prims = prims;
    NodeView root;
    root.bounds = bounds();
    root.kind = NodeKind::Inner;
    list.nodes.push_back(root);
    for (uint32_t z = 0; z < cell_count(2); ++z)
        for (uint32_t y = 0; y < cell_count(1); ++y)
            for (uint32_t x = 0; x < cell_count(0); ++x) {
                const size_t number = list.nodes.size() - 1;
                NodeView cell;
                cell.bounds = cell_box(x, y, z);
                cell.parent = 0;
                cell.level = 1;
                cell.first_ref = cell_begin[number];
                cell.ref_count = cell_begin[number + 1] - cell_begin[number];
                list.nodes.push_back(cell);
            }
    return list;
}

size_t Grid::byte_count() const {
    return (walls[0].size() + walls[1].size() + walls[2].size()) * sizeof(float) +
           (cell_begin.size() + prims.size()) * sizeof(uint32_t);
}

template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Exact>&, NodeVisits&) const;
template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;
template void Grid::closest_hit(const Mesh&, ClosestHit<Mode::Fast>&, NodeVisits&) const;
template bool Grid::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, Count&) const;
template bool Grid::any_hit(const Mesh&, ClosestHit<Mode::Exact>&, NoCount&) const;
template bool Grid::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, Count&) const;
template bool Grid::any_hit(const Mesh&, ClosestHit<Mode::Fast>&, NoCount&) const;

}  // namespace boxwood
