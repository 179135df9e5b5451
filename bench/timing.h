#pragma once

#include <vector>

namespace boxwood::bench {

/// Milliseconds of processor time that the process has used, all threads together.
double process_ms();

/// NaN for none.
double median_of(std::vector<double> values);

}  // namespace boxwood::bench
