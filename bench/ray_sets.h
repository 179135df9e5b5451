#pragma once

#include <span>
#include <vector>

#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/scene/camera.h"
#include "core/scene/mesh.h"
#include "core/structure/structure.h"

namespace boxwood::bench {

/// Camera rays through the pixel centres of a square picture, row by row: the largest square with at most
/// `count` pixels.
std::vector<Ray> primary_rays(const Camera& camera, size_t count);

/// One cosine-distributed ray from each hit of `primary` (counted exactly), on the side it came from, begun
/// again with other directions until there are `count`. Empty where nothing is hit.
std::vector<Ray> diffuse_rays(const Structure& structure, const Mesh& mesh, std::span<const Ray> primary,
                              size_t count, Task& task);

/// 64 bits that tell lists of rays, or of answers, apart: over every bit, in order, the same on every
/// compiler.
uint64_t hash_of(std::span<const Ray> rays);
uint64_t hash_of(std::span<const Hit> hits);

}  // namespace boxwood::bench
