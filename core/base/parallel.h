#pragma once

#include <cstddef>
#include <functional>

namespace boxwood {

/// Threads that parallel loops use at most, the caller's included: the machine's cores, or what limit_threads
/// says.
int thread_count();

/// While it lives, parallel loops use at most `count` threads (1 or more). Used by `--threads` and by tests
/// that compare one thread with many.
class ThreadLimit {
public:
    explicit ThreadLimit(int count);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    void* control_;
};

/// Calls body(begin, end) for disjoint ranges that cover [0, count), each of `grain` items but the last, on
/// all threads. The ranges do not depend on the number of threads. Nested calls are allowed.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

/// Runs both, in parallel where a thread is free.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace boxwood
