#pragma once

#include "core/base/params.h"
#include "core/bvh/bvh2.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// A tree with less surface area in its inner nodes: subtrees are taken out and put back where the sum of the
/// areas becomes the least, round by round. Meister, Bittner, "Parallel Reinsertion for Bounding Volume
/// Hierarchy Optimization", Computer Graphics Forum 37(2), 2018. In each round the best place for each of the
/// most promising nodes is searched for in parallel, in the tree as it is, by branch and bound.
///
/// Differs: the nodes tried are not every n-th one but those with much larger parents, in the spirit of the
/// inefficiency of Bittner, Hapala, Havran, "Fast Insertion-Based Optimization of Bounding Volume
/// Hierarchies", Computer Graphics Forum 32(1), 2013. No locks on nodes: the moves that were found are made
/// one after the other, the largest gain first, of equal ones the lower node; each is weighed again in the
/// tree as it then is, and made only if it still lowers the sum. So the SAH cost never rises, whatever its
/// constants, and the result does not depend on the number of threads. Nor is a move made that would put a
/// leaf below Bvh2::kMaxDepth levels.
///
/// Leaves stay as they are, so that a primitive with several references keeps them. Counted in task.skipped:
/// searches that ended as no place was better, "in the best place", and moves that others spoiled, "overtaken
/// by other moves".
struct Optimize {
    using Input = Bvh2;
    using Output = Bvh2;
    int rounds = 4;            ///< 1 to 64
    float share = 0.1f;        ///< of the nodes that a round tries, the most promising ones, 0.001 to 1
    float least_gain = 0.01f;  ///< a round that gains no more of the inner nodes' area is the last, 0 to 1

    void describe(ParamVisitor& v);
    /// `refs` are not used: the leaves' boxes are those of the input.
    Bvh2 apply(const Mesh& mesh, std::span<const PrimRef> refs, const Bvh2& input, Task& task) const;
};

}  // namespace boxwood
