#include "app/viewer/level_report.h"

#include <array>
#include <nlohmann/json.hpp>

#include "app/viewer/number_text.h"

namespace boxwood {
namespace {

constexpr std::array<const char*, 6> kNames{"level",      "nodes",      "leaves",
                                            "references", "cost_share", "overlap"};

std::array<std::string, 6> cells(const TreeStats& tree, size_t level) {
    const LevelStats& row = tree.levels[level];
    return {std::to_string(level),
            std::to_string(row.nodes),
            std::to_string(row.leaves),
            std::to_string(row.references),
            number_text(cost_share(tree, level), 6),
            number_text(row.sibling_overlap, 6)};
}

template <class Cells>
std::string line(const Cells& row, const char* begin, const char* between, const char* end) {
    std::string text = begin;
    for (size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : between) + std::string(row[i]);
    return text + end + "\n";
}

std::string table(const TreeStats& tree, const char* begin, const char* between, const char* end,
                  const char* rule) {
    std::string text = line(kNames, begin, between, end) + rule;
    for (size_t level = 0; level < tree.levels.size(); ++level) {
        text += line(cells(tree, level), begin, between, end);
    }
    return text;
}

}  // namespace

double cost_share(const TreeStats& tree, size_t level) {
    return tree.sah_cost > 0.0 ? tree.levels[level].sah_cost / tree.sah_cost : 0.0;
}

std::string level_tsv(const TreeStats& tree) { return table(tree, "", "\t", "", ""); }

std::string level_markdown(const TreeStats& tree) {
    return table(tree, "| ", " | ", " |", "|---:|---:|---:|---:|---:|---:|\n");
}

std::string level_json(const TreeStats& tree) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (size_t level = 0; level < tree.levels.size(); ++level) {
        const LevelStats& row = tree.levels[level];
        rows.push_back({{"level", level},
                        {"nodes", row.nodes},
                        {"leaves", row.leaves},
                        {"references", row.references},
                        {"cost_share", cost_share(tree, level)},
                        {"overlap", row.sibling_overlap}});
    }
    return rows.dump(4) + "\n";
}

}  // namespace boxwood
