#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace boxwood {
namespace {

TEST(ParallelFor, CallsEveryIndexOnceInRangesThatDoNotDependOnTheThreads) {
    std::vector<std::atomic<int>> calls(1001);
    parallel_for(calls.size(), 64, [&](size_t begin, size_t end) {
        EXPECT_EQ(begin % 64, 0u);
        for (size_t i = begin; i < end; ++i) ++calls[i];
    });
    for (const std::atomic<int>& count : calls) EXPECT_EQ(count.load(), 1);
}

TEST(ThreadLimit, HoldsWhileItLives) {
    const int before = thread_count();
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(thread_count(), 1);
    }
    EXPECT_EQ(thread_count(), before);
}

}  // namespace
}  // namespace boxwood
