#include "core/base/array.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>

#include "support/sanitized.h"

namespace boxwood {
namespace {

TEST(Array, KeepsWhatItHoldsAsItGrowsBeyondALargePage) {
    Array<uint32_t> array;
    for (uint32_t i = 0; i < 3 * kLargePage / sizeof(uint32_t); ++i) array.push_back(i);
    for (uint32_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], i);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(array.data()) % kLargePage, 0u);
}

TEST(Array, MemoryThatWasFreedIsThereAgain) {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers keep freed memory from being used again";
    constexpr size_t kSize = 4 * kLargePage;
    void* const first = allocate_kept(kSize);
    free_kept(first, kSize);
    void* const second = allocate_kept(kSize);
    EXPECT_EQ(second, first);
    free_kept(second, kSize);
}

/// Of this process, in bytes that are in memory.
size_t resident_size() {
    std::ifstream file("/proc/self/statm");
    size_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * 4096;
}

TEST(Array, WhatIsKeptCanBeGivenBack) {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers keep freed memory";
    constexpr size_t kSize = size_t{96} << 20;
    void* const memory = allocate_kept(kSize);
    std::memset(memory, 1, kSize);
    const size_t used = resident_size();
    if (used == 0) GTEST_SKIP() << "no /proc";
    free_kept(memory, kSize);
    release_kept_memory();
    EXPECT_LT(resident_size(), used - kSize / 2);
}

TEST(Array, WhatNoMachineHasIsRefused) {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers end the program instead";
    EXPECT_THROW(allocate_kept(size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace boxwood
