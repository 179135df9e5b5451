#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace boxwood {

/// The primitives that one ray has tested, in a structure whose cells share them: a hash set with open
/// addressing. Exact: it forgets none. The first kInline / 2 need no memory from the heap.
class TestedPrims {
public:
    TestedPrims() { inline_.fill(kNoIndex); }
    TestedPrims(const TestedPrims&) = delete;
    TestedPrims& operator=(const TestedPrims&) = delete;

    /// Adds the primitive; false if it was there. Not for kNoIndex.
    bool add(uint32_t prim) {
        uint32_t slot = first_slot(prim);
        while (slots_[slot] != kNoIndex) {
            if (slots_[slot] == prim) return false;
            slot = (slot + 1) & mask_;
        }
        slots_[slot] = prim;
        if (2 * ++count_ > mask_) grow();
        return true;
    }

private:
    static constexpr uint32_t kInline = 128;

    /// Fibonacci hashing: the upper bits of a product with 2^32 / golden ratio.
    uint32_t first_slot(uint32_t prim) const { return (prim * 0x9e3779b9u) >> shift_; }
    void grow();

    std::array<uint32_t, kInline> inline_;
    std::vector<uint32_t> heap_;
    uint32_t* slots_ = inline_.data();
    uint32_t mask_ = kInline - 1;
    uint32_t shift_ = 32 - static_cast<uint32_t>(std::bit_width(kInline - 1));
    uint32_t count_ = 0;
};

}  // namespace boxwood
