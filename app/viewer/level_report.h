#pragma once

#include <string>

#include "core/measure/tree_stats.h"

namespace boxwood {

/// The level table for other programs: a header and one line for each level. `cost_share`: the level's part
/// of the SAH cost, 0 to 1.
std::string level_tsv(const TreeStats& tree);
std::string level_markdown(const TreeStats& tree);
std::string level_json(const TreeStats& tree);

/// Part of the SAH cost that a level has, 0 to 1; 0 where the tree costs nothing.
double cost_share(const TreeStats& tree, size_t level);

}  // namespace boxwood
