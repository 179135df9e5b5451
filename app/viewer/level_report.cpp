#include "app/viewer/level_report.h"

#include <array>
#include <nlohmann/json.hpp>

#include "app/viewer/number_text.h"
#include "app/viewer/text_table.h"

namespace boxwood {
namespace {

constexpr std::array<const char*, 6> kNames{"level",      "nodes",      "leaves",
                                            "references", "cost_share", "overlap"};

TextTable table(const TreeStats& tree) {
    TextTable table{.header = {kNames.begin(), kNames.end()}};
    for (size_t level = 0; level < tree.levels.size(); ++level) {
        const LevelStats& row = tree.levels[level];
        table.rows.push_back({std::to_string(level), std::to_string(row.nodes), std::to_string(row.leaves),
                              std::to_string(row.references), number_text(cost_share(tree, level), 6),
                              number_text(row.sibling_overlap, 6)});
    }
    return table;
}

}  // namespace

double cost_share(const TreeStats& tree, size_t level) {
    return tree.sah_cost > 0.0 ? tree.levels[level].sah_cost / tree.sah_cost : 0.0;
}

std::string level_tsv(const TreeStats& tree) { return tsv_of(table(tree)); }

std::string level_markdown(const TreeStats& tree) { return markdown_of(table(tree)); }

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
