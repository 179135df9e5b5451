#pragma once

#include <cstdint>
#include <string>

#include "core/measure/report.h"

namespace boxwood {

/// "12.3 MiB"
std::string byte_text(size_t bytes);
/// "0.4 ms", "320 ms", "1.25 s"
std::string time_text(double ms);
/// Three significant digits with k, M or G: "12.3 M". For rates.
std::string rate_text(double value);
/// Up to `digits` significant digits, without an exponent where it is not needed.
std::string number_text(double value, int digits = 4);
/// part / whole: "0.12 %", "100 %"; "0 %" where whole is 0.
std::string percent_text(double part, double whole);

}  // namespace boxwood
