#include "core/bvh/leaf_duplicates.h"

#include <algorithm>
#include <atomic>

#include "core/base/parallel.h"

namespace boxwood {

bool has_pieces(std::span<const PrimRef> refs) {
    std::atomic<bool> found{false};
    if (refs.empty()) return false;
    parallel_for(refs.size() - 1, 1 << 16, [&](size_t begin, size_t end) {
        bool here = false;
        for (size_t i = begin; i < end; ++i) here |= refs[i].prim == refs[i + 1].prim;
        if (here) found = true;
    });
    return found;
}

void merge_duplicates(Bvh2& bvh, std::span<const PrimRef> refs) {
    if (bvh.nodes.empty() || !has_pieces(refs)) return;
    Array<uint32_t> prims;
    prims.reserve(bvh.prims.size());
    std::vector<uint32_t> stack{0};
    while (!stack.empty()) {
        Bvh2::Node& node = bvh.nodes[stack.back()];
        stack.pop_back();
        if (!node.is_leaf()) {
            stack.push_back(node.first + 1);
            stack.push_back(node.first);
            continue;
        }
        const auto begin = bvh.prims.begin() + node.first, end = begin + node.count;
        std::sort(begin, end);
        node.first = static_cast<uint32_t>(prims.size());
        prims.insert(prims.end(), begin, std::unique(begin, end));
        node.count = static_cast<uint32_t>(prims.size()) - node.first;
    }
    prims.shrink_to_fit();
    bvh.prims = std::move(prims);
}

}  // namespace boxwood
