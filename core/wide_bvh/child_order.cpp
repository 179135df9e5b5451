#include "core/wide_bvh/child_order.h"

#include <cstring>
#include <limits>

#include "core/bvh/box4.h"

namespace boxwood {

namespace {

constexpr uint32_t kOctants = 4;                                ///< the others are their opposites
constexpr float kSmallest = std::numeric_limits<float>::min();  ///< two flat boxes reach so far

/// The lanes of a node, four in each register.
template <uint32_t Width>
using Lanes = std::array<Float4, Width / 4>;
using Short8 = int16_t __attribute__((vector_size(16)));
constexpr Short8 kLane = {0, 1, 2, 3, 4, 5, 6, 7};
/// A small number for each lane of a node, eight in each register.
template <uint32_t Width>
using Numbers = std::array<Short8, (Width + 7) / 8>;

Float4 load4(const float* from) {
    Float4 result;
    std::memcpy(&result, from, sizeof result);
    return result;
}

Short8 splat16(uint32_t value) {
    const auto v = static_cast<int16_t>(value);
    return Short8{v, v, v, v, v, v, v, v};
}

/// For each octant: the others that the child is before. 0 for empty lanes, whose centres are NaN, and for
/// those that the node does not have.
template <uint32_t Width>
std::array<Numbers<Width>, kOctants> count_wins(const typename WideBvh<Width>::Node& node,
                                                uint32_t child_count) {
    Lanes<Width> centers[3], halves[3];
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (uint32_t i = 0; i < Width / 4; ++i) {
            const Float4 lower = splat(0.5f) * load4(&node.lower[axis][4 * i]);
            const Float4 upper = splat(0.5f) * load4(&node.upper[axis][4 * i]);
            centers[axis][i] = lower + upper;
            halves[axis][i] = upper - lower;
        }
    }
    Int4 wins[kOctants][2 * Numbers<Width>().size()] = {};
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
    std::array<Numbers<Width>, kOctants> counts;
    for (uint32_t octant = 0; octant < kOctants; ++octant)
        for (uint32_t i = 0; i < counts[octant].size(); ++i)
            counts[octant][i] = __builtin_shufflevector(reinterpret_cast<Short8>(wins[octant][2 * i]),
                                                        reinterpret_cast<Short8>(wins[octant][2 * i + 1]), 0,
                                                        2, 4, 6, 8, 10, 12, 14);
    return counts;
}

/// The lanes by descending counts. Of equal ones the first comes first, and empty lanes come last.
template <uint32_t Width>
typename WideBvh<Width>::Order order_of(const Numbers<Width>& counts, uint32_t child_count) {
    using Order = typename WideBvh<Width>::Order;
    Numbers<Width> keys, ranks{};
    for (uint32_t i = 0; i < keys.size(); ++i) {
        const Short8 lane = kLane + splat16(8 * i);
        const Short8 kept = lane >= splat16(child_count) ? splat16(0) - splat16(1) : counts[i];
        keys[i] = kept * splat16(Width) - lane;
    }
    for (uint32_t other = 0; other < Width; ++other) {
        const int16_t key = keys[other / 8][other % 8];
        for (uint32_t i = 0; i < keys.size(); ++i)
            ranks[i] -= Short8{key, key, key, key, key, key, key, key} > keys[i];
    }
    Order order = 0;
    for (uint32_t lane = 0; lane < Width; ++lane) {
        const auto rank = static_cast<uint32_t>(ranks[lane / 8][lane % 8]);
        order = static_cast<Order>(order | static_cast<Order>(lane) << (WideBvh<Width>::kLaneBits * rank));
    }
    return order;
}

}  // namespace

template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node) {
    uint32_t child_count = 0;
    while (child_count < Width && !node.children[child_count].is_empty()) ++child_count;
    const std::array<Numbers<Width>, kOctants> wins = count_wins<Width>(node, child_count);
    for (uint32_t octant = 0; octant < kOctants; ++octant)
        node.orders[octant] = order_of<Width>(wins[octant], child_count);
}

template void set_order<4>(WideBvh<4>::Node&);
template void set_order<8>(WideBvh<8>::Node&);
template void set_order<16>(WideBvh<16>::Node&);

}  // namespace boxwood
