#pragma once

#include "core/bvh/morton_parts.h"
#include "core/wide_bvh/fill_packs.h"
#include "core/wide_bvh/part_tree.h"

namespace boxwood {

/// Where each pack of a part of the Morton order begins, and where the last one ends. A pack takes up to
/// eight neighbours on the curve, one fewer for every leading bit by which the codes part earlier there: full
/// packs are fewer, but those across a jump of the curve have large boxes.
std::vector<uint32_t> morton_packs(const MortonOrder& order, RefRange range);

/// Builds the hierarchy of the Morton codes over a part of up to kMortonPartSize triangles, whose leaves are
/// packs. One for each thread: it keeps its memory.
class MortonPartBuild {
public:
    /// `order`: of the triangles of a mesh, all of them; `first`: where each pack of the part begins in it,
    /// and where the last one ends. Writes the packs, too.
    PartRoot build(const MortonOrder& order, std::span<const uint32_t> first, uint32_t depth,
                   const PackFiller& filler, std::span<Pack8> packs, PartTree& tree);

private:
    void fill_packs(const MortonOrder& order, std::span<const uint32_t> first, const PackFiller& filler,
                    std::span<Pack8> packs);
    PartRoot build_node(const MortonPartSplits& splits, uint32_t node, RefRange packs, uint32_t depth,
                        uint32_t split, PartTree& tree) const;

    std::array<Box4, kMortonPartSize> boxes_;
    std::array<uint8_t, kMortonPartSize> levels_;  ///< between pack i and i + 1
};

}  // namespace boxwood
