#include "core/kdtree/kd_events.h"

namespace boxwood {

namespace {

/// Costs of planes on one axis of a cell.
class PlaneCost {
public:
    PlaneCost(int axis, const Box& cell, const KdCosts& costs)
        : costs_(costs), lower_(double(cell.lower[axis])), upper_(double(cell.upper[axis])) {
        const DVec3 extent = cell.extent();
        const double u = extent[(axis + 1) % 3], v = extent[(axis + 2) % 3];
        wall_area_ = u * v;
        perimeter_ = u + v;
        traversal_ = costs.traversal * cell.half_area();
    }
    /// cost = C_t + C_i (SA(left) N_left + SA(right) N_right) / SA, times SA.
    double operator()(double plane, size_t left_count, size_t right_count) const {
        const double left_area = wall_area_ + (plane - lower_) * perimeter_;
        const double right_area = wall_area_ + (upper_ - plane) * perimeter_;
        const double cost = traversal_ + kIntersectionCost * (left_area * static_cast<double>(left_count) +
                                                              right_area * static_cast<double>(right_count));
        return left_count == 0 || right_count == 0 ? cost * (1.0 - costs_.empty_bonus) : cost;
    }

private:
    const KdCosts& costs_;
    double lower_, upper_, wall_area_, perimeter_, traversal_;
};

}  // namespace

void sweep(std::span<const KdEvent> events, int axis, const Box& cell, size_t piece_count,
           const KdCosts& costs, KdBestSplit& best) {
    const PlaneCost cost(axis, cell, costs);
    const float lower = cell.lower[axis], upper = cell.upper[axis];
    size_t left_count = 0, right_count = piece_count;
    for (size_t i = 0; i < events.size();) {
        const KdEvent& first = events[i];
        size_t kinds[3] = {0, 0, 0};
        for (; i < events.size() && events[i].is_at_plane_of(first); ++i)
            ++kinds[static_cast<size_t>(events[i].kind())];
        const auto [ended, planar, started] = kinds;
        right_count -= ended + planar;
        const float plane = first.plane();
        if (lower < plane && plane < upper) {
            const double planar_left = cost(double(plane), left_count + planar, right_count);
            if (planar_left < best.cost) best = {planar_left, {axis, plane, true}};
            if (planar > 0) {
                const double planar_right = cost(double(plane), left_count, right_count + planar);
                if (planar_right < best.cost) best = {planar_right, {axis, plane, false}};
            }
        }
        left_count += started + planar;
    }
}

}  // namespace boxwood
