#pragma once

#include "core/bvh/bvh2.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// Whether any primitive has several references: they are adjacent.
bool has_pieces(std::span<const PrimRef> refs);

/// Removes duplicates of one primitive in every leaf (Dammertz, Keller 2008, section 2.3) of a tree built
/// over these references. The primitives of each leaf come out ascending where references were split at all.
void merge_duplicates(Bvh2& bvh, std::span<const PrimRef> refs);

}  // namespace boxwood
