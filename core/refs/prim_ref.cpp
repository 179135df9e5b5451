#include "core/refs/prim_ref.h"

#include <algorithm>

#include "core/base/assert.h"

namespace boxwood {

std::vector<uint8_t> split_flags(std::span<const PrimRef> refs, size_t triangle_count) {
    std::vector<uint8_t> counts(triangle_count, 0);  // 2 stands for any number above 1
    for (const PrimRef& ref : refs) {
        BOXWOOD_ASSERT(ref.prim < triangle_count);
        if (counts[ref.prim] < 2) ++counts[ref.prim];
    }
    for (uint8_t& count : counts) count = count > 1 ? 1 : 0;
    return counts;
}

std::vector<uint32_t> prims_of(std::span<const PrimRef> refs) {
    std::vector<uint32_t> prims;
    prims.reserve(refs.size());
    for (const PrimRef& ref : refs)
        if (prims.empty() || prims.back() != ref.prim) prims.push_back(ref.prim);
    if (!std::is_sorted(prims.begin(), prims.end())) std::sort(prims.begin(), prims.end());
    prims.erase(std::unique(prims.begin(), prims.end()), prims.end());
    return prims;
}

}  // namespace boxwood
