#pragma once

#include <vector>

#include "core/structure/node_list.h"

namespace boxwood {

/// A box of a node list, or of a group of siblings, in depth-first order: what lies below entry i are the
/// entries i + 1 .. end. A search needs no stack: from a box that it meets it goes on to the next entry, from
/// one that it does not meet to `end`.
struct SearchBox {
    Box bounds;
    uint32_t node = kNoIndex;  ///< kNoIndex: a group
    uint32_t end = 0;
};

/// Whether nodes are boxes, each in its parent's, so that a search through them finds all: not so for
/// spheres, oriented boxes and the cells of a BSP. True for an empty list.
bool has_nested_boxes(const NodeList& list);

/// The nodes' boxes; many siblings (cells of a grid) are halved into groups, so that a search does not try
/// each. Only where has_nested_boxes.
std::vector<SearchBox> search_boxes(const NodeList& list);

}  // namespace boxwood
