#pragma once

#include <cstdint>
#include <limits>

#include "core/base/task.h"
#include "core/structure/node_list.h"

namespace boxwood {

/// How many leaves lines meet.
struct LeafCounts {
    double mean = std::numeric_limits<double>::quiet_NaN();  ///< by theory the sum of leaf area / root area
    /// Leaf count variability (LCV): the standard deviation. NaN: not defined for such nodes.
    double deviation = std::numeric_limits<double>::quiet_NaN();
};

/// Leaves, empty ones included, whose boxes are met by `line_count` random lines through the root's box: its
/// surface is entered everywhere with the same density, in directions by cosine, as the SAH cost supposes.
/// What a line hits does not end it. A sample with a fixed seed: the standard error of the deviation is about
/// 1 / sqrt(2 * line_count) of it. Not defined for volumes that are no boxes, nor for a root without area. On
/// all threads, the same for any number of them; after a stop not to be used.
///
/// Aila, Karras, Laine, "On Quality Metrics of Bounding Volume Hierarchies", HPG 2013.
LeafCounts count_leaves_on_lines(const NodeList& list, Task& task, size_t line_count = 1 << 16,
                                 uint64_t seed = 1);

}  // namespace boxwood
