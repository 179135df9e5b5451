#pragma once

#include "core/base/params.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// One reference for each triangle: its box.
struct WholeBoxes {
    void describe(ParamVisitor&) {}
    References make(const Mesh& mesh, Task& task) const;
};

}  // namespace boxwood
