#include "core/wide_bvh/child_order.h"

#include <bit>
#include <cstring>
#include <limits>

#include "core/bvh/box4.h"

namespace boxwood {

namespace {

constexpr uint32_t kOctants = 8;
constexpr float kSmallest = std::numeric_limits<float>::min();  ///< two flat boxes reach so far

/// The lanes of a node, four in each register.
template <uint32_t Width>
using Lanes = std::array<Float4, Width / 4>;
using Short8 = int16_t __attribute__((vector_size(16)));
constexpr Short8 kLane = {0, 1, 2, 3, 4, 5, 6, 7};

Float4 load4(const float* from) {
    Float4 result;
    std::memcpy(&result, from, sizeof result);
    return result;
}

Short8 splat16(uint32_t value) {
    const auto v = static_cast<int16_t>(value);
    return Short8{v, v, v, v, v, v, v, v};
}

/// For each of the first four octants: the others that the child is before. 0 for empty lanes, whose centres
/// are NaN, and for those that the node does not have.
template <uint32_t Width>
std::array<Short8, kOctants / 2> count_wins(const typename WideBvh<Width>::Node& node, uint32_t child_count) {
    Lanes<Width> centers[3], halves[3];
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (uint32_t i = 0; i < Width / 4; ++i) {
            const Float4 lower = splat(0.5f) * load4(&node.lower[axis][4 * i]);
            const Float4 upper = splat(0.5f) * load4(&node.upper[axis][4 * i]);
            centers[axis][i] = lower + upper;
            halves[axis][i] = upper - lower;
        }
    }
    Int4 wins[kOctants / 2][2] = {};
    for (uint32_t b = 0; b < child_count; ++b) {
        for (uint32_t i = 0; i < Width / 4; ++i) {
            Float4 separation[3];  // of b from the others
            for (uint32_t axis = 0; axis < 3; ++axis) {
                const Float4 center = splat(0.5f * node.lower[axis][b] + 0.5f * node.upper[axis][b]);
                const Float4 half = splat(0.5f * node.upper[axis][b] - 0.5f * node.lower[axis][b]);
                const Float4 reach = half + halves[axis][i];
                separation[axis] = (center - centers[axis][i]) / max4(reach, splat(kSmallest));
            }
            const Float4 plus = separation[0] + separation[1], minus = separation[0] - separation[1];
            const Float4 z = separation[2];
            wins[0][i] -= plus + z > 0.0f;  // a comparison that holds is -1
            wins[1][i] -= z - minus > 0.0f;
            wins[2][i] -= minus + z > 0.0f;
            wins[3][i] -= z - plus > 0.0f;
        }
    }
    std::array<Short8, kOctants / 2> counts;
    for (uint32_t octant = 0; octant < kOctants / 2; ++octant)
        counts[octant] =
            __builtin_shufflevector(reinterpret_cast<Short8>(wins[octant][0]),
                                    reinterpret_cast<Short8>(wins[octant][1]), 0, 2, 4, 6, 8, 10, 12, 14);
    return counts;
}

/// For each lane: how many have a larger key.
Short8 ranks_of(Short8 keys) {
    Short8 ranks{};
    for (uint32_t other = 0; other < 8; ++other) {
        const int16_t key = keys[other];
        ranks -= Short8{key, key, key, key, key, key, key, key} > keys;
    }
    return ranks;
}

}  // namespace

template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node) {
    constexpr uint32_t kBits = std::bit_width(Width - 1), kBytes = Width * kBits / 8;
    uint32_t child_count = 0;
    while (child_count < Width && !node.children[child_count].is_empty()) ++child_count;
    const std::array<Short8, kOctants / 2> wins = count_wins<Width>(node, child_count);
    const Short8 is_empty = kLane >= splat16(child_count);
    for (uint32_t octant = 0; octant < kOctants; ++octant) {
        // The other four octants are the opposite ones: there the last child is the first.
        const bool is_opposite = octant >= kOctants / 2;
        const Short8 counts = is_opposite ? -wins[kOctants - 1 - octant] : wins[octant];
        // The lane breaks ties, and empty lanes come last.
        const Short8 kept = is_empty ? splat16(0) - splat16(8) : counts;
        const Short8 ranks = ranks_of(kept * splat16(8) - kLane);
        uint32_t order = 0;
        for (uint32_t lane = 0; lane < Width; ++lane)
            order |= lane << (kBits * static_cast<uint32_t>(ranks[lane]));
        for (uint32_t byte = 0; byte < kBytes; ++byte)
            node.order[kBytes * octant + byte] = static_cast<uint8_t>(order >> (8 * byte));
    }
}

template void set_order<4>(WideBvh<4>::Node&);
template void set_order<8>(WideBvh<8>::Node&);

}  // namespace boxwood
