#include "core/wide_bvh/wide_pieces.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/wide_bvh/child_order.h"

namespace boxwood {

namespace {

using Node = WideBvh<16>::Node;

/// A node with the boxes of its children, in the order of their lanes; the other lanes are empty.
void set_boxes(const PartTree& tree, const WideParts<16>& parts, Node& node) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::fill(node.lower[axis], kInfinity);
        std::ranges::fill(node.upper[axis], -kInfinity);
    }
    for (uint32_t lane = 0; lane < parts.count; ++lane) {
        const Bvh2::Node& source = tree.node(parts.parts[lane].node);
        for (int axis = 0; axis < 3; ++axis) {
            node.lower[axis][lane] = source.lower[axis];
            node.upper[axis][lane] = source.upper[axis];
        }
    }
    std::ranges::fill(node.children, WideChild{});
}

/// Where a piece stands in the whole hierarchy.
struct Place {
    uint32_t node, leaf, pack;
};

/// Numbers the nodes of the top and the places of the pieces, depth first.
class TopWriter {
public:
    TopWriter(const PartTree& top, std::span<const WidePiece> pieces)
        : top_(top), pieces_(pieces), places_(pieces.size()) {
        const Bvh2::Node& root = top.node(0);
        if (root.is_leaf() && !pieces[root.first].is_leaf()) {
            put(root.first);
        } else {
            add_node(0);
        }
    }

    struct Numbered {
        uint32_t index;
        Node node;
    };
    const std::vector<Numbered>& nodes() const { return nodes_; }
    const Place& place(size_t piece) const { return places_[piece]; }
    const Place& end() const { return next_; }

private:
    WideChild put(uint32_t piece) {
        const WidePiece& put = pieces_[piece];
        const Place at = places_[piece] = next_;
        next_.node += static_cast<uint32_t>(put.nodes.size());
        next_.pack += put.pack_count;
        if (put.is_leaf()) return WideChild::leaf(at.pack, put.pack_count);
        next_.leaf += put.leaf_count;
        return WideChild::inner(at.node);
    }

    WideChild add_node(uint32_t root) {
        const WideParts<16> parts = top_.children_of(root);
        const uint32_t index = next_.node++;
        const size_t slot = nodes_.size();
        nodes_.push_back({index, {}});
        Node node;
        set_boxes(top_, parts, node);
        node.first_leaf = next_.leaf;
        for (uint32_t lane = 0; lane < parts.count; ++lane) {
            const WidePart part = parts.parts[lane];
            if (part.is_leaf && pieces_[top_.node(part.node).first].is_leaf()) ++next_.leaf;
        }
        for (uint32_t lane = 0; lane < parts.count; ++lane) {
            const WidePart part = parts.parts[lane];
            node.children[lane] = part.is_leaf ? put(top_.node(part.node).first) : add_node(part.node);
        }
        set_order<16>(node);
        nodes_[slot].node = node;
        return WideChild::inner(index);
    }

    const PartTree& top_;
    std::span<const WidePiece> pieces_;
    std::vector<Place> places_;
    std::vector<Numbered> nodes_;
    Place next_{0, 0, 0};
};

/// Copies a piece's nodes to where they are to stand.
void copy_nodes(const WidePiece& piece, const Place& place, std::span<Node> to) {
    for (size_t i = 0; i < piece.nodes.size(); ++i) {
        to[i] = piece.nodes[i];
        to[i].first_leaf += place.leaf;
        for (WideChild& child : to[i].children)
            if (!child.is_empty()) child.bits += child.is_leaf() ? place.pack : place.node;
    }
}

}  // namespace

std::span<Node> PieceNodes::take(size_t least) {
    constexpr size_t kAtOnce = (size_t{8} << 20) / sizeof(Node);
    const std::scoped_lock lock(mutex_);
    return arrays_.emplace_back(std::max(least, std::min(kAtOnce, most_)));
}

WidePiece PieceWriter::write(const PartTree& tree, const PartRoot& root, uint32_t pack_count) {
    WidePiece piece;
    piece.pack_count = pack_count;
    piece.box = root.box;
    piece.cost = root.costs.costs.least[0];
    if (tree.is_leaf(0)) {
        piece.leaf_count = 1;
        return piece;
    }
    // A node has two children or more, so that there are fewer nodes than leaves.
    if (room_.size() < pack_count) room_ = memory_.take(pack_count);
    node_count_ = 0;
    add_node(tree, 0, piece);
    piece.nodes = room_.first(node_count_);
    room_ = room_.subspan(node_count_);
    return piece;
}

/// Adds the node that stands for a subtree, and all below it; its number.
uint32_t PieceWriter::add_node(const PartTree& tree, uint32_t root, WidePiece& piece) {
    const WideParts<16> parts = tree.children_of(root);
    const uint32_t index = node_count_++;
    Node& node = room_[index];
    set_boxes(tree, parts, node);
    node.first_leaf = piece.leaf_count;
    for (uint32_t lane = 0; lane < parts.count; ++lane) {
        const WidePart part = parts.parts[lane];
        node.children[lane] = part.is_leaf ? tree.leaf(part.node) : WideChild::inner(0);
        if (part.is_leaf) ++piece.leaf_count;
    }
    set_order<16>(node);
    for (uint32_t lane = 0; lane < parts.count; ++lane) {
        const WidePart part = parts.parts[lane];
        if (!part.is_leaf) node.children[lane] = WideChild::inner(add_node(tree, part.node, piece));
    }
    return index;
}

JoinedPieces join_pieces(const PartTree& top, std::span<const WidePiece> pieces) {
    const TopWriter writer(top, pieces);
    JoinedPieces joined;
    WideBvh<16>& bvh = joined.bvh;
    bvh.leaf_count = writer.end().leaf;
    bvh.nodes.resize(writer.end().node);
    joined.pack_count = writer.end().pack;
    for (const TopWriter::Numbered& numbered : writer.nodes()) bvh.nodes[numbered.index] = numbered.node;
    parallel_for(pieces.size(), 4, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const std::span<Node> to(bvh.nodes);
            copy_nodes(pieces[i], writer.place(i), to.subspan(writer.place(i).node, pieces[i].nodes.size()));
        }
    });
    for (size_t i = 0; i < pieces.size(); ++i) joined.first_packs.push_back(writer.place(i).pack);
    return joined;
}

}  // namespace boxwood
