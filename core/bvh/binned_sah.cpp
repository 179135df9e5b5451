#include "core/bvh/binned_sah.h"

#include "core/bvh/bins.h"
#include "core/bvh/top_nodes.h"

namespace boxwood {

namespace {

constexpr uint32_t kPartSize = 4096;   ///< references of a subtree that one thread builds, at most
constexpr size_t kRefGrain = 1 << 14;  ///< of larger nodes: references that one thread reads at once

Box4 half_centers_of(std::span<const BinRef> refs) {
    Box4 box = empty_box4();
    for (const BinRef& ref : refs) {
        const Float4 center = ref.half_center();
        box.extend(center, center);
    }
    return box;
}

Box4 box_of(std::span<const BinRef> refs) {
    Box4 box = empty_box4();
    for (const BinRef& ref : refs) box.extend(ref.lower, ref.upper);
    return box;
}

Box4 merged(std::span<const Box4> boxes) {
    Box4 all = empty_box4();
    for (const Box4& box : boxes) all.extend(box.lower, box.upper);
    return all;
}

/// How a node is divided.
struct Division {
    uint32_t left_count = 0;  ///< 0: not at all, it is a leaf
    int axis = -1;            ///< -1: halved, as the references stand
    int bin = 0;              ///< first bin of the right side
    Box4 left{}, right{};     ///< boxes of the sides

    bool is_leaf() const { return left_count == 0; }
    bool is_halved() const { return axis < 0; }
};
const Division kLeaf;

/// Copies references to `left` or `right`, which go ahead, each side in the order in which they came.
void partition(std::span<const BinRef> refs, const Binning& binning, const Division& at, BinRef* left,
               BinRef* right) {
    const auto plane = static_cast<float>(at.bin);
    for (const BinRef& ref : refs) {
        const bool is_left = binning.position(ref)[at.axis] < plane;
        BinRef* to = is_left ? left : right;  // no branch: no processor could predict it
        *to = ref;
        left += is_left;
        right += !is_left;
    }
}

/// A subtree under construction by one thread.
struct Part {
    Bvh2::Node* nodes;  ///< of the subtree; indices count from its root
    uint32_t* prims;    ///< of its leaves; indices count from here
    uint32_t node_count = 1;
    uint32_t prim_count = 0;
    Bins bins;  ///< of one node after the other

    Part(Bvh2::Node* first_node, uint32_t* first_prim) : nodes(first_node), prims(first_prim) {}
};

/// The build. References go to and fro between two arrays, from a node's to its children's.
class BinnedBuild {
public:
    BinnedBuild(const BinnedSah& params, std::span<const PrimRef> refs, const Task& task)
        : params_(params), task_(task), prims_(refs.size()), nodes_(2 * refs.size()) {
        for (Array<BinRef>& array : arrays_) array.resize(refs.size());
        std::vector<Box4> boxes((refs.size() + kRefGrain - 1) / kRefGrain);
        parallel_for(refs.size(), kRefGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) arrays_[0][i] = BinRef::of(refs[i]);
            boxes[begin / kRefGrain] = box_of(std::span(arrays_[0]).subspan(begin, end - begin));
        });
        top_.push_back({{0, static_cast<uint32_t>(refs.size())}, 0});
        states_.push_back({merged(boxes), 0});
    }

    Bvh2 build() {
        divide_top();
        for_each_part(top_, task_, [&](size_t i) { build_part(top_[i], states_[i]); });
        if (task_.stopped()) return {};
        place(top_);
        Bvh2 bvh;
        bvh.nodes.resize(top_[0].node_count);
        bvh.prims.resize(top_[0].prim_count);
        for_each_part(top_, task_, [&](size_t i) { copy_part(top_[i], bvh); });
        write_inner_nodes(top_, bvh.nodes);
        return bvh;
    }

private:
    /// Of a top node: its box, and the array in which its references stand.
    struct State {
        Box4 box;
        int array;
    };

    std::span<BinRef> refs_of(RefRange range, int array) {
        return std::span(arrays_[array]).subspan(range.begin, range.count());
    }
    int bins_for(uint32_t count) const {
        // Wald 2007, section 3.5.1: a small node needs few bins.
        return static_cast<int>(std::min(static_cast<uint32_t>(params_.bin_count), 4 + count));
    }
    bool fits_a_leaf(uint32_t count) const { return count <= static_cast<uint32_t>(params_.max_leaf_size); }

    /// Level by level, the nodes of each in parallel.
    void divide_top() {
        for (size_t begin = 0; begin < top_.size();) {
            const size_t end = top_.size();
            std::vector<Division> divisions(end - begin);
            parallel_for(end - begin, 1, [&](size_t i, size_t) {
                const TopNode& node = top_[begin + i];
                if (node.range.count() <= kPartSize || task_.stopped()) return;
                divisions[i] = divide_large(node.range, node.depth, states_[begin + i]);
            });
            for (size_t i = begin; i < end; ++i) {
                const Division& at = divisions[i - begin];
                if (at.is_leaf()) continue;
                divide(top_, i, top_[i].range.begin + at.left_count);
                const int array = at.is_halved() ? states_[i].array : 1 - states_[i].array;
                states_.push_back({at.left, array});
                states_.push_back({at.right, array});
            }
            begin = end;
        }
    }

    /// Divides a node of more than kPartSize references, by all threads; each takes blocks of them.
    Division divide_large(RefRange range, uint32_t depth, const State& state) {
        const std::span<const BinRef> refs = refs_of(range, state.array);
        if (must_halve(depth, range.count())) return halve(refs);
        const size_t block_count = (refs.size() + kRefGrain - 1) / kRefGrain;
        const auto for_each_block = [&](const auto& body) {
            parallel_for(refs.size(), kRefGrain, [&](size_t begin, size_t end) {
                body(begin / kRefGrain, refs.subspan(begin, end - begin));
            });
        };
        std::vector<Box4> centers(block_count);
        for_each_block([&](size_t block, auto some) { centers[block] = half_centers_of(some); });
        const Binning binning(merged(centers), bins_for(range.count()));
        const auto blocks = std::make_unique_for_overwrite<Bins[]>(block_count);
        for_each_block([&](size_t block, auto some) { blocks[block].fill(some, binning); });
        Bins bins = blocks[0];
        for (size_t i = 1; i < block_count; ++i) bins.add(blocks[i], binning.bin_count);

        const Division at = choose(bins, binning, refs, state.box);
        if (at.is_leaf() || at.is_halved()) return at;
        std::vector<uint32_t> lefts(block_count);  // of the blocks before
        for (size_t i = 1; i < block_count; ++i)
            lefts[i] = lefts[i - 1] + blocks[i - 1].count_of(at.axis, at.bin);
        BinRef* const to = refs_of(range, 1 - state.array).data();
        for_each_block([&](size_t block, auto some) {
            const size_t rights = block * kRefGrain - lefts[block];
            partition(some, binning, at, to + lefts[block], to + at.left_count + rights);
        });
        return at;
    }

    /// Divides a node by one thread.
    Division divide_small(RefRange range, uint32_t depth, int array, const Box4& box, Bins& bins) {
        const std::span<const BinRef> refs = refs_of(range, array);
        if (refs.size() == 1) return kLeaf;
        if (must_halve(depth, range.count())) return fits_a_leaf(range.count()) ? kLeaf : halve(refs);
        if (refs.size() == 2) return divide_pair(range, array, box);
        const Binning binning(half_centers_of(refs), bins_for(range.count()));
        bins.fill(refs, binning);
        const Division at = choose(bins, binning, refs, box);
        if (at.is_leaf() || at.is_halved()) return at;
        BinRef* const to = refs_of(range, 1 - array).data();
        partition(refs, binning, at, to, to + at.left_count);
        return at;
    }

    static Division halve(std::span<const BinRef> refs) {
        const size_t half = refs.size() / 2;
        return {.left_count = static_cast<uint32_t>(half),
                .left = box_of(refs.first(half)),
                .right = box_of(refs.subspan(half))};
    }

    Division choose(const Bins& bins, const Binning& binning, std::span<const BinRef> refs,
                    const Box4& box) const {
        const auto count = static_cast<uint32_t>(refs.size());
        const float scale = area_scale(box);
        const BinSplit split = bins.cheapest_split(binning.bin_count, count, scale);
        if (is_leaf_cheaper(count, box, scale, split.cost)) return kLeaf;
        if (split.axis < 0) return halve(refs);
        return {bins.count_of(split.axis, split.bin), split.axis, split.bin,
                bins.box_of(split.axis, 0, split.bin), bins.box_of(split.axis, split.bin, binning.bin_count)};
    }

    bool is_leaf_cheaper(uint32_t count, const Box4& box, float scale, float sides_cost) const {
        if (!fits_a_leaf(count)) return false;
        constexpr auto kTest = static_cast<float>(kIntersectionCost);
        const float area = half_area(scaled_extent(box, scale));
        return kTest * static_cast<float>(count) * area <= params_.traversal_cost * area + kTest * sides_cost;
    }

    /// What bins would give for two references: they part on the first axis on which their centres differ.
    Division divide_pair(RefRange range, int array, const Box4& box) {
        const std::span<const BinRef> refs = refs_of(range, array);
        Box4 centers = half_centers_of(refs);
        const Binning binning(centers, bins_for(2));
        int axis = 0;
        while (axis < 3 && binning.scale[axis] == 0.0f) ++axis;
        const float scale = area_scale(box);
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        const float cost = axis == 3 ? kInfinity
                                     : half_area(scaled_extent({refs[0].lower, refs[0].upper}, scale)) +
                                           half_area(scaled_extent({refs[1].lower, refs[1].upper}, scale));
        if (is_leaf_cheaper(2, box, scale, cost)) return kLeaf;
        if (axis == 3) return halve(refs);
        const size_t left = refs[0].half_center()[axis] <= refs[1].half_center()[axis] ? 0 : 1;
        const std::span<BinRef> to = refs_of(range, 1 - array);
        to[0] = refs[left];
        to[1] = refs[1 - left];
        return {1, axis, 1, {to[0].lower, to[0].upper}, {to[1].lower, to[1].upper}};
    }

    void build_part(TopNode& top, const State& state) {
        const uint32_t first = top.range.begin;
        Part part(&nodes_[2 * first], &prims_[first]);
        build_node(part, 0, top.range, top.depth, state.array, state.box);
        top.node_count = part.node_count;
        top.prim_count = part.prim_count;
    }

    void build_node(Part& part, uint32_t node, RefRange range, uint32_t depth, int array, const Box4& box) {
        const Division at = divide_small(range, depth, array, box, part.bins);
        if (at.is_leaf()) return make_leaf(part, node, refs_of(range, array), box);
        const uint32_t left = part.node_count;
        part.node_count += 2;
        store_node(part.nodes[node], box, left, 0);
        const uint32_t mid = range.begin + at.left_count;
        const int next_array = at.is_halved() ? array : 1 - array;
        build_node(part, left, {range.begin, mid}, depth + 1, next_array, at.left);
        build_node(part, left + 1, {mid, range.end}, depth + 1, next_array, at.right);
    }

    /// A primitive stands once in a leaf (Dammertz, Keller 2008, section 2.3); ascending.
    static void make_leaf(Part& part, uint32_t node, std::span<const BinRef> refs, const Box4& box) {
        uint32_t* const first = part.prims + part.prim_count;
        for (size_t i = 0; i < refs.size(); ++i) first[i] = refs[i].prim();
        std::sort(first, first + refs.size());
        const auto count = static_cast<uint32_t>(std::unique(first, first + refs.size()) - first);
        store_node(part.nodes[node], box, part.prim_count, count);
        part.prim_count += count;
    }

    void copy_part(const TopNode& top, Bvh2& bvh) const {
        const Bvh2::Node* const from = &nodes_[2 * top.range.begin];
        for (uint32_t i = 0; i < top.node_count; ++i) {
            Bvh2::Node& to = bvh.nodes[i == 0 ? top.node : top.below + i - 1];
            to = from[i];
            to.first += to.is_leaf() ? top.first_prim : top.below - 1;
        }
        std::copy_n(&prims_[top.range.begin], top.prim_count, bvh.prims.begin() + top.first_prim);
    }

    const BinnedSah& params_;
    const Task& task_;
    Array<BinRef> arrays_[2];
    Array<uint32_t> prims_;    ///< of the parts' leaves, each part's where its references began
    Array<Bvh2::Node> nodes_;  ///< of the parts, each part's at twice that place
    std::vector<TopNode> top_;
    std::vector<State> states_;  ///< of the top nodes
};

}  // namespace

Bvh2 BinnedSah::build(const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    return BinnedBuild(*this, refs, task).build();
}

}  // namespace boxwood
