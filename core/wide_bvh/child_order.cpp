#include "core/wide_bvh/child_order.h"

#include <bit>
#include <limits>

namespace boxwood {

namespace {

constexpr uint32_t kOctants = 8;
constexpr float kSmallest = std::numeric_limits<float>::min();  ///< two flat boxes reach so far

/// A number for each lane. Loops over all lanes, without branches, for the compiler to do four at a time.
template <uint32_t Width>
using Lanes = std::array<float, Width>;

/// For each of the first four octants: the others that the child is before. 0 for empty lanes, whose centres
/// are NaN.
template <uint32_t Width>
std::array<Lanes<Width>, kOctants / 2> count_wins(const typename WideBvh<Width>::Node& node) {
    Lanes<Width> centers[3], halves[3];
    for (uint32_t axis = 0; axis < 3; ++axis) {
        for (uint32_t lane = 0; lane < Width; ++lane) {
            const float lower = 0.5f * node.lower[axis][lane], upper = 0.5f * node.upper[axis][lane];
            centers[axis][lane] = lower + upper;
            halves[axis][lane] = upper - lower;
        }
    }
    std::array<Lanes<Width>, kOctants / 2> wins{};
    for (uint32_t b = 0; b < Width; ++b) {
        if (node.children[b].is_empty()) break;
        Lanes<Width> separation[3];  // of b from the others
        for (uint32_t axis = 0; axis < 3; ++axis) {
            for (uint32_t a = 0; a < Width; ++a) {
                const float reach = halves[axis][b] + halves[axis][a];
                separation[axis][a] =
                    (centers[axis][b] - centers[axis][a]) / (reach > kSmallest ? reach : kSmallest);
            }
        }
        for (uint32_t octant = 0; octant < kOctants / 2; ++octant) {
            const float x = (octant & 1u) != 0 ? -1.0f : 1.0f, y = (octant & 2u) != 0 ? -1.0f : 1.0f;
            for (uint32_t a = 0; a < Width; ++a) {
                const float sum = x * separation[0][a] + y * separation[1][a] + separation[2][a];
                wins[octant][a] += sum > 0.0f ? 1.0f : 0.0f;
            }
        }
    }
    return wins;
}

}  // namespace

template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node) {
    constexpr uint32_t kBits = std::bit_width(Width - 1), kBytes = Width * kBits / 8;
    const std::array<Lanes<Width>, kOctants / 2> wins = count_wins<Width>(node);
    for (uint32_t octant = 0; octant < kOctants; ++octant) {
        // The other four octants are the opposite ones: there the last child is the first.
        const bool is_opposite = octant >= kOctants / 2;
        const Lanes<Width>& counts = wins[is_opposite ? kOctants - 1 - octant : octant];
        Lanes<Width> keys, ranks{};
        for (uint32_t lane = 0; lane < Width; ++lane) {
            // The lane breaks ties, and empty lanes come last.
            const float count = is_opposite ? -counts[lane] : counts[lane];
            const float kept = node.children[lane].is_empty() ? -float(Width) : count;
            keys[lane] = kept * float(Width) - static_cast<float>(lane);
        }
        for (uint32_t other = 0; other < Width; ++other)
            for (uint32_t lane = 0; lane < Width; ++lane)
                ranks[lane] += keys[other] > keys[lane] ? 1.0f : 0.0f;
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
