#pragma once

#include <span>
#include <vector>

#include "core/base/array.h"
#include "core/base/box.h"
#include "core/base/task.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// A reference: the box of a primitive or of a piece of it. The union of a primitive's boxes contains the
/// primitive.
struct PrimRef {
    Box bounds;
    uint32_t prim;

    bool operator==(const PrimRef&) const = default;
};

/// Result of the references stage. The references of one primitive are adjacent, primitives in ascending
/// order.
struct References {
    Array<PrimRef> refs;
    size_t split_count = 0;  ///< primitives with more than one reference
};

/// Primitive -> whether it has more than one reference (1) or not (0); size mesh.triangle_count().
std::vector<uint8_t> split_flags(std::span<const PrimRef> refs, size_t triangle_count);

/// The primitives of the references, each once, ascending. What a structure needs that asks the triangles
/// themselves which cells they touch: smaller boxes would not change the answer.
std::vector<uint32_t> prims_of(std::span<const PrimRef> refs);

}  // namespace boxwood
