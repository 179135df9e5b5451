#include "core/structure/tested_prims.h"

#include <utility>

namespace boxwood {

void TestedPrims::grow() {
    const uint32_t old_size = mask_ + 1;
    std::vector<uint32_t> larger(2 * size_t{old_size}, kNoIndex);
    mask_ = 2 * old_size - 1;
    --shift_;
    for (uint32_t i = 0; i < old_size; ++i) {
        if (slots_[i] == kNoIndex) continue;
        uint32_t slot = first_slot(slots_[i]);
        while (larger[slot] != kNoIndex) slot = (slot + 1) & mask_;
        larger[slot] = slots_[i];
    }
    heap_ = std::move(larger);
    slots_ = heap_.data();
}

}  // namespace boxwood
