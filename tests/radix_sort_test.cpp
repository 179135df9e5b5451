#include "core/base/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/rng.h"

namespace boxwood {
namespace {

TEST(RadixSort, SortsByTheBitsAskedForAndKeepsTheOrderOfEqualOnes) {
    struct Item {
        uint64_t key;
        uint32_t number;
        bool operator==(const Item&) const = default;
    };
    for (const uint32_t count : {0u, 1u, 2u, 1000u, 200'000u}) {  // the last is more than one block
        Rng rng(7);
        std::vector<Item> items(count), spare(count);
        for (uint32_t i = 0; i < count; ++i) items[i] = {mix_bits(rng.next_index(count / 2 + 1)), i};
        for (const int bits : {10, 30, 33}) {
            const int first = 5;
            const auto key = [&](const Item& item) {
                return (item.key >> first) & ((uint64_t{1} << bits) - 1);
            };
            std::vector<Item> expected = items, sorted = items;
            std::stable_sort(expected.begin(), expected.end(),
                             [&](const Item& a, const Item& b) { return key(a) < key(b); });
            const std::span<Item> result = radix_sort(std::span(sorted), std::span(spare), first, bits,
                                                      [](const Item& item) { return item.key; });
            EXPECT_TRUE(std::equal(result.begin(), result.end(), expected.begin(), expected.end()))
                << count << " items, " << bits << " bits";
        }
    }
}

}  // namespace
}  // namespace boxwood
