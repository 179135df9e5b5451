#pragma once

#include "core/base/params.h"
#include "core/kdtree/kd_build.h"

namespace boxwood {

/// kd-tree with planes in the middle: of the cell, or of its references.
/// Kaplan, "The Use of Spatial Coherence in Ray Tracing", SIGGRAPH course notes 1985 (middle of the cell);
/// Bentley 1975 (median of the objects, here of the middles of their pieces' boxes); lecture (Kerbl), "k-d
/// tree". Differs: the cell's longest extent comes first, but another axis is taken where all references
/// would be in both children, and a leaf is made where that is so on every axis. The plane cannot be outside
/// or on the wall of the cell: the middle is taken for a median that is. Pieces in the plane go left.
///
/// Ends by depth, and by the budget of references, which bounds memory: below 160 bytes for each reference
/// that the budget allows.
struct KdMedian {
    int middle = 0;     ///< of: 0 the cell, 1 the references
    bool clip = true;   ///< Ernst, Greiner 2007, algorithm 3
    int leaf_size = 4;  ///< 1 to 64
    int max_depth = 0;  ///< 0 to 64; 0: by the number of references
    int budget = 8;     ///< 1 to 64

    void describe(ParamVisitor& v) {
        static constexpr const char* kMiddles[] = {"cell", "references"};
        v.on_enum("middle", middle, kMiddles, "whose middle the plane is in: the cell's or its references'");
        v.on_bool("clip", clip, "triangles are clipped at planes; otherwise their boxes are");
        v.on_int("leaf-size", leaf_size, 1, 64, "so few references are not divided");
        v.on_int("max-depth", max_depth, 0, 64, "levels below the root; 0: 8 + 1.3 log2 of the references");
        v.on_int("budget", budget, 1, 64, "references in leaves at most, for each one given");
    }
    KdTree build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
