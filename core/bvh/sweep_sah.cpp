#include "core/bvh/sweep_sah.h"

#include <numeric>

#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

struct Split {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of count * half area of both sides
    int axis = -1;
    uint32_t left_count = 0;
};

/// The build: three orders of the references by centre, each node a range of all three.
class SweepBuild {
public:
    SweepBuild(const SweepSah& params, std::span<const PrimRef> refs, const Task& task)
        : params_(params),
          refs_(refs),
          task_(task),
          scratch_(refs.size()),
          right_cost_(refs.size()),
          is_left_(refs.size()),
          spare_(refs.size()) {
        parallel_for(3, 1, [&](size_t begin, size_t end) {
            for (size_t axis = begin; axis < end; ++axis) sort_by_center(axis);
        });
    }

    Bvh2 build() {
        if (refs_.empty()) return {};
        const auto bounds_of = [&](RefRange range) {
            Box bounds;
            for (uint32_t i = range.begin; i < range.end; ++i) bounds.extend(refs_[order_[0][i]].bounds);
            return bounds;
        };
        const auto partition = [&](RefRange range, const Box& bounds,
                                   uint32_t depth) -> std::optional<uint32_t> {
            const std::optional<Split> split = choose_split(range, bounds, depth);
            if (!split) return std::nullopt;
            reorder(range, *split);
            return split->left_count;
        };
        TopDownRecursion(scratch_, bounds_of, partition, task_)
            .build_node(0, {0, static_cast<uint32_t>(refs_.size())}, 0);
        if (task_.stopped()) return {};
        std::vector<uint32_t> prims(refs_.size());
        for (size_t i = 0; i < refs_.size(); ++i) prims[i] = refs_[order_[0][i]].prim;
        return finish(scratch_, prims);
    }

private:
    void sort_by_center(size_t axis) {
        struct Key {
            float center;
            uint32_t ref;
        };
        std::vector<Key> keys(refs_.size());
        for (uint32_t i = 0; i < keys.size(); ++i) {
            keys[i] = {half_center(refs_[i].bounds)[static_cast<int>(axis)], i};
        }
        std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
            return a.center < b.center || (a.center == b.center && a.ref < b.ref);
        });
        order_[axis].resize(keys.size());
        for (size_t i = 0; i < keys.size(); ++i) order_[axis][i] = keys[i].ref;
    }

    /// Cost of every split of the range in the order of one axis. The lecture's arrays: RSA(i) times its
    /// count is stored in one pass from the right; LSA(i) is used in the pass from the left that makes it.
    void sweep_axis(size_t axis, RefRange range, Split& best) {
        const std::vector<uint32_t>& order = order_[axis];
        Box box;
        for (uint32_t i = range.end - 1; i > range.begin; --i) {
            box.extend(refs_[order[i]].bounds);
            right_cost_[i] = (range.end - i) * box.half_area();
        }
        box = Box{};
        const auto imbalance = [&](uint32_t left) {
            return left > range.count() - left ? 2 * left - range.count() : range.count() - 2 * left;
        };
        for (uint32_t i = range.begin + 1; i < range.end; ++i) {
            box.extend(refs_[order[i - 1]].bounds);
            const uint32_t left_count = i - range.begin;
            const double cost = left_count * box.half_area() + right_cost_[i];
            if (cost < best.cost ||
                (cost == best.cost && imbalance(left_count) < imbalance(best.left_count))) {
                best = {cost, static_cast<int>(axis), left_count};
            }
        }
    }

    /// How many references go left, in the order of the axis returned; nothing where a leaf is cheaper.
    std::optional<Split> choose_split(RefRange range, const Box& bounds, uint32_t depth) {
        const bool fits_a_leaf = range.count() <= static_cast<uint32_t>(params_.max_leaf_size);
        if (must_halve(depth, range.count())) {
            if (fits_a_leaf) return std::nullopt;
            return Split{0.0, bounds.largest_axis(), range.count() / 2};
        }
        Split best;
        for (size_t axis = 0; axis < 3; ++axis) {
            if (task_.stopped()) return std::nullopt;
            sweep_axis(axis, range, best);
        }
        const double area = bounds.half_area();
        const double split_cost =
            static_cast<double>(params_.traversal_cost) * area + kIntersectionCost * best.cost;
        if (fits_a_leaf && kIntersectionCost * range.count() * area <= split_cost) return std::nullopt;
        return best;
    }

    /// Reorders the other two axes' orders so that the left references come first, each side still sorted.
    void reorder(RefRange range, const Split& split) {
        const std::vector<uint32_t>& chosen = order_[static_cast<size_t>(split.axis)];
        for (uint32_t i = range.begin; i < range.end; ++i)
            is_left_[chosen[i]] = i < range.begin + split.left_count;
        for (size_t axis = 0; axis < 3; ++axis) {
            if (static_cast<int>(axis) == split.axis) continue;
            std::vector<uint32_t>& order = order_[axis];
            uint32_t left = range.begin, right = range.begin;
            for (uint32_t i = range.begin; i < range.end; ++i) {
                if (is_left_[order[i]]) {
                    order[left++] = order[i];
                } else {
                    spare_[right++] = order[i];
                }
            }
            std::copy(spare_.begin() + range.begin, spare_.begin() + right, order.begin() + left);
        }
    }

    const SweepSah& params_;
    std::span<const PrimRef> refs_;
    const Task& task_;
    NodeScratch scratch_;
    std::vector<uint32_t> order_[3];
    std::vector<double> right_cost_;
    std::vector<uint8_t> is_left_;  ///< bytes, not bits: written by many threads
    std::vector<uint32_t> spare_;
};

}  // namespace

Bvh2 SweepSah::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    return SweepBuild(*this, refs, task).build();
}

}  // namespace boxwood
