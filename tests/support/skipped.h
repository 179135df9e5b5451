#pragma once

#include <cstdint>
#include <string>

#include "core/base/task.h"

namespace boxwood {

/// How many were skipped for the given reason.
inline uint64_t skipped(const Task& task, const std::string& reason) {
    const auto counts = task.skipped.counts();
    const auto found = counts.find(reason);
    return found == counts.end() ? 0 : found->second;
}

}  // namespace boxwood
