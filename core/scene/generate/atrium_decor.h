#pragma once

#include "core/base/rng.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {

// What stands and hangs in the atrium, in metres.

void use_marble(MeshBuilder& b);
void use_bronze(MeshBuilder& b);
/// A curtain with folds, of the object in use, from a rod at height `top` over local x in [0, bay].
void add_curtain(MeshBuilder& b, double bay, double top, Rng& rng);
/// A vase with a plant of pointed leaves.
void add_vase(MeshBuilder& b, const DVec3& foot, Rng& rng);
/// A lantern on a chain that hangs from `hook`.
void add_lantern(MeshBuilder& b, const DVec3& hook, double drop);
/// An eight-sided basin with two bowls.
void add_fountain(MeshBuilder& b, const DVec3& foot);

}  // namespace boxwood
