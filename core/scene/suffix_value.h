#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace boxwood {

/// The finite decimal number that the whole text is, in the C locale; nothing for any other text.
std::optional<double> finite_number(std::string_view text);

/// The same with "k" for thousands or "M" for millions behind it: "10M".
std::optional<double> count_value(std::string_view text);

/// Numbers with commas between them; nothing if one of them is none.
std::optional<std::vector<double>> finite_numbers(std::string_view text);

}  // namespace boxwood
