#include "app/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

namespace boxwood {

Progress::Progress(std::string what, const Task& task) : what_(std::move(what)), task_(task) {
    if (::isatty(STDERR_FILENO) != 0) thread_ = std::thread([this] { show(); });
}

Progress::~Progress() {
    if (!thread_.joinable()) return;
    {
        const std::scoped_lock lock(mutex_);
        end_ = true;
    }
    ended_.notify_one();
    thread_.join();
}

void Progress::show() {
    using namespace std::chrono_literals;
    std::unique_lock lock(mutex_);
    if (ended_.wait_for(lock, 1s, [this] { return end_; })) return;
    do {
        const uint64_t total = task_.total;
        const uint64_t done = std::min(task_.done.load(), total);
        if (total > 0) {
            std::fprintf(stderr, "\r\033[K%s: %.0f %%", what_.c_str(),
                         100.0 * static_cast<double>(done) / static_cast<double>(total));
        } else {
            std::fprintf(stderr, "\r\033[K%s ...", what_.c_str());
        }
        std::fflush(stderr);
    } while (!ended_.wait_for(lock, 200ms, [this] { return end_; }));
    std::fputs("\r\033[K", stderr);
}

}  // namespace boxwood
