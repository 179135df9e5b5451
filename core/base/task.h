#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>

namespace boxwood {

/// What was not done because the scene does not need it, or left out because it is not usable: counts by
/// reason. Thread-safe; add sums, once per batch.
class Skipped {
public:
    void add(const std::string& reason, uint64_t count) {
        if (count == 0) return;
        const std::scoped_lock lock(mutex_);
        counts_[reason] += count;
    }
    std::map<std::string, uint64_t> counts() const {
        const std::scoped_lock lock(mutex_);
        return counts_;
    }

private:
    mutable std::mutex mutex_;
    std::map<std::string, uint64_t> counts_;
};

/// Goes by reference through every stage: cancel, progress and counts without global state. Long loops look
/// at `stopped()` at least every millisecond; after a stop the result is thrown away unread.
struct Task {
    std::stop_token stop;
    std::atomic<uint64_t> done{0};   ///< units of work done, of `total`; the unit is the stage's own
    std::atomic<uint64_t> total{0};  ///< 0: not known
    Skipped skipped;

    Task() = default;
    explicit Task(std::stop_token token) : stop(std::move(token)) {}
    bool stopped() const { return stop.stop_requested(); }
};

}  // namespace boxwood
