#include "core/wide_bvh/qualities.h"

#include "core/bvh/binned_sah.h"
#include "core/bvh/morton.h"
#include "core/bvh/optimize.h"
#include "core/bvh/spatial_splits.h"
#include "core/wide_bvh/collapse.h"

namespace boxwood {

WideBvh<8> Preview::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    Collapse<8> collapse;
    collapse.way = Collapse<8>::Greedy;
    return collapse.apply(mesh, refs, Morton{}.build(mesh, refs, task), task);
}

WideBvh<8> Balanced::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    return Collapse<8>{}.apply(mesh, refs, BinnedSah{}.build(mesh, refs, task), task);
}

WideBvh<8> Best::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    SpatialSplits splits;
    splits.budget = budget;
    const Bvh2 bvh = Optimize{}.apply(mesh, refs, splits.build(mesh, refs, task), task);
    if (task.stopped()) return {};
    return Collapse<8>{}.apply(mesh, refs, bvh, task);
}

}  // namespace boxwood
