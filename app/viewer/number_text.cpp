#include "app/viewer/number_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace boxwood {
namespace {

std::string formatted(const char* format, double value, int digits = 0) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, digits, value);
    return text.data();
}

}  // namespace

std::string byte_text(size_t bytes) {
    static constexpr std::array<const char*, 4> kUnits{" bytes", " KiB", " MiB", " GiB"};
    double value = static_cast<double>(bytes);
    size_t unit = 0;
    while (value >= 1024.0 && unit + 1 < kUnits.size()) value /= 1024.0, ++unit;
    return formatted("%.*f", value, unit == 0 || value >= 100.0 ? 0 : value >= 10.0 ? 1 : 2) + kUnits[unit];
}

std::string time_text(double ms) {
    if (ms >= 9999.5) return formatted("%.*f s", ms / 1000.0, 1);
    if (ms >= 999.5) return formatted("%.*f s", ms / 1000.0, 2);
    return formatted("%.*f ms", ms, ms >= 9.95 ? 0 : 1);
}

std::string rate_text(double value) {
    static constexpr std::array<const char*, 4> kUnits{"", " k", " M", " G"};
    size_t unit = 0;
    while (value >= 999.5 && unit + 1 < kUnits.size()) value /= 1000.0, ++unit;
    return formatted("%.*f", value, value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2) + kUnits[unit];
}

std::string number_text(double value, int digits) {
    if (std::abs(value) < 1e6 && std::abs(value) >= 1e6 / 10.0 && digits <= 6)
        return formatted("%.*f", value);
    return formatted("%.*g", value, digits);
}

std::string percent_text(double part, double whole) {
    const double percent = whole > 0.0 ? 100.0 * part / whole : 0.0;
    if (percent == 0.0) return "0 %";
    if (std::abs(percent) < 0.01) return part > 0.0 ? "< 0.01 %" : "> -0.01 %";
    return formatted("%.*f", percent,
                     std::abs(percent) >= 99.95   ? 0
                     : std::abs(percent) >= 9.995 ? 1
                                                  : 2) +
           " %";
}

}  // namespace boxwood
