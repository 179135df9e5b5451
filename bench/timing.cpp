#include "bench/timing.h"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <limits>

namespace boxwood::bench {

double process_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double clock_ms(int threads) {
    if (threads == 1) return process_ms();
    const auto since_epoch = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double, std::milli>(since_epoch).count();
}

CorePin::CorePin() : before_(sizeof(cpu_set_t)) {
    cpu_set_t cores;
    if (sched_getaffinity(0, sizeof cores, &cores) != 0) return;
    std::memcpy(before_.data(), &cores, sizeof cores);
    const int core = sched_getcpu();
    if (core < 0) return;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<size_t>(core), &cores);
    is_pinned_ = sched_setaffinity(0, sizeof cores, &cores) == 0;
}

CorePin::~CorePin() {
    if (!is_pinned_) return;
    cpu_set_t cores;
    std::memcpy(&cores, before_.data(), sizeof cores);
    sched_setaffinity(0, sizeof cores, &cores);
}

bool flushes_to_zero() {
    volatile float tiny = 0x1p-140f;  // subnormal
    const float same = tiny * 1.0f;
    return same == 0.0f;
}

double median_of(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace boxwood::bench
