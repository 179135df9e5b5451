#include "core/wide_bvh/part_top.h"

#include <algorithm>

#include "core/bvh/split_ref.h"

namespace boxwood {

namespace {

PartRoot add_piece(PartTree& tree, uint32_t node, std::span<const WidePiece> pieces, uint32_t piece) {
    const Box4& box = pieces[piece].box;
    return {box, tree.set_part(node, box, piece, pieces[piece].cost)};
}

PartRoot join(PartTree& tree, uint32_t node, uint32_t left, PartRoot a, const PartRoot& b) {
    a.box.extend(b.box.lower, b.box.upper);
    return {a.box, tree.set_inner(node, a.box, left, a.costs, b.costs)};
}

/// Follows the top nodes.
class TopOfNodes {
public:
    TopOfNodes(std::span<const TopNode> top, std::span<const WidePiece> pieces, PartTree& tree)
        : top_(top), pieces_(pieces), tree_(tree), piece_of_(top.size()) {
        uint32_t piece = 0;
        for (size_t i = 0; i < top.size(); ++i)
            if (top[i].is_part()) piece_of_[i] = piece++;
    }
    PartRoot build(uint32_t node, uint32_t from) {
        if (top_[from].is_part()) return add_piece(tree_, node, pieces_, piece_of_[from]);
        const uint32_t left = tree_.add_children();
        const PartRoot a = build(left, top_[from].left);
        return join(tree_, node, left, a, build(left + 1, top_[from].left + 1));
    }

private:
    std::span<const TopNode> top_;
    std::span<const WidePiece> pieces_;
    PartTree& tree_;
    std::vector<uint32_t> piece_of_;
};

/// Divides sets of pieces by surface area cost.
class TopByCost {
public:
    TopByCost(std::span<const WidePiece> pieces, PartTree& tree)
        : pieces_(pieces), tree_(tree), right_costs_(pieces.size()) {
        for (uint32_t i = 0; i < pieces.size(); ++i) set_.push_back(i);
    }
    PartRoot build(uint32_t node, RefRange range, uint32_t depth) {
        if (range.count() == 1) return add_piece(tree_, node, pieces_, set_[range.begin]);
        const uint32_t mid = divide(range, depth), left = tree_.add_children();
        const PartRoot a = build(left, {range.begin, mid}, depth + 1);
        return join(tree_, node, left, a, build(left + 1, {mid, range.end}, depth + 1));
    }

private:
    std::span<uint32_t> set_of(RefRange range) { return std::span(set_).subspan(range.begin, range.count()); }
    void sort(std::span<uint32_t> set, int axis) const {
        const auto key = [&](uint32_t i) {
            return half_center4(pieces_[i].box.lower, pieces_[i].box.upper)[axis];
        };
        std::ranges::sort(
            set, [&](uint32_t a, uint32_t b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
    }
    /// Sorts the set for the division, and returns where the right side begins.
    uint32_t divide(RefRange range, uint32_t depth) {
        const std::span<uint32_t> set = set_of(range);
        uint32_t best_left = range.count() / 2;
        if (depth + static_cast<uint32_t>(std::bit_width(range.count())) >= kMostTopDepth)
            return range.begin + best_left;
        double best_cost = std::numeric_limits<double>::infinity();
        int best_axis = 0;
        for (int axis = 0; axis < 3; ++axis) {
            sort(set, axis);
            Sweep right;
            for (size_t i = set.size(); i-- > 1;) right_costs_[i] = right.add(pieces_[set[i]]);
            Sweep left;
            for (size_t i = 1; i < set.size(); ++i) {
                const double cost = left.add(pieces_[set[i - 1]]) + right_costs_[i];
                if (!(cost < best_cost)) continue;
                best_cost = cost;
                best_axis = axis;
                best_left = static_cast<uint32_t>(i);
            }
        }
        if (best_axis != 2) sort(set, best_axis);
        return range.begin + best_left;
    }
    struct Sweep {
        Box4 box = empty_box4();
        double count = 0.0;

        double add(const WidePiece& piece) {
            box.extend(piece.box.lower, piece.box.upper);
            count += piece.pack_count;
            return count * half_area(box);
        }
    };

    std::span<const WidePiece> pieces_;
    PartTree& tree_;
    std::vector<uint32_t> set_;
    std::vector<double> right_costs_;
};

}  // namespace

PartTree top_of_nodes(std::span<const TopNode> top, std::span<const WidePiece> pieces,
                      const PartCosts& costs) {
    PartTree tree(costs, static_cast<uint32_t>(pieces.size()));
    TopOfNodes(top, pieces, tree).build(0, 0);
    return tree;
}

PartTree top_by_cost(std::span<const WidePiece> pieces, const PartCosts& costs) {
    PartTree tree(costs, static_cast<uint32_t>(pieces.size()));
    TopByCost(pieces, tree).build(0, {0, static_cast<uint32_t>(pieces.size())}, 0);
    return tree;
}

}  // namespace boxwood
