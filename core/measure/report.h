#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace boxwood {

/// Value of a cell. A number that is not finite is `null` in JSON and "-" in the table.
using ReportValue = std::variant<uint64_t, double, bool, std::string, std::map<std::string, uint64_t>,
                                 std::vector<std::string>>;

/// One row: keys and values in the order of the columns. Keys are those of the design: `scene`, `recipe`,
/// `triangles`, ... Times in milliseconds, sizes in bytes.
class ReportRow {
public:
    ReportRow& set(const std::string& key, ReportValue value);
    const ReportValue* find(const std::string& key) const;
    const std::vector<std::pair<std::string, ReportValue>>& cells() const { return cells_; }

private:
    std::vector<std::pair<std::string, ReportValue>> cells_;
};

/// What a command found out.
struct Report {
    std::string command;
    std::vector<std::string> scenes;  ///< in JSON a string, if there are more an array, if there is none null
    std::vector<ReportRow> rows;
    /// Further tables, each under its own key beside `rows`, such as the three of `boxwood list`.
    std::vector<std::pair<std::string, std::vector<ReportRow>>> tables;
};

/// Digits in groups of three: "1,234,567".
std::string grouped(uint64_t value);

/// One JSON object: command, scene, machine, commit, rows; ends with a line end. Valid UTF-8 whatever the
/// names hold.
std::string to_json(const Report& report);

/// The rows as aligned columns for people, under a line of the keys: every key of any row is a column,
/// numbers stand to the right. Empty for no rows.
std::string to_table(const std::vector<ReportRow>& rows);

}  // namespace boxwood
