// Nodes as the rays of one octant meet them, once for each instruction set.
#if defined(BOXWOOD_OCTANT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_OCTANT_INL_H
#undef BOXWOOD_OCTANT_INL_H
#else
#define BOXWOOD_OCTANT_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstring>

#include "core/wide_bvh/wide_bvh.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

/// Bit i: lane i, of up to 16.
template <class D>
HWY_INLINE uint32_t mask_bits(D d, hn::Mask<D> mask) {
    uint8_t bytes[8];
    hn::StoreMaskBits(d, mask, bytes);
    if constexpr (hn::MaxLanes(d) <= 8) return bytes[0];
    uint16_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}

/// The other way.
template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, uint32_t bits) {
    const uint8_t bytes[8] = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
    return hn::LoadMaskBits(d, bytes);
}

#if HWY_TARGET > HWY_AVX3
/// Lanes of the set bits of a mask, ascending; the rest is 0.
struct LanesOfMask {
    uint8_t lanes[256][8]{};
    constexpr LanesOfMask() {
        for (uint32_t mask = 0; mask < 256; ++mask) {
            uint32_t count = 0;
            for (uint8_t lane = 0; lane < 8; ++lane)
                if ((mask >> lane & 1) != 0) lanes[mask][count++] = lane;
        }
    }
};
alignas(64) constexpr LanesOfMask kLanesOfMask;
#endif

/// The lanes of a mask first. Highway 1.0's own is slow where the processor has no such instruction.
template <class D>
HWY_INLINE hn::Vec<D> lanes_first(D d, hn::Vec<D> v, [[maybe_unused]] hn::Mask<D> mask,
                                  [[maybe_unused]] uint32_t bits) {
#if HWY_TARGET <= HWY_AVX3
    static_cast<void>(d);
    return hn::Compress(v, mask);
#else
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<uint8_t, D> d8;
    const auto lanes = hn::PromoteTo(du, hn::LoadU(d8, kLanesOfMask.lanes[bits]));
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes));
#endif
}

/// Places of the near and far planes of rays of an octant in a node, by axis, in floats.
template <uint32_t Width>
struct Planes {
    uint32_t near[3], far[3];

    HWY_INLINE explicit Planes(uint32_t octant) {
        set_axis(octant, 0);
        set_axis(octant, 1);
        set_axis(octant, 2);
    }
    HWY_INLINE void set_axis(uint32_t octant, uint32_t axis) {
        const bool is_negative = (octant >> axis & 1) != 0;
        near[axis] = (is_negative ? 3 + axis : axis) * Width;
        far[axis] = (is_negative ? axis : 3 + axis) * Width;
    }
};

/// The children of nodes front to back, for the rays of one octant.
template <uint32_t Width>
class ChildLanes {
public:
    using D = hn::CappedTag<float, Width>;
    using DU = hn::RebindToUnsigned<D>;
    using V = hn::Vec<D>;
    using VU = hn::Vec<DU>;
    using Node = typename WideBvh<Width>::Node;
    static constexpr uint32_t kParts = Width / hn::MaxLanes(D());  ///< vectors for all lanes of a node
    /// Whether push_met() is there. Of four lanes and more than one vector it would be slower than a loop.
    static constexpr bool kHasPush = kParts == 1 || (kParts == 2 && hn::MaxLanes(D()) == 8);

    HWY_INLINE explicit ChildLanes(uint32_t octant)
        : octant_(octant),
          row_(octant < 4 ? octant : 7 - octant),
          last_word_(octant < 4 ? 1 : 0),
          last_place_(octant < 4 ? Width - 1 : 0) {
        HWY_ALIGN static constexpr uint32_t kPlaces[2][16] = {
            {7, 6, 5, 4, 3, 2, 1, 0, 7, 6, 5, 4, 3, 2, 1, 0},
            {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7}};
        const VU places = hn::LoadU(DU(), octant < 4 ? kPlaces[0] + (Width == 4 ? 4 : 0) : kPlaces[1]);
        shifts_ = hn::Mul(places, hn::Set(DU(), WideBvh<Width>::kLaneBits));
    }
    /// Calls visit(lane) for each of the lanes whose bits are set in `met`, back to front.
    template <class Visit>
    HWY_INLINE void for_each_back_to_front(const Node& node, uint32_t met, Visit&& visit) const {
        for (uint32_t rank = Width; met != 0; --rank) {
            const uint32_t lane = node.lane_at(octant_, rank - 1);
            if ((met >> lane & 1) == 0) continue;
            met &= ~(1u << lane);
            visit(lane);
        }
    }
    /// Of the children with entry <= exit, one at least, adds entry and number to the stack, back to front,
    /// but for the nearest, whose lane is returned: it does not wait for the stack's memory. Writes whole
    /// vectors.
    HWY_INLINE uint32_t push_met(const Node& node, const V (&entry)[kParts], const V (&exit)[kParts],
                                 const VU (&numbers)[kParts], float* entries, uint32_t* stacked,
                                 uint32_t& count) const {
        const D d;
        const DU du;
        uint32_t ranks = 0;  // bit i: the lane that is the i-th from the back
        for (uint32_t part = 0; part < kParts; ++part) {
            const VU lanes = back_to_front(node, part);
            const V entry_here = lookup(entry, lanes);
            const V number = lookup(numbers, lanes);
            const auto is_met = hn::Le(entry_here, lookup(exit, lanes));
            const uint32_t bits = mask_bits(d, is_met);
            hn::StoreU(lanes_first(d, entry_here, is_met, bits), d, entries + count);
            hn::StoreU(hn::BitCast(du, lanes_first(d, number, is_met, bits)), du, stacked + count);
            count += static_cast<uint32_t>(std::popcount(bits));
            ranks |= bits << (part * hn::MaxLanes(d));
        }
        --count;
        const auto nearest = 31 - static_cast<uint32_t>(hwy::Num0BitsAboveMS1Bit_Nonzero32(ranks));
        const uint32_t place = nearest ^ last_place_;
        return static_cast<uint32_t>(node.orders[row_] >> (WideBvh<Width>::kLaneBits * place)) & (Width - 1);
    }

private:
    /// Sixteen lanes have an order of two words: half of the lanes from each.
    HWY_INLINE VU back_to_front(const Node& node, [[maybe_unused]] uint32_t part) const {
        const DU du;
        VU order;
        if constexpr (Width < 16) {
            order = hn::Set(du, node.orders[row_]);
        } else {
            const VU back = hn::Set(du, word(node.orders[row_], last_word_ ^ part));
            if constexpr (kParts == 1) {
                order = hn::IfThenElse(hn::FirstN(du, 8), back,
                                       hn::Set(du, word(node.orders[row_], last_word_ ^ 1)));
            } else {
                order = back;
            }
        }
        return hn::And(hn::Shr(order, shifts_), hn::Set(du, Width - 1));
    }
    static HWY_INLINE uint32_t word(const uint64_t& order, uint32_t number) {
        uint32_t result;
        std::memcpy(&result, reinterpret_cast<const char*>(&order) + sizeof result * number, sizeof result);
        return result;
    }
    template <class Vector>
    static HWY_INLINE V lookup(const Vector (&parts)[kParts], VU lanes) {
        const D d;
        const DU du;
        if constexpr (kParts == 1) {
            return hn::TableLookupLanes(hn::BitCast(d, parts[0]), hn::IndicesFromVec(d, lanes));
        } else {
            constexpr uint32_t kLanes = hn::MaxLanes(D());
            const auto in_part = hn::IndicesFromVec(d, hn::And(lanes, hn::Set(du, kLanes - 1)));
            const auto is_first = hn::RebindMask(d, hn::Lt(lanes, hn::Set(du, kLanes)));
            return hn::IfThenElse(is_first, hn::TableLookupLanes(hn::BitCast(d, parts[0]), in_part),
                                  hn::TableLookupLanes(hn::BitCast(d, parts[1]), in_part));
        }
    }

    uint32_t octant_;
    uint32_t row_;         ///< of the orders
    uint32_t last_word_;   ///< of an order of two, that of the farthest lanes
    uint32_t last_place_;  ///< in an order, of the farthest lane
    VU shifts_;            ///< of the lanes back to front, in an order or half of it
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#endif
