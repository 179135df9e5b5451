#include "core/bvh/top_down.h"

#include "core/bvh/box4.h"

namespace boxwood {

NodeBounds bounds_of(std::span<const PrimRef> refs) {
    Box4 box = empty_box4(), centers = empty_box4();
    for (const PrimRef& ref : refs) {
        const Float4 lower = load_lower(ref), upper = load_upper(ref);
        box.extend(lower, upper);
        const Float4 center = half_center4(lower, upper);
        centers.extend(center, center);
    }
    return {box.box(), centers.box()};
}

Bvh2 finish(const NodeScratch& scratch, std::span<const uint32_t> prims) {
    Bvh2 bvh;
    if (prims.empty()) return bvh;
    bvh.nodes.reserve(2 * prims.size() - 1);
    bvh.prims.reserve(prims.size());
    // Depth first, left before right; a pair of children gets its place when the parent is reached.
    struct Pending {
        uint32_t from, to;
    };
    std::vector<Pending> stack{{0, 0}};
    bvh.nodes.push_back(scratch.nodes[0]);
    while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        const Bvh2::Node& source = scratch.nodes[pending.from];
        if (source.is_leaf()) {
            const auto first = static_cast<std::ptrdiff_t>(bvh.prims.size());
            bvh.prims.insert(bvh.prims.end(), prims.begin() + source.first,
                             prims.begin() + source.first + source.count);
            std::sort(bvh.prims.begin() + first, bvh.prims.end());
            bvh.prims.erase(std::unique(bvh.prims.begin() + first, bvh.prims.end()), bvh.prims.end());
            bvh.nodes[pending.to].first = static_cast<uint32_t>(first);
            bvh.nodes[pending.to].count =
                static_cast<uint32_t>(bvh.prims.size()) - static_cast<uint32_t>(first);
            continue;
        }
        const auto left = static_cast<uint32_t>(bvh.nodes.size());
        bvh.nodes[pending.to].first = left;
        bvh.nodes.push_back(scratch.nodes[source.first]);
        bvh.nodes.push_back(scratch.nodes[source.first + 1]);
        stack.push_back({source.first + 1, left + 1});
        stack.push_back({source.first, left});
    }
    bvh.nodes.shrink_to_fit();
    return bvh;
}

}  // namespace boxwood
