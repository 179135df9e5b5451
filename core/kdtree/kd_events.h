#pragma once

#include <array>
#include <bit>
#include <compare>
#include <vector>

#include "core/kdtree/kd_build.h"
#include "core/structure/sah.h"

namespace boxwood {

/// What happens to a piece at a plane that sweeps along an axis, in the order in which it is looked at where
/// planes are equal: a piece that ends at the plane is not to its right, one that starts there not to its
/// left. Planar: it lies in the plane.
enum class KdEventKind : uint32_t { End, Planar, Start };

/// An event as one number, so that events sort by plane, then kind, then piece.
class KdEvent {
public:
    KdEvent() = default;
    /// piece < 2^30, a place among the pieces of a node.
    KdEvent(float plane, KdEventKind kind, uint32_t piece)
        : key_(uint64_t{ordered(plane)} << 32 | uint64_t{static_cast<uint32_t>(kind)} << 30 | piece) {}

    float plane() const {
        const uint32_t bits = static_cast<uint32_t>(key_ >> 32);
        return std::bit_cast<float>((bits & kSign) != 0 ? bits ^ kSign : ~bits);
    }
    KdEventKind kind() const { return static_cast<KdEventKind>(key_ >> 30 & 3); }
    uint32_t piece() const { return static_cast<uint32_t>(key_) & KdTree::kMaxCount; }
    /// The same event of a piece that has another place.
    KdEvent at(uint32_t piece) const {
        KdEvent event;
        event.key_ = (key_ & ~uint64_t{KdTree::kMaxCount}) | piece;
        return event;
    }
    bool is_at_plane_of(const KdEvent& other) const { return (key_ ^ other.key_) >> 32 == 0; }
    auto operator<=>(const KdEvent&) const = default;

private:
    static constexpr uint32_t kSign = 0x80000000u;
    /// Grows with the float; -0 becomes +0.
    static uint32_t ordered(float plane) {
        const uint32_t bits = std::bit_cast<uint32_t>(plane + 0.0f);
        return (bits & kSign) != 0 ? ~bits : bits | kSign;
    }
    uint64_t key_ = 0;
};
static_assert(sizeof(KdEvent) == 8);

/// Events of the pieces of a node, sorted, by axis.
using KdEvents = std::array<std::vector<KdEvent>, 3>;

/// Adds the one event (planar) or the two of a piece on one axis.
inline void add_events(const Box& piece, uint32_t place, int axis, std::vector<KdEvent>& events) {
    const float lower = piece.lower[axis], upper = piece.upper[axis];
    if (lower == upper) {
        events.push_back({lower, KdEventKind::Planar, place});
    } else {
        events.push_back({lower, KdEventKind::Start, place});
        events.push_back({upper, KdEventKind::End, place});
    }
}

/// Costs of a split, in triangle tests.
struct KdCosts {
    double traversal = double(kTraversalCost);
    double empty_bonus = 0.2;  ///< by so much a split is cheaper that leaves one child empty, 0 to 1
};

/// The cheapest split so far; cost is multiplied by the cell's half area, so that a cell without area has one
/// too.
struct KdBestSplit {
    double cost = std::numeric_limits<double>::infinity();
    KdSplit split;
};

/// Weighs each plane of `events` (those of one axis) strictly inside the cell, with the pieces in the plane
/// on the one side and on the other, in one pass: Wald, Havran, "On building fast kd-Trees for Ray Tracing,
/// and on doing that in O(N log N)", RT 2006, algorithm 4. Of equal costs the first counts.
void sweep(std::span<const KdEvent> events, int axis, const Box& cell, size_t piece_count,
           const KdCosts& costs, KdBestSplit& best);

}  // namespace boxwood
