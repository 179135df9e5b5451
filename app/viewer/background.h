#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/base/task.h"
#include "core/base/timer.h"

namespace boxwood {

/// What background work does now.
struct WorkProgress {
    bool running = false;  ///< also while a result waits to be taken
    double share = -1.0;   ///< 0 to 1; below 0: not known
    double ms = 0.0;       ///< since the start
};

/// Runs one piece of work at a time in a thread of its own; of several only the newest is finished. Called
/// from one thread.
template <class Result>
class Background {
public:
    using Work = std::function<Result(Task&)>;

    ~Background() {
        cancel();
        thread_.request_stop();
        wake_.notify_all();
    }

    /// Stops what runs and begins this.
    void start(Work work) {
        {
            const std::scoped_lock lock(mutex_);
            stop_.request_stop();
            waiting_ = std::move(work);
            finished_.reset();
            since_ = Timer();
        }
        if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& quit) { run(quit); });
        wake_.notify_all();
    }
    /// Stops what runs; there is no result.
    void cancel() {
        const std::scoped_lock lock(mutex_);
        stop_.request_stop();
        waiting_ = nullptr;
        finished_.reset();
        is_cancelled_ = true;
    }
    /// The result of the newest work, once.
    std::optional<Result> take() {
        const std::scoped_lock lock(mutex_);
        return std::exchange(finished_, std::nullopt);
    }
    WorkProgress progress() const {
        const std::scoped_lock lock(mutex_);
        WorkProgress progress;
        progress.running = waiting_ || finished_ || (task_ && !is_cancelled_);
        if (!progress.running) return progress;
        progress.ms = since_.milliseconds();
        const uint64_t total = task_ ? task_->total.load() : 0, done = task_ ? task_->done.load() : 0;
        if (total > 0)
            progress.share = static_cast<double>(std::min(done, total)) / static_cast<double>(total);
        return progress;
    }
    /// Returns when nothing runs or waits.
    void wait() const {
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [this] { return !task_ && !waiting_; });
    }

private:
    void run(const std::stop_token& quit) {
        std::unique_lock lock(mutex_);
        while (wake_.wait(lock, quit, [this] { return static_cast<bool>(waiting_); })) {
            const Work work = std::exchange(waiting_, nullptr);
            stop_ = std::stop_source();
            is_cancelled_ = false;
            const auto task = std::make_shared<Task>(stop_.get_token());
            task_ = task;
            lock.unlock();
            std::optional<Result> result = work(*task);
            lock.lock();
            task_.reset();
            if (!task->stopped()) finished_ = std::move(result);
            idle_.notify_all();
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    mutable std::condition_variable_any idle_;
    Work waiting_;
    std::stop_source stop_;       ///< of what runs
    std::shared_ptr<Task> task_;  ///< null: nothing runs
    bool is_cancelled_ = false;   ///< what runs is thrown away
    Timer since_;
    std::optional<Result> finished_;
    std::jthread thread_;  ///< made by the first start; last: it is joined first
};

}  // namespace boxwood
