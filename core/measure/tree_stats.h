#pragma once

#include <cstdint>
#include <vector>

#include "core/structure/node_list.h"
#include "core/structure/sah.h"

namespace boxwood {

/// One row of the table of levels. Areas of nodes are those of their volumes (see NodeList::half_areas).
/// Areas and probabilities are relative to the root's: 1 is the root's area.
struct LevelStats {
    uint64_t nodes = 0;
    uint64_t leaves = 0;
    uint64_t references = 0;  ///< primitives of the leaves, each once in its leaf
    double sah_cost = 0.0;    ///< this level's part of TreeStats::sah_cost
    double total_area = 0.0;  ///< sum of the nodes' areas
    double mean_area = 0.0;
    /// How much the siblings at this level overlap: the sum of the areas of all their common boxes, divided
    /// by the sum of their parents' areas. A ray that meets the parent meets a common box, and so has to
    /// visit both siblings, with that probability. 0 at level 0, and where siblings do no more than touch.
    /// Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009, section 4.5: SA
    /// of the common box. Differs: relative to the parent, not to the root. Volumes that are no boxes count
    /// as their boxes here.
    double sibling_overlap = 0.0;
    /// The share of their parents' boxes that the nodes of this level leave empty, as the mean over the
    /// parents weighted by area: a ray that meets a parent can pass there without a child. Of volume; of area
    /// where a box is flat in one axis, of length where in two (see covered_share). 0 at level 0. Volumes
    /// that are no boxes count as their boxes here.
    double empty_volume = 0.0;
};

/// What a built structure is made of, and what it is expected to cost.
struct TreeStats {
    uint64_t nodes = 0;
    uint64_t leaves = 0;
    uint64_t empty_leaves = 0;
    uint64_t references = 0;
    /// Expected cost of a random ray that meets the root, in triangle tests: the sum over all nodes of the
    /// probability of a visit times traversal cost (inner nodes) or primitives times intersection cost
    /// (leaves).
    double sah_cost = 0.0;
    std::vector<LevelStats> levels;
    std::vector<uint64_t>
        leaf_sizes;  ///< leaf_sizes[n]: leaves with n primitives; the last one: that many or more
    /// Parents of more than kMostSiblings nodes, absent from sibling_overlap and empty_volume.
    uint64_t crowded_parents = 0;
    /// The sum of the areas of all siblings' common boxes over the root's area: how many of them a random ray
    /// that meets the root meets. 0 for a root without area.
    double sibling_overlap = 0.0;
    /// The mean of LevelStats::empty_volume over all inner nodes, weighted by area.
    double empty_volume = 0.0;
    double mean_leaf_size = 0.0;       ///< primitives of a leaf that has any; 0 where there is none
    double leaf_size_variation = 0.0;  ///< standard deviation of those leaf sizes over their mean

    static constexpr size_t kMostLeafSize = 64;  ///< last index of leaf_sizes at most
    static constexpr size_t kMostSiblings = 64;
};

/// In time proportional to the number of nodes. An empty table has no levels and costs 0.
TreeStats tree_stats(const LevelTable& table, double traversal_cost = double(kTraversalCost),
                     double intersection_cost = double(kIntersectionCost));

/// Area of the box that a and b have in common; 0 if they do no more than touch. Boxes that are flat in one
/// plane overlap in it.
double overlap_half_area(const Box& a, const Box& b);

}  // namespace boxwood
