#pragma once

#include "core/base/params.h"
#include "core/refs/prim_ref.h"
#include "core/refs/subdivision.h"

namespace boxwood {

/// A triangle whose box has a surface area above SA_max is split in the middle of that box's longest axis,
/// its two pieces likewise, and the boxes of the pieces become references. The boxes of one triangle have
/// disjoint interiors. Ernst, Greiner, "Early Split Clipping for Bounding Volume Hierarchies", IEEE/EG
/// Symposium on Interactive Ray Tracing 2007, algorithm 4. A box of exactly SA_max is not split (the sign in
/// its line 4 is lost in our copy), so that s = 0, the area of the scene's box, splits nothing. Differs: each
/// piece is clipped from the original triangle, so that errors do not add up; a box stays whole where no
/// float lies between its faces.
struct EarlySplitClipping {
    AreaLimit limit;  ///< SA_max: `s` as the scene box's area / 2^s, or `sa` in square world units
    ReferenceBudget budget{};

    void describe(ParamVisitor& v) {
        v.on_area_limit("s", "sa", limit,
                        "a box is split where its area exceeds the scene box's / 2^s (or sa)");
        v.on_int("budget", budget.per_triangle, 1, 1024,
                 "references at most, for each triangle of the scene");
    }
    References make(const Mesh& mesh, Task& task) const;
};

}  // namespace boxwood
