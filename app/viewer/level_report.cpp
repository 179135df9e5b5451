#include "app/viewer/level_report.h"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/viewer/number_text.h"
#include "app/viewer/text_table.h"

namespace boxwood {
namespace {

constexpr std::array<const char*, 8> kNames{"level",      "nodes", "leaves",  "references",
                                            "cost_share", "epo",   "overlap", "empty_volume"};

TextTable table(const TreeStats& tree, const SlowMeasures* slow) {
    TextTable table{.header = {kNames.begin(), kNames.end()}};
    for (size_t level = 0; level < tree.levels.size(); ++level) {
        const LevelStats& row = tree.levels[level];
        table.rows.push_back({std::to_string(level), std::to_string(row.nodes), std::to_string(row.leaves),
                              std::to_string(row.references), number_text(cost_share(tree, level), 6),
                              number_text(end_point_part(slow, level), 6),
                              number_text(row.sibling_overlap, 6), number_text(row.empty_volume, 6)});
    }
    return table;
}

}  // namespace

double cost_share(const TreeStats& tree, size_t level) {
    return tree.sah_cost > 0.0 ? tree.levels[level].sah_cost / tree.sah_cost : 0.0;
}

double end_point_part(const SlowMeasures* slow, size_t level) {
    return slow != nullptr && level < slow->end_points.levels.size()
               ? slow->end_points.levels[level]
               : std::numeric_limits<double>::quiet_NaN();
}

std::string level_tsv(const TreeStats& tree, const SlowMeasures* slow) { return tsv_of(table(tree, slow)); }

std::string level_markdown(const TreeStats& tree, const SlowMeasures* slow) {
    return markdown_of(table(tree, slow));
}

std::string level_json(const TreeStats& tree, const SlowMeasures* slow) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (size_t level = 0; level < tree.levels.size(); ++level) {
        const LevelStats& row = tree.levels[level];
        rows.push_back({{"level", level},
                        {"nodes", row.nodes},
                        {"leaves", row.leaves},
                        {"references", row.references},
                        {"cost_share", cost_share(tree, level)},
                        {"epo", end_point_part(slow, level)},
                        {"overlap", row.sibling_overlap},
                        {"empty_volume", row.empty_volume}});
    }
    return rows.dump(4) + "\n";
}

}  // namespace boxwood
