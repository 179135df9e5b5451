#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace boxwood {

/// Processor time of this thread or of the whole process since construction: waiting for a busy machine does
/// not count.
class ProcessorTimer {
public:
    enum class Of { Thread, Process };
    explicit ProcessorTimer(Of of = Of::Thread)
        : clock_(of == Of::Thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID), start_(now()) {}
    double milliseconds() const { return now() - start_; }

private:
    double now() const {
        timespec time{};
        clock_gettime(clock_, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    }
    clockid_t clock_;
    double start_;
};

template <class Run>
double processor_milliseconds(const Run& run) {
    const ProcessorTimer timer;
    run();
    return timer.milliseconds();
}

/// Median over several rounds of the processor time of `run` over that of `base`, both in each round, so that
/// what slows the machine down slows down both. Single-threaded work only.
template <class Run, class Base>
double median_time_ratio(int rounds, const Run& run, const Base& base) {
    std::vector<double> ratios;
    for (int i = 0; i < rounds; ++i) {
        const double base_ms = processor_milliseconds(base);
        ratios.push_back(processor_milliseconds(run) / base_ms);
    }
    std::ranges::sort(ratios);
    return ratios[ratios.size() / 2];
}

}  // namespace boxwood
