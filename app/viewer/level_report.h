#pragma once

#include <string>

#include "app/viewer/tree_work.h"
#include "core/measure/tree_stats.h"

namespace boxwood {

/// The level table for other programs: a header and one line for each level. `cost_share`: the level's part
/// of the SAH cost, 0 to 1; `epo` is nan, in JSON null, where `slow` is null or does not know it.
std::string level_tsv(const TreeStats& tree, const SlowMeasures* slow);
std::string level_markdown(const TreeStats& tree, const SlowMeasures* slow);
std::string level_json(const TreeStats& tree, const SlowMeasures* slow);

/// Part of the SAH cost that a level has, 0 to 1; 0 where the tree costs nothing.
double cost_share(const TreeStats& tree, size_t level);

/// The level's part of the end-point overlap, in triangle tests; NaN where it is not known.
double end_point_part(const SlowMeasures* slow, size_t level);

}  // namespace boxwood
