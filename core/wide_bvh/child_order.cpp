#include "core/wide_bvh/child_order.h"

#include <bit>

namespace boxwood {

namespace {

constexpr uint32_t kOctants = 8;

/// How far b lies beyond a along each axis, 1 where they touch. Infinite for different flat places.
DVec3 separation(const Box& a, const Box& b) {
    const DVec3 distance = DVec3(b.lower) - DVec3(a.lower) + DVec3(b.upper) - DVec3(a.upper);
    const DVec3 reach = a.extent() + b.extent();
    DVec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis)
        if (distance[axis] != 0.0) result[axis] = distance[axis] / reach[axis];
    return result;
}

/// wins[octant][lane]: others that the child is before, less those that it is behind.
template <uint32_t Width>
using Wins = std::array<std::array<int, Width>, kOctants>;

template <uint32_t Width>
Wins<Width> count_wins(const typename WideBvh<Width>::Node& node) {
    Wins<Width> wins{};
    for (uint32_t b = 1; b < Width; ++b) {
        if (node.children[b].is_empty()) break;
        for (uint32_t a = 0; a < b; ++a) {
            const DVec3 d = separation(node.bounds(a), node.bounds(b));
            for (uint32_t octant = 0; octant < kOctants; ++octant) {
                const double sum = ((octant & 1u) != 0 ? -d.x : d.x) + ((octant & 2u) != 0 ? -d.y : d.y) +
                                   ((octant & 4u) != 0 ? -d.z : d.z);
                const int win = (sum > 0.0 ? 1 : 0) - (sum < 0.0 ? 1 : 0);  // 0 for a NaN
                wins[octant][a] += win;
                wins[octant][b] -= win;
            }
        }
    }
    return wins;
}

}  // namespace

template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node) {
    constexpr uint32_t kBits = std::bit_width(Width - 1), kBytes = Width * kBits / 8;
    const Wins<Width> wins = count_wins<Width>(node);
    for (uint32_t octant = 0; octant < kOctants; ++octant) {
        uint32_t order = 0;
        for (uint32_t lane = 0; lane < Width; ++lane) {
            uint32_t rank = 0;
            for (uint32_t other = 0; other < Width; ++other) {
                if (node.children[lane].is_empty() || node.children[other].is_empty()) {
                    rank += other < lane ? 1 : 0;  // empty lanes are the last ones
                    continue;
                }
                const int lead = wins[octant][other] - wins[octant][lane];
                rank += lead > 0 || (lead == 0 && other < lane) ? 1 : 0;
            }
            order |= lane << (kBits * rank);
        }
        for (uint32_t byte = 0; byte < kBytes; ++byte)
            node.order[kBytes * octant + byte] = static_cast<uint8_t>(order >> (8 * byte));
    }
}

template void set_order<4>(WideBvh<4>::Node&);
template void set_order<8>(WideBvh<8>::Node&);

}  // namespace boxwood
