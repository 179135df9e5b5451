#include "core/scene/suffix_value.h"

#include <charconv>
#include <cmath>

namespace boxwood {

std::optional<double> finite_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

std::optional<double> count_value(std::string_view text) {
    double factor = 1.0;
    if (text.ends_with('k')) factor = 1e3;
    if (text.ends_with('M')) factor = 1e6;
    if (factor != 1.0) text.remove_suffix(1);
    const std::optional<double> value = finite_number(text);
    return value ? std::optional(*value * factor) : std::nullopt;
}

std::optional<std::vector<double>> finite_numbers(std::string_view text) {
    std::vector<double> values;
    for (;;) {
        const size_t comma = text.find(',');
        const std::optional<double> value = finite_number(text.substr(0, comma));
        if (!value) return {};
        values.push_back(*value);
        if (comma == std::string_view::npos) return values;
        text.remove_prefix(comma + 1);
    }
}

}  // namespace boxwood
