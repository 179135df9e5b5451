#pragma once

#include <vector>

#include "app/viewer/measures.h"

namespace boxwood {

/// What a tree is judged by beside its SAH cost: end-point overlap, leaf count variability, leaf-size
/// variation, overlap and empty volume. `slow`: null where not known yet, with the progress of the work on
/// it.
std::vector<Measure> tree_qualities(const TreeStats& tree, const SlowMeasures* slow,
                                    const WorkProgress& progress);

}  // namespace boxwood
