#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/octant_test.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <span>
#include <vector>

#include "core/wide_bvh/octant-inl.h"

#ifndef BOXWOOD_TESTS_OCTANT
#define BOXWOOD_TESTS_OCTANT
namespace boxwood {

/// What becomes of a node of which some children are met: the lanes that are to be visited, the last one
/// first, and what stands beside them on the stack. The lane is the number, ten times the lane the entry.
struct Pushed {
    std::vector<uint32_t> lanes;
    std::vector<float> entries;
};

}  // namespace boxwood
#endif

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

template <uint32_t Width>
void push(const typename WideBvh<Width>::Node&, uint32_t, uint32_t, Pushed&) {}

#else

template <uint32_t Width>
HWY_NOINLINE void push(const typename WideBvh<Width>::Node& node, uint32_t octant, uint32_t met,
                       Pushed& pushed) {
    using Lanes = ChildLanes<Width>;
    const Lanes lanes(octant);
    if constexpr (Lanes::kHasPush) {
        const typename Lanes::D d;
        const typename Lanes::DU du;
        HWY_ALIGN float entry[Width], exit[Width];
        HWY_ALIGN uint32_t number[Width];
        for (uint32_t lane = 0; lane < Width; ++lane) {
            entry[lane] = 10.0f * static_cast<float>(lane);
            exit[lane] = (met >> lane & 1) != 0 ? entry[lane] : -1.0f;
            number[lane] = lane;
        }
        typename Lanes::V entries[Lanes::kParts], exits[Lanes::kParts];
        typename Lanes::VU numbers[Lanes::kParts];
        for (uint32_t part = 0; part < Lanes::kParts; ++part) {
            const size_t first = part * hn::MaxLanes(d);
            entries[part] = hn::Load(d, entry + first);
            exits[part] = hn::Load(d, exit + first);
            numbers[part] = hn::Load(du, number + first);
        }
        float stacked_entries[2 * Width];
        uint32_t stacked[2 * Width], count = 0;
        const uint32_t nearest =
            lanes.push_met(node, entries, exits, numbers, stacked_entries, stacked, count);
        pushed.lanes.assign(stacked, stacked + count);
        pushed.entries.assign(stacked_entries, stacked_entries + count);
        pushed.lanes.push_back(nearest);
        pushed.entries.push_back(10.0f * static_cast<float>(nearest));
    } else {
        lanes.for_each_back_to_front(node, met, [&](uint32_t lane) {
            pushed.lanes.push_back(lane);
            pushed.entries.push_back(10.0f * static_cast<float>(lane));
        });
    }
}

#endif

void push4(const WideBvh<4>::Node& node, uint32_t octant, uint32_t met, Pushed& pushed) {
    push<4>(node, octant, met, pushed);
}
void push8(const WideBvh<8>::Node& node, uint32_t octant, uint32_t met, Pushed& pushed) {
    push<8>(node, octant, met, pushed);
}
void push16(const WideBvh<16>::Node& node, uint32_t octant, uint32_t met, Pushed& pushed) {
    push<16>(node, octant, met, pushed);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/rng.h"
#include "support/simd_targets.h"

namespace boxwood {
namespace {

HWY_EXPORT(push4);
HWY_EXPORT(push8);
HWY_EXPORT(push16);

/// Any order of all lanes for each of the four octants.
template <uint32_t Width>
typename WideBvh<Width>::Node any_node(Rng& rng) {
    using Order = typename WideBvh<Width>::Order;
    typename WideBvh<Width>::Node node{};
    for (Order& order : node.orders) {
        std::vector<uint32_t> lanes(Width);
        for (uint32_t lane = 0; lane < Width; ++lane) lanes[lane] = lane;
        for (uint32_t rank = Width; rank > 1; --rank) std::swap(lanes[rank - 1], lanes[rng.next_index(rank)]);
        uint64_t bits = 0;
        for (uint32_t rank = Width; rank-- > 0;) bits = bits << WideBvh<Width>::kLaneBits | lanes[rank];
        order = static_cast<Order>(bits);
    }
    return node;
}

template <uint32_t Width, class Push>
void expect_order_of_the_octant(const Push& push) {
    Rng rng(Width);
    for (int i = 0; i < 200; ++i) {
        const auto node = any_node<Width>(rng);
        const auto met = static_cast<uint32_t>(1 + rng.next_index((size_t{1} << Width) - 1));
        for (uint32_t octant = 0; octant < 8; ++octant) {
            std::vector<uint32_t> expected;
            for (uint32_t rank = Width; rank-- > 0;)
                if ((met >> node.lane_at(octant, rank) & 1) != 0)
                    expected.push_back(node.lane_at(octant, rank));
            Pushed pushed;
            push(node, octant, met, pushed);
            ASSERT_EQ(pushed.lanes, expected) << Width << " children, octant " << octant;
            for (size_t k = 0; k < expected.size(); ++k)
                ASSERT_EQ(pushed.entries[k], 10.0f * static_cast<float>(expected[k]));
        }
    }
}

TEST(Octant, ChildrenThatAreMetStandBackToFrontWithEveryInstructionSet) {
    for_each_vector_target(HWY_TARGETS, [](const std::string& target, bool) {
        SCOPED_TRACE(target);
        expect_order_of_the_octant<4>([](auto&... of) { HWY_DYNAMIC_DISPATCH(push4)(of...); });
        expect_order_of_the_octant<8>([](auto&... of) { HWY_DYNAMIC_DISPATCH(push8)(of...); });
        expect_order_of_the_octant<16>([](auto&... of) { HWY_DYNAMIC_DISPATCH(push16)(of...); });
    });
}

}  // namespace
}  // namespace boxwood

#endif
