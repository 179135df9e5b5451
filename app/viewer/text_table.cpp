#include "app/viewer/text_table.h"

namespace boxwood {
namespace {

std::string line(const std::vector<std::string>& row, const char* begin, const char* between,
                 const char* end) {
    std::string text = begin;
    for (size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : between) + row[i];
    return text + end + "\n";
}

}  // namespace

std::string tsv_of(const TextTable& table) {
    std::string text = line(table.header, "", "\t", "");
    for (const std::vector<std::string>& row : table.rows) text += line(row, "", "\t", "");
    return text;
}

std::string markdown_of(const TextTable& table) {
    std::string text = line(table.header, "| ", " | ", " |");
    for (size_t i = 0; i < table.header.size(); ++i) text += i < table.left_columns ? "|:---" : "|---:";
    text += "|\n";
    for (const std::vector<std::string>& row : table.rows) text += line(row, "| ", " | ", " |");
    return text;
}

}  // namespace boxwood
