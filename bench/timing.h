#pragma once

#include <vector>

namespace boxwood::bench {

/// Milliseconds of processor time that the process has used, all threads together.
double process_ms();

/// Milliseconds on the clock by which work on so many threads is timed: of one thread the processor time of
/// the process, as a busy machine counts less; of more the wall clock's.
double clock_ms(int threads);

/// While it lives, the calling thread runs on one core: the one it was on. Threads that it starts meanwhile
/// stay there too.
class CorePin {
public:
    CorePin();
    ~CorePin();
    CorePin(const CorePin&) = delete;
    CorePin& operator=(const CorePin&) = delete;
    bool is_pinned() const { return is_pinned_; }

private:
    std::vector<unsigned char> before_;  ///< the cores that it could run on
    bool is_pinned_ = false;
};

/// Whether arithmetic of this thread makes zeros of subnormal numbers.
bool flushes_to_zero();

/// NaN for none.
double median_of(std::vector<double> values);

}  // namespace boxwood::bench
