#include "core/kdtree/kd_sah.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/kdtree/kd_events.h"

namespace boxwood {

namespace {

constexpr size_t kSerialPieces = 4096;  ///< smaller nodes are built by one thread

/// A node before its plane is chosen.
struct Work {
    std::vector<PrimRef> pieces;
    KdEvents events;
    Box cell;
    uint32_t depth = 0;
    RefBudget budget{};
};

/// A piece's places in its node's children; kNoIndex where it is absent or has been cut.
struct Places {
    uint32_t left = kNoIndex, right = kNoIndex;
};

class SahBuild {
public:
    SahBuild(const KdSah& params, const Mesh& mesh, uint32_t max_depth, const Task& task)
        : params_(params), mesh_(mesh), max_depth_(max_depth), task_(task) {
        costs_ = {double(params.traversal_cost), double(params.empty_bonus)};
    }

    void build_node(Work work, KdOutput& output) const {
        const std::optional<KdSplit> split = choose(work);
        Work left, right;
        if (!split || !divide(work, *split, left, right)) return output.add_leaf(work.pieces);
        const bool is_large = work.pieces.size() > kSerialPieces;
        work = {};  // so that pieces and events of one node on each path are kept alone
        const uint32_t inner = output.add_inner(*split);
        if (is_large) {
            KdOutput left_output, right_output;
            parallel_invoke([&] { build_node(std::move(left), left_output); },
                            [&] { build_node(std::move(right), right_output); });
            output.append(left_output);
            output.begin_right(inner);
            output.append(right_output);
        } else {
            build_node(std::move(left), output);
            output.begin_right(inner);
            build_node(std::move(right), output);
        }
    }

    /// Sorts the events of the root.
    void sort_events(Work& root) const {
        for_each_axis(root, [&](size_t axis) {
            std::vector<KdEvent>& events = root.events[axis];
            events.reserve(2 * root.pieces.size());
            for (uint32_t i = 0; i < root.pieces.size(); ++i)
                add_events(root.pieces[i].bounds, i, static_cast<int>(axis), events);
            std::sort(events.begin(), events.end());
        });
    }

private:
    bool must_be_leaf(size_t piece_count, uint32_t depth) const {
        return piece_count <= static_cast<size_t>(params_.leaf_size) || depth >= max_depth_;
    }

    /// In parallel where the node is large.
    template <class Body>
    static void for_each_axis(const Work& work, const Body& body) {
        const size_t grain = work.pieces.size() > kSerialPieces ? 1 : 3;
        const auto on_range = [&](size_t begin, size_t end) {
            for (size_t axis = begin; axis < end; ++axis) body(axis);
        };
        if (grain == 3) {
            on_range(0, 3);
        } else {
            parallel_for(3, grain, on_range);
        }
    }

    /// The cheapest split; nothing where a leaf is cheaper.
    std::optional<KdSplit> choose(const Work& work) const {
        if (must_be_leaf(work.pieces.size(), work.depth) || task_.stopped()) return std::nullopt;
        std::array<KdBestSplit, 3> best;
        for_each_axis(work, [&](size_t axis) {
            sweep(work.events[axis], static_cast<int>(axis), work.cell, work.pieces.size(), costs_,
                  best[axis]);
        });
        const KdBestSplit& cheapest =
            *std::min_element(best.begin(), best.end(),
                              [](const KdBestSplit& a, const KdBestSplit& b) { return a.cost < b.cost; });
        const double leaf = leaf_cost(work.pieces.size()) * work.cell.half_area();
        if (!(cheapest.cost < leaf)) return std::nullopt;
        return cheapest.split;
    }

    /// False, with the children left as they are, where the budget does not allow them.
    bool divide(const Work& work, const KdSplit& split, Work& left, Work& right) const {
        std::vector<Places> places(work.pieces.size());
        std::vector<uint32_t> left_cut, right_cut;  // places of new boxes
        divide_pieces(work, split, places, left, right, left_cut, right_cut);
        const size_t left_count = left.pieces.size(), right_count = right.pieces.size();
        if (!work.budget.allows(left_count, right_count)) return false;
        left.budget = work.budget.left_share(left_count, right_count);
        right.budget = {work.budget.refs - left.budget.refs};
        left.depth = right.depth = work.depth + 1;
        left.cell = right.cell = work.cell;
        left.cell.upper[split.axis] = right.cell.lower[split.axis] = split.plane;
        const bool needs_left = !must_be_leaf(left_count, left.depth);
        const bool needs_right = !must_be_leaf(right_count, right.depth);
        for_each_axis(work, [&](size_t axis) {
            if (needs_left) divide_events(work, axis, places, &Places::left, left_cut, left);
            if (needs_right) divide_events(work, axis, places, &Places::right, right_cut, right);
        });
        return true;
    }

    void divide_pieces(const Work& work, const KdSplit& split, std::vector<Places>& places, Work& left,
                       Work& right, std::vector<uint32_t>& left_cut, std::vector<uint32_t>& right_cut) const {
        const auto add = [](Work& child, const PrimRef& piece) {
            child.pieces.push_back(piece);
            return static_cast<uint32_t>(child.pieces.size() - 1);
        };
        for (size_t i = 0; i < work.pieces.size(); ++i) {
            if (i % 1024 == 0 && task_.stopped()) return;
            const PrimRef& piece = work.pieces[i];
            switch (side_of(piece.bounds, split)) {
                case KdSide::Left:
                    places[i].left = add(left, piece);
                    break;
                case KdSide::Right:
                    places[i].right = add(right, piece);
                    break;
                case KdSide::Both:
                    const KdParts parts = cut_piece(mesh_, piece, split, params_.clip);
                    if (!parts.left.is_empty()) left_cut.push_back(add(left, {parts.left, piece.prim}));
                    if (!parts.right.is_empty()) right_cut.push_back(add(right, {parts.right, piece.prim}));
                    break;
            }
        }
    }

    /// The events of one child on one axis: those of its uncut pieces, which are in order, merged with those
    /// of the cut ones. Places in the child ascend with those in the node, so that the order of the old ones
    /// stays.
    static void divide_events(const Work& work, size_t axis, const std::vector<Places>& places,
                              uint32_t Places::*place, const std::vector<uint32_t>& cut, Work& child) {
        std::vector<KdEvent> cut_events;
        cut_events.reserve(2 * cut.size());
        for (const uint32_t i : cut)
            add_events(child.pieces[i].bounds, i, static_cast<int>(axis), cut_events);
        std::sort(cut_events.begin(), cut_events.end());
        std::vector<KdEvent>& events = child.events[axis];
        events.reserve(2 * child.pieces.size());
        auto next_cut = cut_events.begin();
        for (const KdEvent& event : work.events[axis]) {
            const uint32_t i = places[event.piece()].*place;
            if (i == kNoIndex) continue;
            const KdEvent moved = event.at(i);
            while (next_cut != cut_events.end() && *next_cut < moved) events.push_back(*next_cut++);
            events.push_back(moved);
        }
        events.insert(events.end(), next_cut, cut_events.end());
    }

    const KdSah& params_;
    const Mesh& mesh_;
    uint32_t max_depth_;
    const Task& task_;
    KdCosts costs_;
};

}  // namespace

KdTree KdSah::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    BOXWOOD_ASSERT(refs.size() <= KdTree::kMaxCount);
    const KdLimits limits{.max_depth = static_cast<uint32_t>(max_depth)};
    const SahBuild build(*this, mesh, limits.depth_for(refs.size()), task);
    Work root;
    root.pieces.assign(refs.begin(), refs.end());
    root.cell = bounds_of_refs(refs);
    root.budget = {uint64_t(budget) * refs.size()};
    build.sort_events(root);
    KdOutput output;
    const Box bounds = root.cell;
    build.build_node(std::move(root), output);
    if (task.stopped()) return {};
    return output.finish(bounds);
}

}  // namespace boxwood
