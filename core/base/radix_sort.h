#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"

namespace boxwood {

/// Sorts by the bits [first_bit, first_bit + bit_count) of key(item), a uint64_t; equal keys keep their
/// order. Least significant digit first, all threads together: each block of items counts its digits, and
/// then moves its items to where these counts say, so that the result does not depend on the threads. As few
/// digits as do, of one length. `spare` has the size of `items`, which it swaps with for each digit: the
/// result is in the span returned.
template <class T, class Key>
std::span<T> radix_sort(std::span<T> items, std::span<T> spare, int first_bit, int bit_count,
                        const Key& key) {
    constexpr int kMostBits = 11;
    constexpr size_t kBlock = size_t{1} << 16;
    using Counts = std::array<uint32_t, size_t{1} << kMostBits>;
    const int digit_count = (bit_count + kMostBits - 1) / kMostBits;
    const int longest = (bit_count + digit_count - 1) / std::max(digit_count, 1);
    std::vector<Counts> blocks((items.size() + kBlock - 1) / kBlock);
    for (int bit = first_bit; bit < first_bit + bit_count; bit += longest) {
        const int digit_bits = std::min(longest, first_bit + bit_count - bit);
        const size_t digits = size_t{1} << digit_bits;
        const uint64_t mask = digits - 1;
        const auto digit = [&](const T& item) { return (key(item) >> bit) & mask; };
        parallel_for(items.size(), kBlock, [&](size_t begin, size_t end) {
            Counts& counts = blocks[begin / kBlock];
            std::fill_n(counts.begin(), digits, 0u);
            for (size_t i = begin; i < end; ++i) ++counts[digit(items[i])];
        });
        uint32_t place = 0;
        for (size_t d = 0; d < digits; ++d)
            for (Counts& counts : blocks) place += std::exchange(counts[d], place);
        parallel_for(items.size(), kBlock, [&](size_t begin, size_t end) {
            Counts& places = blocks[begin / kBlock];
            for (size_t i = begin; i < end; ++i) spare[places[digit(items[i])]++] = items[i];
        });
        std::swap(items, spare);
    }
    return items;
}

}  // namespace boxwood
