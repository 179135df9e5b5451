#pragma once

#include "core/bvh/top_nodes.h"
#include "core/wide_bvh/wide_pieces.h"

namespace boxwood {

/// Levels that top_by_cost makes at most.
constexpr uint32_t kMostTopDepth = 40;

/// A tree over pieces as the top nodes say: piece i stands for the i-th part.
PartTree top_of_nodes(std::span<const TopNode> top, std::span<const WidePiece> pieces,
                      const PartCosts& costs);

/// A tree over pieces by surface area cost: each set is sorted along each axis by the centres of the boxes,
/// and the cheapest of all divisions is taken. Triangles count by packs.
PartTree top_by_cost(std::span<const WidePiece> pieces, const PartCosts& costs);

}  // namespace boxwood
