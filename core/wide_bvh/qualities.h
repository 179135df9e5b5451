#pragma once

#include "core/structure/method.h"
#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// The eight-wide hierarchy that is built fastest: Morton order, opened by surface area. See Morton and
/// Collapse.
struct Preview {
    void describe(ParamVisitor&) {}
    WideBvh<8> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

/// Traced fast, built in a moment: binned surface area cost, nodes of least expected cost. See BinnedSah and
/// Collapse.
struct Balanced {
    void describe(ParamVisitor&) {}
    WideBvh<8> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

/// The eight-wide hierarchy that is traced fastest: spatial splits, subtrees moved to where they cost less,
/// nodes of least expected cost. See SpatialSplits, Optimize and Collapse.
struct Best {
    float budget = 2.0f;  ///< references at most, for each one given, 1 to 16

    void describe(ParamVisitor& v) {
        v.on_float("budget", budget, 1.0f, 16.0f, "references in leaves at most, for each one given");
    }
    WideBvh<8> build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
