#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "core/base/task.h"

namespace boxwood {

/// While it lives, and once a second has passed, one line on standard error says what is being done and how
/// much of it is done; at its end the line is wiped. Silent where standard error is no terminal.
class Progress {
public:
    /// `task` is watched and must outlive this.
    Progress(std::string what, const Task& task);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

private:
    void show();
    std::string what_;
    const Task& task_;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool end_ = false;
    std::thread thread_;
};

}  // namespace boxwood
