#pragma once

#include "core/base/params.h"
#include "core/bvh/bvh2.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// A tree that was built on one frame of an animation with the boxes of another: nodes and leaves stay, each
/// box becomes that of what lies below it. Bottom up, in parallel; no rounding. On the frame that it was
/// built on, the tree itself. Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes using Dynamic Bounding
/// Volume Hierarchies", ACM Transactions on Graphics 26(1), 2007.
struct Refit {
    using Input = Bvh2;
    using Output = Bvh2;
    int from = 0;  ///< the frame that the tree is built on

    void describe(ParamVisitor& v);
    int input_frame() const { return from; }
    /// `refs` are not used: leaves hold whole triangles, whose boxes come from the mesh. Throws Error
    /// (WrongUsage) where the builder made pieces of triangles.
    Bvh2 apply(const Mesh& mesh, std::span<const PrimRef> refs, const Bvh2& input, Task& task) const;
};

}  // namespace boxwood
