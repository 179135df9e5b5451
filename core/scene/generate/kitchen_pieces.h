#pragma once

#include "core/base/rng.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood::kitchen {

// The kitchen's plan, in metres: x along the back wall from left to right, y up, z into the room.
inline constexpr double kWidth = 6.0, kHeight = 2.75, kDepth = 4.8;
inline constexpr double kTop = 0.92;       ///< of the worktop
inline constexpr double kCupDepth = 0.58;  ///< of the cupboards under it, without their fronts

// What stands still.
void add_room(MeshBuilder& b);
void add_window(MeshBuilder& b, Rng& rng);
void add_cupboards(MeshBuilder& b);
void add_stove(MeshBuilder& b);
void add_sink(MeshBuilder& b);
void add_fridge(MeshBuilder& b);
void add_dresser(MeshBuilder& b, Rng& rng);
void add_table(MeshBuilder& b, Rng& rng);
void add_rug(MeshBuilder& b);
void add_small_things(MeshBuilder& b, Rng& rng);
/// A chair at the builder's placement: its seat's middle over the origin, its front along -z.
void add_chair(MeshBuilder& b);

/// All that moves, at `phase` of the loop in [0, 1). Each part is an object of its own whose name begins with
/// "moving".
void add_moving_things(MeshBuilder& b, double phase);

}  // namespace boxwood::kitchen
