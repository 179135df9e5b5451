#pragma once

#include "core/structure/method.h"
#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// The sixteen-wide hierarchy that is built fastest: the hierarchy of the Morton codes (see Morton) over
/// packs of neighbours on the curve, part by part, nodes of least expected cost (see Collapse) within the
/// parts and above them; a part is at least one node. Packs stand depth first. Over pieces of triangles the
/// two stages are run as they are.
struct Preview {
    void describe(ParamVisitor&) {}
    WideBvh<16> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

/// Traced fast, built in a moment: binned surface area cost (see BinnedSah) within parts that are neighbours
/// on the Morton curve, a sweep over the parts above them, nodes of least expected cost (see Collapse); a
/// part is at least one node. After Ganestam, Barringer, Doggett, Akenine-Moeller, "Bonsai: Rapid Bounding
/// Volume Hierarchy Generation using Mini Trees", JCGT 4(3), 2015. Differs: no pruning of parts. Packs stand
/// depth first. Over pieces of triangles the two stages are run as they are.
struct Balanced {
    void describe(ParamVisitor&) {}
    WideBvh<16> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

/// The sixteen-wide hierarchy that is traced fastest: splits between centres in bins, subtrees
/// moved to where they cost less, nodes of least expected cost. See BinnedSah, Optimize and Collapse. Where
/// cuts can take much from the boxes of triangles, the same out of spatial splits (see SpatialSplits), unless
/// whole triangles have clearly the lower sampled_cost. Counted in task.skipped: references that were not
/// split in space: "tight boxes", or "cheaper whole".
struct Best {
    static constexpr const char* kStandIn = "preview";

    float budget = 2.0f;  ///< references at most, for each one given, 1 to 16

    void describe(ParamVisitor& v) {
        v.on_float("budget", budget, 1.0f, 16.0f, "references in leaves at most, for each one given");
    }
    WideBvh<16> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
