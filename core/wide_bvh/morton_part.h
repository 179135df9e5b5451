#pragma once

#include "core/bvh/morton_parts.h"
#include "core/wide_bvh/fill_packs.h"
#include "core/wide_bvh/part_tree.h"

namespace boxwood {

/// The hierarchy of the Morton codes over a part of up to kMortonPartSize triangles, whose leaves are packs:
/// first its shape alone, then, where it is known how many packs all parts before have, the tree.
class MortonPart {
public:
    /// `order`: of the triangles of a mesh, all of them. `shape` has room for 2 range.count() bytes.
    MortonPart(const MortonOrder& order, RefRange range, uint32_t depth, std::span<uint8_t> shape);

    uint32_t pack_count() const { return pack_count_; }
    /// Writes the packs, too: packs.size() == pack_count().
    PartRoot build(const PackFiller& filler, std::span<Pack8> packs, PartTree& tree) const;

private:
    const MortonOrder& order_;
    RefRange range_;
    uint8_t* shape_;  ///< of each node, parents before children, left before right: 0, or triangles of a leaf
    uint32_t pack_count_ = 0;
};

}  // namespace boxwood
