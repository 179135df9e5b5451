#include "core/wide_bvh/morton_part.h"

namespace boxwood {

namespace {

/// Writes the shape; returns the number of leaves.
class ShapeWriter {
public:
    ShapeWriter(const MortonOrder& order, RefRange range, uint8_t* shape)
        : splits_(order, range), shape_(shape) {}

    uint32_t write(RefRange range, uint32_t depth) {
        write_node(range, depth, splits_.of_all());
        return leaf_count_;
    }

private:
    void write_node(RefRange range, uint32_t depth, uint32_t split) {
        if (range.count() <= Pack8::kSize) {
            *shape_++ = static_cast<uint8_t>(range.count());
            ++leaf_count_;
            return;
        }
        *shape_++ = 0;
        const MortonDivision at = splits_.divide(range, depth, split);
        write_node({range.begin, at.mid}, depth + 1, at.left_split);
        write_node({at.mid, range.end}, depth + 1, at.right_split);
    }

    const MortonPartSplits splits_;
    uint8_t* shape_;
    uint32_t leaf_count_ = 0;
};

/// Builds the tree along its shape.
class ShapeReader {
public:
    ShapeReader(const MortonOrder& order, uint32_t first, const uint8_t* shape, const PackFiller& filler,
                Pack8* packs, PartTree& tree)
        : order_(order), filler_(filler), tree_(tree), shape_(shape), packs_(packs), next_(first) {}

    void build_node(uint32_t node, PartRoot& result) {
        const uint32_t count = *shape_++;
        if (count != 0) return make_leaf(node, count, result);
        const uint32_t left = tree_.add_children();
        PartRoot right;
        build_node(left, result);
        build_node(left + 1, right);
        result.box.extend(right.box.lower, right.box.upper);
        result.costs = tree_.set_inner(node, result.box, left, result.costs, right.costs);
    }

private:
    void make_leaf(uint32_t node, uint32_t count, PartRoot& result) {
        constexpr size_t kAhead = 40, kCornersAhead = 20;
        PackPrims prims;
        for (uint32_t i = 0; i < Pack8::kSize; ++i) {
            prims[i] = order_.ref(next_);
            if (i + 1 >= count) continue;
            ++next_;
        }
        ++next_;
        for (size_t i = next_; i < next_ + count; ++i) {
            if (i + kAhead < order_.keys.size()) filler_.prefetch(order_.ref(i + kAhead));
            if (i + kCornersAhead < order_.keys.size())
                filler_.prefetch_corners(order_.ref(i + kCornersAhead));
        }
        result.box = filler_.fill(prims, packs_[pack_]);
        result.costs = tree_.set_leaf(node, result.box, pack_++);
    }

    const MortonOrder& order_;
    const PackFiller& filler_;
    PartTree& tree_;
    const uint8_t* shape_;
    Pack8* packs_;
    uint32_t next_;  ///< in the order
    uint32_t pack_ = 0;
};

}  // namespace

MortonPart::MortonPart(const MortonOrder& order, RefRange range, uint32_t depth, std::span<uint8_t> shape)
    : order_(order),
      range_(range),
      shape_(shape.data()),
      pack_count_(ShapeWriter(order, range, shape.data()).write(range, depth)) {}

PartRoot MortonPart::build(const PackFiller& filler, std::span<Pack8> packs, PartTree& tree) const {
    PartRoot root;
    tree.clear();
    ShapeReader(order_, range_.begin, shape_, filler, packs.data(), tree).build_node(0, root);
    return root;
}

}  // namespace boxwood
