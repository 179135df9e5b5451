#pragma once

#include <string>
#include <vector>

namespace boxwood {

/// A table for other programs: a header and rows of as many cells.
struct TextTable {
    std::vector<std::string> header{};
    std::vector<std::vector<std::string>> rows{};
    size_t left_columns = 0;  ///< the first columns are words and stand to the left, the others are numbers
};

/// Tab-separated, one line for the header and for each row.
std::string tsv_of(const TextTable& table);
std::string markdown_of(const TextTable& table);

}  // namespace boxwood
