#include "core/bvh/linked_tree.h"

#include <array>

#include "core/base/assert.h"
#include "core/base/parallel.h"
#include "core/bvh/split_ref.h"

namespace boxwood {

namespace {

constexpr int kMostVisits = 4096;  ///< of one search: bounds its time for every input
constexpr size_t kNodeGrain = 1 << 14;

Box4 join(Box4 a, const Box4& b) {
    a.extend(b.lower, b.upper);
    return a;
}

}  // namespace

LinkedTree::LinkedTree(const Bvh2& bvh) : nodes_(bvh.nodes.size()), links_(bvh.nodes.size()) {
    if (nodes_.empty()) return;
    parallel_for(nodes_.size(), kNodeGrain, [&](size_t begin, size_t end) {
        for (auto i = static_cast<uint32_t>(begin); i < end; ++i) {
            const Bvh2::Node& node = bvh.nodes[i];
            nodes_[i] = {node.lower, kNoIndex, node.upper, kNoIndex};
            links_[i].height = 0;
            if (node.is_leaf()) continue;
            nodes_[i].left = node.first;
            nodes_[i].right = node.first + 1;
            links_[node.first].parent = links_[node.first + 1].parent = i;
        }
    });
    links_[0].parent = kNoIndex;
    for (auto i = static_cast<uint32_t>(nodes_.size()); i-- > 0;)  // children after their parents
        if (!is_leaf(i))
            links_[i].height = 1 + std::max(links_[nodes_[i].left].height, links_[nodes_[i].right].height);
}

Box4 LinkedTree::box(uint32_t node) const {
    static_assert(sizeof(Node) == sizeof(SplitRef));
    Box4 result;
    std::memcpy(&result.lower, reinterpret_cast<const char*>(&nodes_[node]), sizeof result.lower);
    std::memcpy(&result.upper, reinterpret_cast<const char*>(&nodes_[node]) + sizeof result.lower,
                sizeof result.upper);
    return result;
}

double LinkedTree::half_area(uint32_t node) const { return boxwood::half_area(box(node)); }

double LinkedTree::inefficiency(uint32_t node) const {
    const double area = half_area(node), parent_area = half_area(links_[node].parent);
    return parent_area > area ? (parent_area - area) * (parent_area / area) : 0.0;
}

/// Meister, Bittner 2018, section 3.1: the tree is searched from the node's parent upwards, on each level the
/// subtree beside the path downwards. `saved` is what taking the node out saves, less what putting it below
/// costs on the way down to a place.
std::optional<LinkedTree::Move> LinkedTree::best_move(uint32_t node) const {
    struct Place {
        double saved;
        uint32_t node;
    };
    std::array<Place, Bvh2::kMaxDepth + 2> stack;
    const Box4 moved = box(node);
    const double moved_area = boxwood::half_area(moved);
    const uint32_t parent = links_[node].parent;
    uint32_t beside = sibling(node), pivot = parent;
    Box4 left_over = box(beside);  // the pivot's box without the node
    double saved = half_area(parent);
    Move best = {0.0, node, kNoIndex};
    int visits = 0;
    while (true) {
        uint32_t size = 0;
        stack[size++] = {saved, beside};
        while (size > 0 && visits < kMostVisits) {
            const Place place = stack[--size];
            if (place.saved - moved_area <= best.gain) continue;
            ++visits;
            const Box4 to = box(place.node);
            const double rest = place.saved - boxwood::half_area(join(to, moved));
            if (rest > best.gain) {
                best.gain = rest;
                best.to = place.node;
            }
            if (is_leaf(place.node)) continue;
            const double saved_below = rest + boxwood::half_area(to);
            BOXWOOD_ASSERT(size + 2 <= stack.size());
            stack[size++] = {saved_below, nodes_[place.node].left};
            stack[size++] = {saved_below, nodes_[place.node].right};
        }
        if (pivot != parent) {
            left_over = join(left_over, box(beside));
            saved += half_area(pivot) - boxwood::half_area(left_over);
        }
        if (links_[pivot].parent == kNoIndex || visits >= kMostVisits) break;
        beside = sibling(pivot);
        pivot = links_[pivot].parent;
    }
    if (best.to == kNoIndex || best.to == sibling(node)) return std::nullopt;
    return best;
}

std::optional<double> LinkedTree::gain(uint32_t node, uint32_t to) const {
    if (!is_movable(node)) return std::nullopt;
    const uint32_t parent = links_[node].parent;
    if (to == node || to == parent || to == sibling(node) || to == 0) return std::nullopt;
    // The node's ancestors, from its parent to the root.
    std::array<uint32_t, Bvh2::kMaxDepth + 1> path;
    uint32_t length = 0;
    for (uint32_t i = parent; i != kNoIndex; i = links_[i].parent) path[length++] = i;
    // Those of its new place.
    std::array<uint32_t, Bvh2::kMaxDepth + 1> new_path;
    uint32_t new_length = 0;
    for (uint32_t i = to; i != kNoIndex; i = links_[i].parent) {
        if (i == node) return std::nullopt;
        new_path[new_length++] = i;
    }
    // Nodes that both have above them; the lowest one gets no other box.
    uint32_t common = 0;
    while (common < std::min(length, new_length) &&
           path[length - 1 - common] == new_path[new_length - 1 - common])
        ++common;
    const uint32_t lost_levels = common == length ? 1 : 0;  // `to` is below the sibling, which rises
    const uint32_t depth = new_length - lost_levels;        // of node and `to`, below their new parent
    if (depth + std::max(links_[node].height, links_[to].height) > Bvh2::kMaxDepth) return std::nullopt;

    const Box4 moved = box(node);
    double fall = half_area(parent) - boxwood::half_area(join(box(to), moved));
    // Nodes that get the node below them.
    for (uint32_t i = 1; i + common < new_length; ++i) {
        const Box4 old = box(new_path[i]);
        fall += boxwood::half_area(old) - boxwood::half_area(join(old, moved));
    }
    // Nodes that lose it; `to` too where it is one of them.
    const uint32_t end = length - common + (common == new_length ? 1 : 0);
    Box4 left_over = box(sibling(node));
    for (uint32_t i = 1; i < end; ++i) {
        left_over = join(left_over, box(sibling(path[i - 1])));
        fall += half_area(path[i]) - boxwood::half_area(left_over);
    }
    return fall;
}

void LinkedTree::replace_child(uint32_t parent, uint32_t from, uint32_t to) {
    (nodes_[parent].left == from ? nodes_[parent].left : nodes_[parent].right) = to;
    links_[to].parent = parent;
}

void LinkedTree::refit_upwards(uint32_t node) {
    for (; node != kNoIndex; node = links_[node].parent) {
        const uint32_t left = nodes_[node].left, right = nodes_[node].right;
        const Box joined = join(box(left), box(right)).box();
        nodes_[node].lower = joined.lower;
        nodes_[node].upper = joined.upper;
        links_[node].height = 1 + std::max(links_[left].height, links_[right].height);
    }
}

/// The parent goes with the node: the sibling takes the parent's place, and the parent that of `to`.
void LinkedTree::move(uint32_t node, uint32_t to) {
    const uint32_t parent = links_[node].parent, grandparent = links_[parent].parent;
    replace_child(grandparent, parent, sibling(node));
    replace_child(links_[to].parent, to, parent);
    nodes_[parent].left = to;
    nodes_[parent].right = node;
    links_[to].parent = links_[node].parent = parent;
    refit_upwards(parent);
    refit_upwards(grandparent);
}

Bvh2 LinkedTree::bvh(const Bvh2& source) const {
    Bvh2 result;
    if (nodes_.empty()) return result;
    result.nodes.reserve(nodes_.size());
    result.prims.reserve(source.prims.size());
    struct Pending {
        uint32_t from, at;
    };
    std::vector<Pending> stack{{0, 0}};
    result.nodes.resize(1);
    while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        const Node& node = nodes_[pending.from];
        if (is_leaf(pending.from)) {
            const Bvh2::Node& leaf = source.nodes[pending.from];
            const auto first = static_cast<uint32_t>(result.prims.size());
            result.nodes[pending.at] = {node.lower, first, node.upper, leaf.count};
            result.prims.insert(result.prims.end(), source.prims.begin() + leaf.first,
                                source.prims.begin() + leaf.first + leaf.count);
            continue;
        }
        const auto left = static_cast<uint32_t>(result.nodes.size());
        result.nodes[pending.at] = {node.lower, left, node.upper, 0};
        result.nodes.resize(left + 2);
        stack.push_back({node.right, left + 1});
        stack.push_back({node.left, left});
    }
    return result;
}

}  // namespace boxwood
