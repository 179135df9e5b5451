#include "core/bvh/ploc.h"

#include "core/bvh/bins.h"
#include "core/bvh/leaf_duplicates.h"
#include "core/bvh/morton_order.h"
#include "core/bvh/top_nodes.h"

namespace boxwood {

namespace {

constexpr size_t kClusterGrain = 2048;  ///< clusters that one thread looks at
constexpr uint32_t kPartNodes = 4096;   ///< of a subtree that one thread writes, at most
constexpr size_t kFewMerges = 16;       ///< a round should merge one cluster of so many
constexpr uint32_t kLanes = 4;

/// What is known of the subtree under a cluster. Ids below the number of references are these, along the
/// curve; the others are inner nodes.
struct ClusterTree {
    uint32_t id;
    uint32_t ref_count;
    uint32_t node_count;  ///< of the finished tree; 1: it is a leaf
    uint32_t height;      ///< levels below it before leaves were made
    float cost;           ///< SAH cost, areas scaled
};

/// Two subtrees that were merged.
struct Merge {
    uint32_t left, right;
    uint32_t ref_count, node_count;
};

/// The clusters of a round, in the order of the curve. Corners are scaled, one array for each coordinate,
/// with boxes without end before the first and after the last, to which no distance is finite.
class Clusters {
public:
    Clusters(size_t capacity, uint32_t padding) : padding_(padding), subtrees(capacity) {
        for (Array<float>& corner : corners_) corner.resize(capacity + 2 * padding);
    }
    void resize(size_t count) {
        count_ = count;
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        for (size_t c = 0; c < 6; ++c) {
            const float end = c < 3 ? -kInfinity : kInfinity;
            std::fill_n(corners_[c].begin(), padding_, end);
            std::fill_n(corners_[c].begin() + static_cast<std::ptrdiff_t>(padding_ + count), padding_, end);
        }
    }
    size_t size() const { return count_; }
    void set_box(size_t i, const Box4& box) {
        for (int axis = 0; axis < 3; ++axis) {
            corner(axis)[i] = box.lower[axis];
            corner(axis + 3)[i] = box.upper[axis];
        }
    }
    Box4 box(size_t i) const {
        return {Float4{corner(0)[i], corner(1)[i], corner(2)[i], 0.0f},
                Float4{corner(3)[i], corner(4)[i], corner(5)[i], 0.0f}};
    }
    /// Index 0 is the first cluster; lower x, y, z, upper x, y, z.
    float* corner(int c) { return corners_[c].data() + padding_; }
    const float* corner(int c) const { return corners_[c].data() + padding_; }

private:
    size_t count_ = 0;
    uint32_t padding_;
    Array<float> corners_[6];

public:
    Array<ClusterTree> subtrees;
};

Float4 load(const float* from) {
    Float4 v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// The nearest of `radius` clusters on each side of cluster i: of its four lanes' worth at a time.
class Nearest {
public:
    Nearest(const Clusters& clusters, int32_t i) : i_(i) {
        for (int c = 0; c < 6; ++c) {
            corners_[c] = clusters.corner(c);
            own_[c] = splat(corners_[c][i]);
        }
    }
    /// Looks at the clusters first ... first + 3 that are within the radius.
    void look(int32_t first, int32_t radius) {
        const auto lower = [&](int axis) { return min4(own_[axis], load(corners_[axis] + first)); };
        const auto upper = [&](int axis) { return max4(own_[axis + 3], load(corners_[axis + 3] + first)); };
        const Float4 x = upper(0) - lower(0), y = upper(1) - lower(1), z = upper(2) - lower(2);
        const Float4 distance = x * y + y * z + z * x;
        const Int4 j = Int4{0, 1, 2, 3} + first;
        const Int4 bits = j ^ i_;
        const Int4 is_near = (j - i_ <= radius) & (i_ - j <= radius);
        const Int4 is_better =
            is_near & ((distance < distance_) | ((distance == distance_) & (bits < bits_)));
        distance_ = is_better ? distance : distance_;
        bits_ = is_better ? bits : bits_;
    }
    int32_t nearest() const {
        int best = 0;
        for (int lane = 1; lane < 4; ++lane) {
            if (distance_[lane] < distance_[best] ||
                (distance_[lane] == distance_[best] && bits_[lane] < bits_[best]))
                best = lane;
        }
        return bits_[best] ^ i_;
    }

private:
    int32_t i_;
    const float* corners_[6];
    Float4 own_[6];
    Float4 distance_ = splat(std::numeric_limits<float>::max());
    Int4 bits_ = Int4{} + std::numeric_limits<int32_t>::max();
};

class PlocBuild {
public:
    PlocBuild(const Ploc& params, uint32_t max_depth, std::span<const PrimRef> refs, const Task& task)
        : params_(params),
          max_depth_(max_depth),
          refs_(refs),
          task_(task),
          order_(morton_order(refs, 1, task)),
          merges_(refs.size() - 1),
          nearest_(refs.size()) {}

    Bvh2 build() {
        Clusters clusters = first_clusters(), spare(refs_.size(), padding());
        while (clusters.size() > 1) {
            if (task_.stopped()) return {};
            merge_round(clusters, spare);
            std::swap(clusters, spare);
        }
        return task_.stopped() ? Bvh2{} : make_tree(clusters.subtrees[0]);
    }

private:
    uint32_t padding() const { return static_cast<uint32_t>(params_.radius) + 2 * kLanes; }

    /// One for each reference.
    Clusters first_clusters() const {
        Clusters clusters(refs_.size(), padding());
        clusters.resize(refs_.size());
        const float scale = unit_scale(box_of_all());
        parallel_for(refs_.size(), kClusterGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const PrimRef& ref = refs_[order_.ref(i)];
                const Box4 box{splat(scale) * load_lower(ref), splat(scale) * load_upper(ref)};
                clusters.set_box(i, box);
                const float cost = static_cast<float>(kIntersectionCost) * half_area(box.upper - box.lower);
                clusters.subtrees[i] = {static_cast<uint32_t>(i), 1, 1, 0, cost};
            }
        });
        return clusters;
    }

    Box4 box_of_all() const {
        constexpr size_t kBlock = 1 << 16;
        std::vector<Box4> boxes((refs_.size() + kBlock - 1) / kBlock, empty_box4());
        parallel_for(refs_.size(), kBlock, [&](size_t begin, size_t end) {
            Box4 box = empty_box4();
            for (const PrimRef& ref : refs_.subspan(begin, end - begin))
                box.extend(load_lower(ref), load_upper(ref));
            boxes[begin / kBlock] = box;
        });
        Box4 all = empty_box4();
        for (const Box4& box : boxes) all.extend(box.lower, box.upper);
        return all;
    }

    /// Of a block of clusters: how many go on, how many of these are merged ones.
    struct Counts {
        uint32_t kept = 0, merged = 0;
    };

    void merge_round(const Clusters& from, Clusters& to) {
        parallel_for(from.size(), kClusterGrain,
                     [&](size_t begin, size_t end) { find_nearest(from, begin, end); });
        // The depth bound D. Before each round of m clusters every height is at most D - ceil(log2 m): at
        // first 0 is, D being no less than ceil(log2 n). A merge must keep within that, and the bound only
        // rises as clusters become fewer. A round that pairs all neighbours adds 1 to the heights and takes 1
        // off ceil(log2 m). So the last cluster has a height of at most D.
        bound_ = max_depth_ - static_cast<uint32_t>(std::bit_width(from.size() - 1));
        std::vector<Counts> places = count(from);
        if (places.back().merged == 0 || places.back().merged < from.size() / kFewMerges) {
            pair_neighbours(from.size());
            places = count(from);
        }
        to.resize(places.back().kept);
        parallel_for(from.size(), kClusterGrain, [&](size_t begin, size_t end) {
            merge_block(from, to, begin, end, places[begin / kClusterGrain]);
        });
        merge_count_ += places.back().merged;
    }

    void pair_neighbours(size_t cluster_count) {
        const auto all = static_cast<int32_t>(cluster_count);
        for (int32_t i = 0; i < all; ++i) nearest_[static_cast<size_t>(i)] = (i ^ 1) < all ? i ^ 1 : i;
        bound_ = max_depth_;
    }

    void find_nearest(const Clusters& clusters, size_t begin, size_t end) {
        const int32_t radius = params_.radius;
        constexpr auto kStep = static_cast<int32_t>(kLanes);
        for (auto i = static_cast<int32_t>(begin); i < static_cast<int32_t>(end); ++i) {
            Nearest nearest(clusters, i);
            for (int32_t k = 0; k < radius; k += kStep) {
                nearest.look(i - k - kStep, radius);
                nearest.look(i + k + 1, radius);
            }
            nearest_[static_cast<size_t>(i)] = nearest.nearest();
        }
    }

    /// Whether cluster i merges with its nearest.
    bool merges(const Clusters& clusters, size_t i) const {
        const auto j = static_cast<size_t>(nearest_[i]);
        return j != i && nearest_[j] == static_cast<int32_t>(i) &&
               std::max(clusters.subtrees[i].height, clusters.subtrees[j].height) < bound_;
    }

    /// Where each block begins to write, and last the sums.
    std::vector<Counts> count(const Clusters& clusters) const {
        std::vector<Counts> blocks((clusters.size() + kClusterGrain - 1) / kClusterGrain + 1);
        parallel_for(clusters.size(), kClusterGrain, [&](size_t begin, size_t end) {
            Counts counts;
            for (size_t i = begin; i < end; ++i) {
                const bool merges_here = merges(clusters, i), is_left = nearest_[i] > static_cast<int32_t>(i);
                counts.kept += !merges_here || is_left;
                counts.merged += merges_here && is_left;
            }
            blocks[begin / kClusterGrain] = counts;
        });
        Counts sum;
        for (Counts& block : blocks) {
            const Counts here = std::exchange(block, sum);
            sum.kept += here.kept;
            sum.merged += here.merged;
        }
        return blocks;
    }

    void merge_block(const Clusters& from, Clusters& to, size_t begin, size_t end, Counts place) {
        for (size_t i = begin; i < end; ++i) {
            const auto j = static_cast<size_t>(nearest_[i]);
            Box4 box = from.box(i);
            if (!merges(from, i)) {
                to.set_box(place.kept, box);
                to.subtrees[place.kept++] = from.subtrees[i];
            } else if (i < j) {
                const Box4 other = from.box(j);
                box.extend(other.lower, other.upper);
                to.set_box(place.kept, box);
                to.subtrees[place.kept++] =
                    merge(from.subtrees[i], from.subtrees[j], half_area(box.upper - box.lower),
                          merge_count_ + place.merged++);
            }
        }
    }

    /// Leaves as the paper's section 3.4 makes them: a subtree becomes one where that costs no more.
    ClusterTree merge(const ClusterTree& left, const ClusterTree& right, float area, uint32_t merge) {
        ClusterTree result{.id = static_cast<uint32_t>(refs_.size()) + merge,
                           .ref_count = left.ref_count + right.ref_count,
                           .node_count = 1 + left.node_count + right.node_count,
                           .height = 1 + std::max(left.height, right.height),
                           .cost = params_.traversal_cost * area + left.cost + right.cost};
        const float as_leaf =
            static_cast<float>(kIntersectionCost) * static_cast<float>(result.ref_count) * area;
        if (result.ref_count <= static_cast<uint32_t>(params_.max_leaf_size) && as_leaf <= result.cost) {
            result.node_count = 1;
            result.cost = as_leaf;
        }
        merges_[merge] = {left.id, right.id, result.ref_count, result.node_count};
        return result;
    }

    uint32_t ref_count(uint32_t id) const { return id < refs_.size() ? 1 : merge_of(id).ref_count; }
    uint32_t node_count(uint32_t id) const { return id < refs_.size() ? 1 : merge_of(id).node_count; }
    const Merge& merge_of(uint32_t id) const { return merges_[id - refs_.size()]; }

    Bvh2 make_tree(const ClusterTree& root) {
        std::vector<TopNode> top{{{0, root.ref_count}, 0}};
        std::vector<uint32_t> ids{root.id};
        for (size_t i = 0; i < top.size(); ++i) {
            const uint32_t id = ids[i];
            top[i].node_count = node_count(id);
            top[i].prim_count = ref_count(id);
            if (top[i].node_count <= kPartNodes) continue;
            const Merge& merge = merge_of(id);
            divide(top, i, top[i].range.begin + ref_count(merge.left));
            ids.push_back(merge.left);
            ids.push_back(merge.right);
        }
        place(top);
        Bvh2 bvh;
        bvh.nodes.resize(top[0].node_count);
        bvh.prims.resize(refs_.size());
        for_each_part(top, task_, [&](size_t i) {
            uint32_t next = top[i].below, next_prim = top[i].first_prim;
            write(bvh, top[i].node, ids[i], next, next_prim);
        });
        write_inner_nodes(top, bvh.nodes);
        return bvh;
    }

    /// Writes a node and all below it, which begin at `next`; its primitives begin at `next_prim`.
    Box4 write(Bvh2& bvh, uint32_t node, uint32_t id, uint32_t& next, uint32_t& next_prim) const {
        if (node_count(id) == 1) {
            const uint32_t first = next_prim;
            const Box4 box = write_leaf(bvh, id, next_prim);
            store_node(bvh.nodes[node], box, first, next_prim - first);
            return box;
        }
        const Merge& merge = merge_of(id);
        const uint32_t left = next;
        next += 2;
        Box4 box = write(bvh, left, merge.left, next, next_prim);
        const Box4 right = write(bvh, left + 1, merge.right, next, next_prim);
        box.extend(right.lower, right.upper);
        store_node(bvh.nodes[node], box, left, 0);
        return box;
    }

    Box4 write_leaf(Bvh2& bvh, uint32_t id, uint32_t& next_prim) const {
        if (id < refs_.size()) {
            const PrimRef& ref = refs_[order_.ref(id)];
            bvh.prims[next_prim++] = ref.prim;
            return {load_lower(ref), load_upper(ref)};
        }
        Box4 box = write_leaf(bvh, merge_of(id).left, next_prim);
        const Box4 right = write_leaf(bvh, merge_of(id).right, next_prim);
        box.extend(right.lower, right.upper);
        return box;
    }

    const Ploc& params_;
    const uint32_t max_depth_;
    std::span<const PrimRef> refs_;
    const Task& task_;
    MortonOrder order_;
    Array<Merge> merges_;
    uint32_t merge_count_ = 0;
    Array<int32_t> nearest_;  ///< of the clusters of the round
    uint32_t bound_ = 0;      ///< of their heights
};

}  // namespace

Bvh2 Ploc::build_within(uint32_t max_depth, const Mesh&, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    Bvh2 bvh = PlocBuild(*this, max_depth, refs, task).build();
    merge_duplicates(bvh, refs);
    return bvh;
}

}  // namespace boxwood
