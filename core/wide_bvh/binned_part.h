#pragma once

#include "core/bvh/bins.h"
#include "core/bvh/morton_parts.h"
#include "core/wide_bvh/fill_packs.h"
#include "core/wide_bvh/part_tree.h"

namespace boxwood {

/// Top-down builds by binned surface area cost (see BinnedSah) of parts of up to kMortonPartSize whole
/// references. Triangles cost by packs; sets that fit into one are leaves. One for each thread: it keeps its
/// memory.
class BinnedPartBuild {
public:
    /// Over neighbours in the order; `depth` is that of the root.
    PartRoot build(std::span<const PrimRef> refs, const MortonOrder& order, RefRange range, uint32_t depth,
                   PartTree& tree);
    /// Of the tree built last, in the order of its leaves.
    std::span<const PackPrims> packs() const { return std::span(packs_).first(pack_count_); }

private:
    struct Division {
        uint32_t left_count;
        int next;          ///< the array to which the references were moved
        Box4 left, right;  ///< boxes of the sides
    };

    PartTree::Costs build_node(uint32_t node, RefRange range, uint32_t depth, int array, const Box4& box);
    PartTree::Costs make_leaf(uint32_t node, std::span<const BinRef> refs, const Box4& box);
    Division divide(RefRange range, uint32_t depth, int array, const Box4& box);

    std::array<BinRef, kMortonPartSize> arrays_[2];  ///< to and fro, from a node's to its children's
    Bins bins_;
    PartTree* tree_ = nullptr;
    std::array<PackPrims, kMortonPartSize> packs_;
    uint32_t pack_count_ = 0;
};

}  // namespace boxwood
