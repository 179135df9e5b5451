#include "core/wide_bvh/wide_output.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/base/assert.h"
#include "core/base/parallel.h"
#include "core/base/task.h"

namespace boxwood {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <uint32_t Width>
typename WideBvh<Width>::Node empty_node() {
    typename WideBvh<Width>::Node node{};
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::fill(node.lower[axis], kInfinity);
        std::ranges::fill(node.upper[axis], -kInfinity);
    }
    return node;
}

/// The order of the children for rays of one octant: by the centres of their boxes on the octant's diagonal,
/// which is the mean direction of its rays. Empty lanes last.
template <uint32_t Width>
std::array<uint8_t, Width> order_of(const typename WideBvh<Width>::Node& node, uint32_t octant) {
    std::array<double, Width> place;
    std::array<uint8_t, Width> lanes;
    for (uint32_t lane = 0; lane < Width; ++lane) {
        lanes[lane] = static_cast<uint8_t>(lane);
        place[lane] = std::numeric_limits<double>::infinity();
        if (node.children[lane].is_empty()) continue;
        const DVec3 center = node.bounds(lane).center();
        place[lane] = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            place[lane] += (octant >> axis & 1u) != 0 ? -center[axis] : center[axis];
    }
    std::ranges::sort(
        lanes, [&](uint8_t a, uint8_t b) { return place[a] < place[b] || (place[a] == place[b] && a < b); });
    return lanes;
}

template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node) {
    constexpr uint32_t kBits = std::bit_width(Width - 1);
    constexpr uint32_t kBytes = Width * kBits / 8;
    for (uint32_t octant = 0; octant < 8; ++octant) {
        const std::array<uint8_t, Width> lanes = order_of<Width>(node, octant);
        uint32_t bits = 0;
        for (uint32_t rank = 0; rank < Width; ++rank) bits |= uint32_t{lanes[rank]} << (kBits * rank);
        for (uint32_t byte = 0; byte < kBytes; ++byte)
            node.order[kBytes * octant + byte] = static_cast<uint8_t>(bits >> (8 * byte));
    }
}

void fill_pack(const Mesh& mesh, TrianglePack& pack) {
    for (uint32_t lane = 0; lane < TrianglePack::kSize; ++lane) {
        const Triangle triangle = mesh.triangle(pack.prims[lane]);
        for (int axis = 0; axis < 3; ++axis) {
            pack.corners[0][axis][lane] = triangle.a[axis];
            pack.corners[1][axis][lane] = triangle.b[axis];
            pack.corners[2][axis][lane] = triangle.c[axis];
        }
    }
}

/// The nodes of a plan in depth-first order, without their orders, and packs that know their primitives only.
template <uint32_t Width>
class WideWriter {
public:
    WideWriter(const Bvh2& bvh, const WidePlan<Width>& plan) : bvh_(bvh), plan_(plan) {}

    WideBvh<Width> write(const Task& task) {
        stack_.push_back({0, kNoIndex, 0, 0});
        while (!stack_.empty() && !task.stopped()) {
            const Pending pending = stack_.back();
            stack_.pop_back();
            const auto node = static_cast<uint32_t>(wide_.nodes.size());
            if (pending.parent != kNoIndex)
                wide_.nodes[pending.parent].children[pending.lane] = WideChild::inner(node);
            add_node(pending);
        }
        return std::move(wide_);
    }

private:
    struct Pending {
        uint32_t source, parent, lane, level;
    };

    void add_node(const Pending& pending) {
        BOXWOOD_ASSERT(pending.level <= WideBvh<Width>::kMaxDepth);
        const auto index = static_cast<uint32_t>(wide_.nodes.size());
        typename WideBvh<Width>::Node node = empty_node<Width>();
        node.first_leaf = wide_.leaf_count;
        const WideParts<Width> children = plan_.children_of(pending.source);
        for (uint32_t lane = 0; lane < children.count; ++lane) {
            const WidePart part = children.parts[lane];
            const Bvh2::Node& source = bvh_.nodes[part.node];
            for (int axis = 0; axis < 3; ++axis) {
                node.lower[axis][lane] = source.lower[axis];
                node.upper[axis][lane] = source.upper[axis];
            }
            if (part.is_leaf) node.children[lane] = add_leaf(part.node);
        }
        wide_.nodes.push_back(node);
        for (uint32_t lane = children.count; lane-- > 0;)
            if (!children.parts[lane].is_leaf)
                stack_.push_back({children.parts[lane].node, index, lane, pending.level + 1});
    }

    WideChild add_leaf(uint32_t source) {
        prims_.clear();
        gather_prims(bvh_, source, prims_);
        const auto first = static_cast<uint32_t>(wide_.packs.size());
        for (size_t begin = 0; begin < prims_.size(); begin += TrianglePack::kSize) {
            TrianglePack& pack = wide_.packs.emplace_back();
            for (size_t lane = 0; lane < TrianglePack::kSize; ++lane)
                pack.prims[lane] = prims_[std::min(begin + lane, prims_.size() - 1)];
        }
        const uint32_t count = static_cast<uint32_t>(wide_.packs.size()) - first;
        BOXWOOD_ASSERT(count >= 1 && count <= WideChild::kMostPacks);
        ++wide_.leaf_count;
        return WideChild::leaf(first, count);
    }

    const Bvh2& bvh_;
    const WidePlan<Width>& plan_;
    WideBvh<Width> wide_;
    std::vector<Pending> stack_;
    std::vector<uint32_t> prims_;  ///< of one leaf
};

}  // namespace

void gather_prims(const Bvh2& bvh, uint32_t node, std::vector<uint32_t>& prims) {
    const auto add = [&](const auto& self, const Bvh2::Node& from) -> void {
        if (from.is_leaf()) {
            prims.insert(prims.end(), bvh.prims.begin() + from.first,
                         bvh.prims.begin() + from.first + from.count);
            return;
        }
        self(self, bvh.nodes[from.first]);
        self(self, bvh.nodes[from.first + 1]);
    };
    add(add, bvh.nodes[node]);
    std::ranges::sort(prims);
    const auto repeated = std::ranges::unique(prims);
    prims.erase(repeated.begin(), repeated.end());
}

template <uint32_t Width>
WideBvh<Width> make_wide(const Mesh& mesh, const Bvh2& bvh, const WidePlan<Width>& plan, const Task& task) {
    WideBvh<Width> wide = WideWriter<Width>(bvh, plan).write(task);
    parallel_for(wide.packs.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !task.stopped(); ++i) fill_pack(mesh, wide.packs[i]);
    });
    parallel_for(wide.nodes.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !task.stopped(); ++i) set_order<Width>(wide.nodes[i]);
    });
    return task.stopped() ? WideBvh<Width>{} : wide;
}

template WideBvh<4> make_wide(const Mesh&, const Bvh2&, const WidePlan<4>&, const Task&);
template WideBvh<8> make_wide(const Mesh&, const Bvh2&, const WidePlan<8>&, const Task&);

}  // namespace boxwood
