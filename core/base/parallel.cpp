#include "core/base/parallel.h"

#include <algorithm>
#include <thread>

#ifdef BOXWOOD_STD_THREADS
#include <atomic>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#endif

namespace boxwood {

#ifdef BOXWOOD_STD_THREADS

// The tsan preset: the packaged TBB is not instrumented.
namespace {
std::atomic<int> g_thread_limit{0};
}

int thread_count() {
    const int limit = g_thread_limit.load();
    return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ThreadLimit::ThreadLimit(int count) : control_(nullptr) { g_thread_limit = std::max(1, count); }
ThreadLimit::~ThreadLimit() { g_thread_limit = 0; }

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    const size_t range_count = (count + grain - 1) / grain;
    std::atomic<size_t> next{0};
    const auto work = [&] {
        for (size_t i = next++; i < range_count; i = next++)
            body(i * grain, std::min(count, (i + 1) * grain));
    };
    std::vector<std::jthread> threads;
    const size_t wanted = std::min(range_count, static_cast<size_t>(thread_count()));
    for (size_t i = 1; i < wanted; ++i) threads.emplace_back(work);
    work();
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    if (thread_count() == 1) {
        first();
        second();
        return;
    }
    const std::jthread thread(first);
    second();
}

#else

int thread_count() {
    const size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<int>(std::min(allowed, static_cast<size_t>(tbb::this_task_arena::max_concurrency())));
}

ThreadLimit::ThreadLimit(int count)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<size_t>(std::max(1, count)))) {}
ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    const size_t range_count = (count + grain - 1) / grain;
    if (range_count == 1) return body(0, count);
    tbb::parallel_for(size_t{0}, range_count,
                      [&](size_t i) { body(i * grain, std::min(count, (i + 1) * grain)); });
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    tbb::parallel_invoke(first, second);
}

#endif

}  // namespace boxwood
