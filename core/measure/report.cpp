#include "core/measure/report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "core/measure/machine.h"

namespace boxwood {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ReportValue& value) {
    return std::visit(
        [](const auto& v) -> Json {
            using V = std::decay_t<decltype(v)>;
            if constexpr (std::is_same_v<V, std::map<std::string, uint64_t>>) {
                Json object = Json::object();
                for (const auto& [reason, count] : v) object[reason] = count;
                return object;
            } else if constexpr (std::is_same_v<V, double>) {
                return std::isfinite(v) ? Json(v) : Json(nullptr);
            } else {
                return Json(v);
            }
        },
        value);
}

Json json_of(const std::vector<ReportRow>& rows) {
    Json array = Json::array();
    for (const ReportRow& row : rows) {
        Json object = Json::object();
        for (const auto& [key, value] : row.cells()) object[key] = json_of(value);
        array.push_back(std::move(object));
    }
    return array;
}

Json json_of(const Machine& machine) {
    return {{"cpu", machine.cpu},
            {"cores", machine.cores},
            {"compiler", machine.compiler},
            {"build_type", machine.build_type}};
}

/// Enough digits to compare by: three decimals below 100, none above 10,000.
std::string rounded(double value) {
    if (!std::isfinite(value)) return "-";
    const double size = std::abs(value);
    if (size >= 1e15 || (size > 0.0 && size < 5e-4)) {
        char text[32];
        std::snprintf(text, sizeof(text), "%.3g", value);
        return text;
    }
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", size < 100.0 ? 3 : size < 10000.0 ? 1 : 0, value);
    return text;
}

std::string cell_text(const ReportValue& value) {
    return std::visit(
        [](const auto& v) -> std::string {
            using V = std::decay_t<decltype(v)>;
            std::string text;
            if constexpr (std::is_same_v<V, uint64_t>) {
                text = grouped(v);
            } else if constexpr (std::is_same_v<V, double>) {
                text = rounded(v);
            } else if constexpr (std::is_same_v<V, bool>) {
                text = v ? "yes" : "no";
            } else if constexpr (std::is_same_v<V, std::string>) {
                text = v;
            } else if constexpr (std::is_same_v<V, std::vector<std::string>>) {
                for (const std::string& word : v) text += (text.empty() ? "" : ", ") + word;
            } else {
                for (const auto& [reason, count] : v)
                    text += (text.empty() ? "" : ", ") + reason + " " + grouped(count);
            }
            return text;
        },
        value);
}

bool is_number(const ReportValue& value) {
    return std::holds_alternative<uint64_t>(value) || std::holds_alternative<double>(value);
}

/// Characters, not bytes, of UTF-8.
size_t display_width(const std::string& text) {
    return static_cast<size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

struct Column {
    std::string key;
    bool to_the_right = true;
    size_t width = 0;
};

std::vector<Column> columns_of(const std::vector<ReportRow>& rows) {
    std::vector<Column> columns;
    for (const ReportRow& row : rows) {
        for (const auto& [key, value] : row.cells()) {
            auto column = std::ranges::find(columns, key, &Column::key);
            if (column == columns.end())
                column = columns.insert(columns.end(), {key, true, display_width(key)});
            column->to_the_right = column->to_the_right && is_number(value);
            column->width = std::max(column->width, display_width(cell_text(value)));
        }
    }
    return columns;
}

void append_cell(std::string& line, const std::string& text, const Column& column) {
    if (!line.empty()) line += "  ";
    const std::string blanks(column.width - display_width(text), ' ');
    line += column.to_the_right ? blanks + text : text + blanks;
}

void append_line(std::string& table, std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    table += line + "\n";
}

}  // namespace

std::string grouped(uint64_t value) {
    std::string text = std::to_string(value);
    for (size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
    return text;
}

ReportRow& ReportRow::set(const std::string& key, ReportValue value) {
    const auto known = std::ranges::find(cells_, key, &std::pair<std::string, ReportValue>::first);
    if (known != cells_.end()) {
        known->second = std::move(value);
    } else {
        cells_.emplace_back(key, std::move(value));
    }
    return *this;
}

const ReportValue* ReportRow::find(const std::string& key) const {
    const auto known = std::ranges::find(cells_, key, &std::pair<std::string, ReportValue>::first);
    return known == cells_.end() ? nullptr : &known->second;
}

std::string to_json(const Report& report) {
    Json object;
    object["command"] = report.command;
    object["scene"] = report.scenes.empty()       ? Json(nullptr)
                      : report.scenes.size() == 1 ? Json(report.scenes.front())
                                                  : Json(report.scenes);
    object["machine"] = json_of(this_machine());
    object["commit"] = build_commit();
    object["rows"] = json_of(report.rows);
    for (const auto& [key, rows] : report.tables) object[key] = json_of(rows);
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const std::vector<ReportRow>& rows) {
    const std::vector<Column> columns = columns_of(rows);
    if (columns.empty()) return {};
    std::string table;
    std::string head;
    for (const Column& column : columns) append_cell(head, column.key, column);
    append_line(table, head);
    for (const ReportRow& row : rows) {
        std::string line;
        for (const Column& column : columns) {
            const ReportValue* value = row.find(column.key);
            append_cell(line, value ? cell_text(*value) : "", column);
        }
        append_line(table, line);
    }
    return table;
}

}  // namespace boxwood
