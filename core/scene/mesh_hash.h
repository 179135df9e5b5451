#pragma once

#include <cstdint>

#include "core/scene/mesh.h"

namespace boxwood {

/// 64-bit hash of all of the mesh's arrays, names included: the same on every compiler and for any number of
/// threads.
uint64_t content_hash(const Mesh& mesh);

}  // namespace boxwood
