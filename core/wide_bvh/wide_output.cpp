#include "core/wide_bvh/wide_output.h"

#include <algorithm>
#include <limits>

#include "core/base/assert.h"
#include "core/base/parallel.h"
#include "core/base/task.h"
#include "core/wide_bvh/child_order.h"

namespace boxwood {

namespace {

template <uint32_t Width>
typename WideBvh<Width>::Node empty_node() {
    typename WideBvh<Width>::Node node{};
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::fill(node.lower[axis], std::numeric_limits<float>::infinity());
        std::ranges::fill(node.upper[axis], -std::numeric_limits<float>::infinity());
    }
    return node;
}

template <uint32_t Size>
void set_pack(const Mesh& mesh, std::span<const uint32_t> prims, TrianglePack<Size>& pack) {
    for (uint32_t lane = 0; lane < Size; ++lane) {
        const uint32_t prim = prims[std::min(size_t{lane}, prims.size() - 1)];
        const Triangle triangle = mesh.triangle(prim);
        pack.prims[lane] = prim;
        for (int axis = 0; axis < 3; ++axis) {
            pack.corners[0][axis][lane] = triangle.a[axis];
            pack.corners[1][axis][lane] = triangle.b[axis];
            pack.corners[2][axis][lane] = triangle.c[axis];
        }
    }
}

/// Appends the primitives below a node, in any order.
void add_prims(const Bvh2& bvh, const Bvh2::Node& node, std::vector<uint32_t>& prims) {
    if (node.is_leaf()) {
        prims.insert(prims.end(), bvh.prims.begin() + node.first,
                     bvh.prims.begin() + node.first + node.count);
        return;
    }
    add_prims(bvh, bvh.nodes[node.first], prims);
    add_prims(bvh, bvh.nodes[node.first + 1], prims);
}

/// Each number once, in ascending order.
void sort_once(std::vector<uint32_t>& prims) {
    std::ranges::sort(prims);
    prims.erase(std::unique(prims.begin(), prims.end()), prims.end());
}

/// Where the parts of a plan stand in the wide hierarchy: first all numbers, one node after the other, then
/// the nodes and leaves themselves, in parallel.
template <uint32_t Width>
class WideWriter {
public:
    WideWriter(const Mesh& mesh, const Bvh2& bvh, const PrimCounts& counts, const Task& task)
        : mesh_(mesh), bvh_(bvh), counts_(counts), task_(task) {}

    WideBvh<Width> write(const WidePlan<Width>& plan) {
        number_nodes(plan);
        WideBvh<Width> wide;
        wide.leaf_count = leaf_count_;
        wide.nodes.resize(numbered_.size());
        wide.packs.resize(pack_count_);
        parallel_for(numbered_.size(), 64, [&](size_t begin, size_t end) {
            std::vector<uint32_t> prims;
            for (size_t i = begin; i < end && !task_.stopped(); ++i)
                wide.nodes[i] = make_node(numbered_[i], prims, wide.packs);
        });
        return task_.stopped() ? WideBvh<Width>{} : std::move(wide);
    }

private:
    struct Numbered {
        WideParts<Width> parts;
        std::array<uint32_t, Width> nodes;  ///< that the parts become where they are no leaves
        uint32_t first_leaf, first_pack;
    };
    struct Pending {
        uint32_t source;        ///< node of the binary hierarchy
        uint32_t parent, lane;  ///< no parent: kNoIndex
        uint32_t level;
    };

    /// Depth first, the children in the order of their lanes.
    void number_nodes(const WidePlan<Width>& plan) {
        std::vector<Pending> stack{{0, kNoIndex, 0, 0}};
        while (!stack.empty() && !task_.stopped()) {
            const Pending pending = stack.back();
            stack.pop_back();
            BOXWOOD_ASSERT(pending.level <= WideBvh<Width>::kMaxDepth);
            const auto index = static_cast<uint32_t>(numbered_.size());
            if (pending.parent != kNoIndex) numbered_[pending.parent].nodes[pending.lane] = index;
            const WideParts<Width> parts = plan.children_of(pending.source);
            numbered_.push_back({parts, {}, leaf_count_, pack_count_});
            for (uint32_t lane = parts.count; lane-- > 0;) {
                if (parts.parts[lane].is_leaf) {
                    ++leaf_count_;
                    pack_count_ += packs_of(parts.parts[lane].node);
                } else {
                    stack.push_back({parts.parts[lane].node, index, lane, pending.level + 1});
                }
            }
        }
    }

    uint32_t packs_of(uint32_t leaf) const {
        return WideBvh<Width>::Pack::packs_for(counts_.are_few(leaf) ? counts_.of(leaf)
                                                                     : bvh_.nodes[leaf].count);
    }

    typename WideBvh<Width>::Node make_node(const Numbered& from, std::vector<uint32_t>& prims,
                                            std::span<typename WideBvh<Width>::Pack> packs) const {
        typename WideBvh<Width>::Node node = empty_node<Width>();
        node.first_leaf = from.first_leaf;
        uint32_t pack = from.first_pack;
        for (uint32_t lane = 0; lane < from.parts.count; ++lane) {
            const WidePart part = from.parts.parts[lane];
            const Bvh2::Node& source = bvh_.nodes[part.node];
            for (int axis = 0; axis < 3; ++axis) {
                node.lower[axis][lane] = source.lower[axis];
                node.upper[axis][lane] = source.upper[axis];
            }
            if (!part.is_leaf) {
                node.children[lane] = WideChild::inner(from.nodes[lane]);
                continue;
            }
            prims.clear();
            add_prims(bvh_, source, prims);
            sort_once(prims);
            const uint32_t count = packs_of(part.node);
            BOXWOOD_ASSERT(count == WideBvh<Width>::Pack::packs_for(static_cast<uint32_t>(prims.size())));
            BOXWOOD_ASSERT(count >= 1 && count <= WideChild::kMostPacks);
            node.children[lane] = WideChild::leaf(pack, count);
            for (size_t first = 0; first < prims.size(); first += WideBvh<Width>::Pack::kSize)
                set_pack(mesh_, std::span(prims).subspan(first), packs[pack++]);
        }
        set_order<Width>(node);
        return node;
    }

    const Mesh& mesh_;
    const Bvh2& bvh_;
    const PrimCounts& counts_;
    const Task& task_;
    std::vector<Numbered> numbered_;
    uint32_t leaf_count_ = 0, pack_count_ = 0;
};

}  // namespace

template <uint32_t Width>
WideBvh<Width> make_wide(const Mesh& mesh, const Bvh2& bvh, const PrimCounts& counts,
                         const WidePlan<Width>& plan, const Task& task) {
    return WideWriter<Width>(mesh, bvh, counts, task).write(plan);
}

template WideBvh<4> make_wide(const Mesh&, const Bvh2&, const PrimCounts&, const WidePlan<4>&, const Task&);
template WideBvh<8> make_wide(const Mesh&, const Bvh2&, const PrimCounts&, const WidePlan<8>&, const Task&);
template WideBvh<16> make_wide(const Mesh&, const Bvh2&, const PrimCounts&, const WidePlan<16>&, const Task&);

}  // namespace boxwood
