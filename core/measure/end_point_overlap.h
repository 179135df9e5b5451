#pragma once

#include <limits>
#include <vector>

#include "core/base/task.h"
#include "core/scene/mesh.h"
#include "core/structure/node_list.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Cost of what a ray visits though its hit is elsewhere, in triangle tests.
struct EndPointOverlap {
    double total = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not defined for such nodes
    std::vector<double> levels;  ///< each level's part of it; empty where not defined
};

/// End-point overlap (EPO): over all nodes the cost of a visit, times the share of the scene's surface that
/// lies in the node's box and belongs to primitives of which no reference is below the node. A ray that ends
/// on a random point of the surface has to visit those nodes, wherever it comes from. Costs are those of the
/// SAH cost: traversal cost (inner nodes), primitives times intersection cost (leaves).
///
/// Exact but for rounding: every triangle is cut by every box that it meets. Boxes and triangles are closed;
/// a primitive with several references belongs with its whole surface to each node above one of them. Not
/// defined for volumes that are no boxes (see has_nested_boxes). 0 for an empty mesh. On all threads, the
/// same for any number of them; task.done counts triangles; after a stop not to be used.
///
/// Aila, Karras, Laine, "On Quality Metrics of Bounding Volume Hierarchies", HPG 2013.
EndPointOverlap end_point_overlap(const NodeList& list, const Mesh& mesh, Task& task,
                                  double traversal_cost = double(kTraversalCost),
                                  double intersection_cost = double(kIntersectionCost));

}  // namespace boxwood
