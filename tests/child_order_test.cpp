#include "core/wide_bvh/child_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/rng.h"
#include "support/random_mesh.h"
#include "support/simd_targets.h"

namespace boxwood {
namespace {

/// The lanes front to back for the rays of an octant, by the definition.
template <uint32_t Width>
std::vector<uint32_t> front_to_back(const typename WideBvh<Width>::Node& node, uint32_t octant,
                                    uint32_t child_count) {
    const auto is_before = [&](uint32_t a, uint32_t b) {
        float separation[3];
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const auto center = [&](uint32_t lane) {
                return 0.5f * node.lower[axis][lane] + 0.5f * node.upper[axis][lane];
            };
            const auto half = [&](uint32_t lane) {
                return 0.5f * node.upper[axis][lane] - 0.5f * node.lower[axis][lane];
            };
            const float reach = std::max(half(b) + half(a), std::numeric_limits<float>::min());
            separation[axis] = (center(b) - center(a)) / reach;
            if ((octant >> axis & 1) != 0) separation[axis] = -separation[axis];
        }
        return separation[0] + separation[1] + separation[2] > 0.0f;
    };
    std::vector<uint32_t> wins(Width, 0), lanes;
    for (uint32_t a = 0; a < Width; ++a) lanes.push_back(a);
    for (uint32_t a = 0; a < child_count; ++a)
        for (uint32_t b = 0; b < child_count; ++b) wins[a] += is_before(a, b) ? 1 : 0;
    std::ranges::stable_sort(lanes.begin(), lanes.begin() + child_count, std::ranges::greater{},
                             [&](uint32_t lane) { return wins[lane]; });
    return lanes;
}

/// Boxes of one size and place or another; some flat, some equal.
template <uint32_t Width>
typename WideBvh<Width>::Node any_node(Rng& rng, uint32_t child_count, float size) {
    typename WideBvh<Width>::Node node{};
    for (uint32_t lane = 0; lane < Width; ++lane) {
        Box box;  // empty
        if (lane < child_count) {
            const Vec3 a = random_point(rng, size), b = random_point(rng, size);
            box.extend(a);
            box.extend(rng.next_index(3) == 0 ? Vec3(a.x, b.y, a.z) : a + 0.25f * b);
            if (lane > 0 && rng.next_index(5) == 0) box = node.bounds(lane - 1);
            node.children[lane] = WideChild::inner(lane);
        }
        for (uint32_t axis = 0; axis < 3; ++axis) {
            node.lower[axis][lane] = box.lower[axis];
            node.upper[axis][lane] = box.upper[axis];
        }
    }
    return node;
}

template <uint32_t Width>
void expect_the_definition() {
    Rng rng(Width);
    for (int i = 0; i < 500; ++i) {
        const auto child_count = static_cast<uint32_t>(rng.next_index(Width + 1));
        constexpr float kSizes[] = {1.0f, 1e-41f, 1e-30f, 1e30f, 1e38f};
        auto node = any_node<Width>(rng, child_count, kSizes[i % std::size(kSizes)]);
        set_order<Width>(node);
        for (uint32_t octant = 0; octant < 4; ++octant) {
            const std::vector<uint32_t> expected = front_to_back<Width>(node, octant, child_count);
            for (uint32_t rank = 0; rank < Width; ++rank)
                ASSERT_EQ(node.lane_at(octant, rank), expected[rank]) << i << ", octant " << octant;
        }
    }
}

TEST(ChildOrder, IsThatOfTheDefinitionWithEveryInstructionSet) {
    for_each_target(HWY_TARGETS, [](const SimdTarget& target) {
        SCOPED_TRACE(target.name());
        expect_the_definition<4>();
        expect_the_definition<8>();
        expect_the_definition<16>();
    });
}

}  // namespace
}  // namespace boxwood
