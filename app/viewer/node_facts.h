#pragma once

#include <vector>

#include "app/viewer/box_values.h"
#include "core/structure/node_list.h"

namespace boxwood {

/// What the panel shows of one node. Found out once when it is selected: takes time for every node.
struct NodeFacts {
    static constexpr size_t kMostChildren = 256, kMostPrims = 256;

    uint32_t node = kNoIndex;
    NodeView view;
    std::vector<uint32_t> path;      ///< from the root to the node
    std::vector<uint32_t> siblings;  ///< children of its parent, itself among them; the first kMostChildren
    std::vector<uint32_t> children;  ///< the first kMostChildren
    uint64_t child_count = 0;
    uint64_t nodes_below = 0;     ///< inner nodes and leaves below it
    uint64_t leaves_below = 0;    ///< itself if it is a leaf
    uint64_t references = 0;      ///< in those leaves
    uint64_t prim_count = 0;      ///< different primitives among them
    std::vector<uint32_t> prims;  ///< of them the first kMostPrims, ascending
    double own_share = 0.0;       ///< of the SAH cost, 0 to 1
    double share_below = 0.0;     ///< of the node and all below it
};

/// node < levels.list.nodes.size().
NodeFacts node_facts(const NodeList& list, const BoxValues& values, uint32_t node);

}  // namespace boxwood
