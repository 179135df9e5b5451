#include "core/bvh/optimize.h"

#include <algorithm>
#include <bit>
#include <functional>

#include "core/base/parallel.h"
#include "core/bvh/linked_tree.h"

namespace boxwood {

namespace {

constexpr size_t kSearchBlock = 256;   ///< searches that one thread does at a time
constexpr size_t kKeyBlock = 1 << 14;  ///< nodes that one thread looks at at a time

/// Sum of the half areas of inner nodes: all of the SAH cost that moves change.
double inner_area(const Bvh2& bvh) {
    double sum = 0.0;
    for (const Bvh2::Node& node : bvh.nodes)
        if (!node.is_leaf()) sum += node.half_area();
    return sum;
}

/// The movable nodes that are the most promising, a share of all; of equally promising ones the lower ones.
/// In ascending order: nodes that are searched for one after the other are near to each other.
Array<uint32_t> promising_nodes(const LinkedTree& tree, uint32_t node_count, double share) {
    // 0: not movable. The bits of numbers that are not negative have their order.
    Array<uint64_t> keys(node_count), movable;
    parallel_for(node_count, kKeyBlock, [&](size_t begin, size_t end) {
        for (auto node = static_cast<uint32_t>(begin); node < end; ++node) {
            const bool is_movable = tree.is_movable(node);
            keys[node] = is_movable ? std::bit_cast<uint64_t>(tree.inefficiency(node)) + 1 : 0;
        }
    });
    movable.reserve(node_count);
    for (const uint64_t key : keys)
        if (key != 0) movable.push_back(key);
    const auto wanted = static_cast<size_t>(std::ceil(share * static_cast<double>(movable.size())));
    const size_t count = std::min(wanted, movable.size());
    if (count == 0) return {};
    const auto last = movable.begin() + static_cast<std::ptrdiff_t>(count - 1);
    std::nth_element(movable.begin(), last, movable.end(), std::greater<>());
    const uint64_t least = *last;
    auto equal = static_cast<size_t>(std::count(movable.begin(), last + 1, least));  // that are wanted
    Array<uint32_t> nodes;
    nodes.reserve(count);
    for (uint32_t node = 0; node < node_count; ++node) {
        if (keys[node] < least || (keys[node] == least && equal == 0)) continue;
        if (keys[node] == least) --equal;
        nodes.push_back(node);
    }
    return nodes;
}

std::vector<LinkedTree::Move> find_moves(const LinkedTree& tree, std::span<const uint32_t> nodes,
                                         Task& task) {
    std::vector<std::optional<LinkedTree::Move>> found(nodes.size());
    parallel_for(nodes.size(), kSearchBlock, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !task.stopped(); ++i) found[i] = tree.best_move(nodes[i]);
        task.done += end - begin;
    });
    std::vector<LinkedTree::Move> moves;
    for (const auto& move : found)
        if (move) moves.push_back(*move);
    std::ranges::sort(moves, [](const LinkedTree::Move& a, const LinkedTree::Move& b) {
        return a.gain > b.gain || (a.gain == b.gain && a.node < b.node);
    });
    return moves;
}

}  // namespace

void Optimize::describe(ParamVisitor& v) {
    v.on_int("rounds", rounds, 1, 64, "times that nodes are taken out and put back, at most");
    v.on_float("share", share, 0.001f, 1.0f, "of the nodes that a round tries, the most promising ones");
    v.on_float("least-gain", least_gain, 0.0f, 1.0f,
               "a round that gains less of the inner nodes' area is the last");
}

Bvh2 Optimize::apply(const Mesh&, std::span<const PrimRef>, const Bvh2& input, Task& task) const {
    LinkedTree tree(input);
    const auto node_count = static_cast<uint32_t>(input.nodes.size());
    const double before = inner_area(input);
    // Far below what is worth a move, far above what sums of areas round by.
    const double rounding = before * 1e-12;
    uint64_t move_count = 0, in_best_place = 0, overtaken = 0;
    task.total = static_cast<uint64_t>(double(share) * node_count) * static_cast<uint64_t>(rounds);
    for (int round = 0; round < rounds; ++round) {
        const Array<uint32_t> nodes = promising_nodes(tree, node_count, double(share));
        const std::vector<LinkedTree::Move> moves = find_moves(tree, nodes, task);
        if (task.stopped()) return {};
        in_best_place += nodes.size() - moves.size();
        uint64_t made = 0;
        double gained = 0.0;
        for (const LinkedTree::Move& move : moves) {
            const std::optional<double> gain = tree.gain(move.node, move.to);
            if (gain && *gain > rounding) {
                tree.move(move.node, move.to);
                gained += *gain;
                ++made;
            }
        }
        overtaken += moves.size() - made;
        move_count += made;
        if (gained <= static_cast<double>(least_gain) * before) break;
    }
    task.skipped.add("in the best place", in_best_place);
    task.skipped.add("overtaken by other moves", overtaken);
    if (move_count == 0) return input;
    Bvh2 result = tree.bvh(input);
    return inner_area(result) < before ? result : input;
}

}  // namespace boxwood
