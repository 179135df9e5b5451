#include "core/bvh/sweep_subtree.h"

#include <algorithm>
#include <bit>

#include "core/bvh/top_down.h"

namespace boxwood {

namespace {

float half_center(const SplitRef& ref, int axis) { return 0.25f * ref.lower[axis] + 0.25f * ref.upper[axis]; }

/// A float as an integer with the same order; -0 before 0.
uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<uint32_t>(value);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

}  // namespace

uint64_t left_budget(uint64_t most_refs, uint32_t left_count, const Box4& left, uint32_t right_count,
                     const Box4& right) {
    const uint64_t spare = most_refs - left_count - right_count;
    const double left_weight = left_count * half_area(left), right_weight = right_count * half_area(right);
    const double weight = left_weight + right_weight;
    const double share = weight > 0.0 ? left_weight / weight : 0.5;
    return left_count + static_cast<uint64_t>(static_cast<double>(spare) * share);
}

Subtree SweepSubtree::build(std::span<const SplitRef> refs, uint64_t most_refs, uint32_t depth) {
    const auto count = static_cast<uint32_t>(refs.size());
    refs_.assign(refs.begin(), refs.end());
    sides_.resize(count);
    order_.resize(size_t{3} * count);
    tree_ = {};
    tree_.nodes.reserve(count);
    tree_.prims.reserve(count);
    prims_.resize(count);
    for (uint32_t i = 0; i < count; ++i) prims_[i] = refs[i].prim;
    std::ranges::sort(prims_);
    may_repeat_ = std::ranges::adjacent_find(prims_) != prims_.end();
    Set set = {0, count, count, empty_box4(), most_refs};
    for (const SplitRef& ref : refs) set.box.extend(load_lower(ref), load_upper(ref));
    for (int axis = 0; axis < 3; ++axis) sort_by_center(set, axis);
    tree_.nodes.resize(1);
    build_node(0, set, depth);
    return std::move(tree_);
}

void SweepSubtree::sort_by_center(const Set& set, int axis) {
    std::vector<uint64_t> keys(set.count);
    for (uint32_t i = 0; i < set.count; ++i)
        keys[i] = uint64_t{ordered_bits(half_center(refs_[i], axis))} << 32 | i;
    std::ranges::sort(keys);
    for (uint32_t i = 0; i < set.count; ++i)
        order_[set.first + static_cast<uint32_t>(axis) * set.stride + i] = static_cast<uint32_t>(keys[i]);
}

Box4 SweepSubtree::box_of(const uint32_t* order, uint32_t count) const {
    Box4 box = empty_box4();
    for (uint32_t i = 0; i < count; ++i) box.extend(load_lower(refs_[order[i]]), load_upper(refs_[order[i]]));
    return box;
}

/// Sorted and each once in prims_.
uint32_t SweepSubtree::unique_count(const Set& set) {
    prims_.clear();
    for (uint32_t i = 0; i < set.count; ++i) prims_.push_back(refs_[order_[set.first + i]].prim);
    std::ranges::sort(prims_);
    prims_.erase(std::unique(prims_.begin(), prims_.end()), prims_.end());
    return static_cast<uint32_t>(prims_.size());
}

/// Returns its cost times its half area.
double SweepSubtree::make_leaf(uint32_t node, const Set& set) {
    const uint32_t count = unique_count(set);
    const Box box = set.box.box();
    tree_.nodes[node] = {box.lower, static_cast<uint32_t>(tree_.prims.size()), box.upper, count};
    tree_.prims.insert(tree_.prims.end(), prims_.begin(), prims_.end());
    return leaf_cost(count) * half_area(set.box);
}

/// Returns the cost of what is built times half areas.
double SweepSubtree::build_optimal(uint32_t node, const Set& set) {
    std::array<SplitRef, OptimalSubtree::kMostRefs> refs;
    for (uint32_t i = 0; i < set.count; ++i) refs[i] = refs_[order_[set.first + i]];
    return OptimalSubtree(params_, {refs.data(), set.count}).write(node, tree_);
}

/// Returns the cost of what is built times half areas: that of the cheaper of a leaf and a split, all splits
/// below taken into account.
double SweepSubtree::build_node(uint32_t node, const Set& set, uint32_t depth) {
    const double area = half_area(set.box);
    const bool fits_a_leaf = set.count <= static_cast<uint32_t>(params_.max_leaf_size);
    double cost_of_leaf = std::numeric_limits<double>::infinity();
    if (fits_a_leaf) {
        const uint32_t count = may_repeat_ ? unique_count(set) : set.count;
        cost_of_leaf = leaf_cost(count) * area;
        // However it is split: one inner node, and each reference is tested where its own box is met.
        double least = static_cast<double>(params_.traversal_cost) * area;
        for (uint32_t i = 0; i < set.count; ++i) {
            const SplitRef& ref = refs_[order_[set.first + i]];
            least += kIntersectionCost * half_area(Box4{load_lower(ref), load_upper(ref)});
        }
        if (count == 1 || cost_of_leaf <= least) return make_leaf(node, set);
    }
    if (set.count == 1 || depth == Bvh2::kMaxDepth) return make_leaf(node, set);
    if (set.count <= OptimalSubtree::kMostRefs && depth + set.count <= Bvh2::kMaxDepth)
        return build_optimal(node, set);
    const size_t node_count = tree_.nodes.size(), prim_count = tree_.prims.size();
    const size_t ref_count = refs_.size(), order_count = order_.size();
    const std::optional<Children> children = divide(set, depth);
    if (!children) return make_leaf(node, set);
    const Box box = set.box.box();
    const auto left = static_cast<uint32_t>(node_count);
    tree_.nodes[node] = {box.lower, left, box.upper, 0};
    tree_.nodes.resize(node_count + 2);
    const double left_cost = build_node(left, children->left, depth + 1);
    const double right_cost = build_node(left + 1, children->right, depth + 1);
    if (children->are_cut) {
        refs_.resize(ref_count);
        order_.resize(order_count);
    }
    const double cost = static_cast<double>(params_.traversal_cost) * area + left_cost + right_cost;
    if (cost < cost_of_leaf) return cost;
    tree_.nodes.resize(node_count);
    tree_.prims.resize(prim_count);
    return make_leaf(node, set);
}

std::optional<SweepSubtree::Children> SweepSubtree::divide(const Set& set, uint32_t depth) {
    if (must_halve(depth, set.count)) {
        if (set.count <= static_cast<uint32_t>(params_.max_leaf_size)) return std::nullopt;
        return divide_objects(set, {0.0, set.box.box().largest_axis(), set.count / 2});
    }
    const ObjectSplit split = cheapest_object_split(set);
    const uint32_t* order = &order_[set.first + static_cast<uint32_t>(split.axis) * set.stride];
    const Box4 left = box_of(order, split.left_count);
    const Box4 right = box_of(order + split.left_count, set.count - split.left_count);
    if (common_half_area(left, right) <= least_overlap_) {
        ++counts_.without_overlap;
    } else if (set.count < set.most_refs) {
        if (std::optional<Children> children = divide_space(set, split.cost)) return children;
    } else {
        ++counts_.over_budget;
    }
    return divide_objects(set, split);
}

void SweepSubtree::sweep_axis(const Set& set, int axis, ObjectSplit& best) {
    const uint32_t* order = &order_[set.first + static_cast<uint32_t>(axis) * set.stride];
    Box4 box = empty_box4();
    for (uint32_t i = set.count - 1; i > 0; --i) {
        box.extend(load_lower(refs_[order[i]]), load_upper(refs_[order[i]]));
        right_area_[i] = (set.count - i) * half_area(box);
    }
    box = empty_box4();
    const auto imbalance = [&](uint32_t left) {
        return left > set.count - left ? 2 * left - set.count : set.count - 2 * left;
    };
    for (uint32_t i = 1; i < set.count; ++i) {
        box.extend(load_lower(refs_[order[i - 1]]), load_upper(refs_[order[i - 1]]));
        const double cost = i * half_area(box) + right_area_[i];
        if (cost < best.cost || (cost == best.cost && imbalance(i) < imbalance(best.left_count)))
            best = {cost, axis, i};
    }
}

SweepSubtree::ObjectSplit SweepSubtree::cheapest_object_split(const Set& set) {
    ObjectSplit best;
    if (right_area_.size() < set.count) right_area_.resize(set.count);
    for (int axis = 0; axis < 3; ++axis) sweep_axis(set, axis, best);
    return best;
}

/// The two ranges of the orders, each side still in order.
SweepSubtree::Children SweepSubtree::divide_objects(const Set& set, const ObjectSplit& split) {
    const uint32_t* chosen = &order_[set.first + static_cast<uint32_t>(split.axis) * set.stride];
    for (uint32_t i = 0; i < set.count; ++i)
        sides_[chosen[i]] = static_cast<uint8_t>(i < split.left_count ? Side::Left : Side::Right);
    if (spare_.size() < set.count) spare_.resize(set.count);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == split.axis) continue;
        uint32_t* order = &order_[set.first + static_cast<uint32_t>(axis) * set.stride];
        uint32_t left = 0, right = 0;
        for (uint32_t i = 0; i < set.count; ++i) {
            const uint32_t ref = order[i];
            const bool is_left = sides_[ref] == static_cast<uint8_t>(Side::Left);
            order[left] = ref;
            spare_[right] = ref;
            left += is_left ? 1 : 0;
            right += is_left ? 0 : 1;
        }
        std::copy_n(spare_.begin(), right, order + left);
    }
    const uint32_t right_count = set.count - split.left_count;
    const Box4 left = box_of(chosen, split.left_count);
    const Box4 right = box_of(chosen + split.left_count, right_count);
    const uint64_t left_most = left_budget(set.most_refs, split.left_count, left, right_count, right);
    return {
        .left = {set.first, set.stride, split.left_count, left, left_most},
        .right = {set.first + split.left_count, set.stride, right_count, right, set.most_refs - left_most},
        .are_cut = false};
}

/// Nothing where no plane is cheaper than the object split, or the budget does not do.
std::optional<SweepSubtree::Children> SweepSubtree::divide_space(const Set& set, double object_cost) {
    SpatialBins bins(set.box, bins_for(params_, set.count));
    for (uint32_t i = 0; i < set.count; ++i) bins.add(refs_[order_[set.first + i]], mesh_);
    const SpatialSplit split = bins.cheapest_split();
    if (split.axis < 0 || !(split.cost < object_cost)) return std::nullopt;
    if (uint64_t{split.left_count} + split.right_count > set.most_refs) {
        ++counts_.over_budget;
        return std::nullopt;
    }
    const auto first_new = static_cast<uint32_t>(refs_.size());
    SpatialCutter cutter(mesh_, split);
    sides_.resize(first_new);
    for (uint32_t i = 0; i < set.count; ++i) {
        const uint32_t place = order_[set.first + i];
        const Side side = bins.side(refs_[place], split);
        sides_[place] = static_cast<uint8_t>(side);
        if (side != Side::Both) continue;
        const SpatialCutter::Parts parts = cutter.cut(refs_[place]);
        if (parts.has_left) {
            refs_.push_back(parts.left);
            sides_.push_back(static_cast<uint8_t>(Side::Left));
        }
        if (parts.has_right) {
            refs_.push_back(parts.right);
            sides_.push_back(static_cast<uint8_t>(Side::Right));
        }
    }
    may_repeat_ = true;
    Children children = {.left = {}, .right = {}, .are_cut = true};
    merge_side(set, children.left, Side::Left, first_new);
    merge_side(set, children.right, Side::Right, first_new);
    if (children.left.count == 0 || children.right.count == 0) {
        // Only where rounding in the bins shows parts that are none.
        order_.resize(children.left.first);
        refs_.resize(first_new);
        return std::nullopt;
    }
    Set &left = children.left, &right = children.right;
    left.most_refs = left_budget(set.most_refs, left.count, left.box, right.count, right.box);
    right.most_refs = set.most_refs - left.most_refs;
    return children;
}

/// A new set on top of the orders: the set's references on one side, and the new ones, in order.
void SweepSubtree::merge_side(const Set& set, Set& side, Side which, uint32_t first_new) {
    std::vector<uint32_t> parts;
    for (auto place = first_new; place < refs_.size(); ++place)
        if (sides_[place] == static_cast<uint8_t>(which)) parts.push_back(place);
    side.first = static_cast<uint32_t>(order_.size());
    for (int axis = 0; axis < 3; ++axis) {
        const auto is_before = [&](uint32_t a, uint32_t b) {
            const float at_a = half_center(refs_[a], axis), at_b = half_center(refs_[b], axis);
            return at_a < at_b || (at_a == at_b && a < b);
        };
        std::sort(parts.begin(), parts.end(), is_before);
        const uint32_t* order = &order_[set.first + static_cast<uint32_t>(axis) * set.stride];
        spare_.clear();
        for (uint32_t i = 0; i < set.count; ++i)
            if (sides_[order[i]] == static_cast<uint8_t>(which)) spare_.push_back(order[i]);
        const size_t begin = order_.size();
        order_.resize(begin + spare_.size() + parts.size());
        std::merge(spare_.begin(), spare_.end(), parts.begin(), parts.end(),
                   order_.begin() + static_cast<std::ptrdiff_t>(begin), is_before);
        side.count = static_cast<uint32_t>(order_.size() - begin);
    }
    side.stride = side.count;
    if (side.count > 0) side.box = box_of(&order_[side.first], side.count);
}

}  // namespace boxwood
