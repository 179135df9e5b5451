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

/// One cosine-distributed ray from each ray's hit, in the order of the rays, on the side it came from.
std::vector<Ray> bounced_rays(const Mesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits);

/// From each ray's hit, on the side the ray came from, to the light, which lies at t = 1 = t_max; none where
/// that side is turned away from the light.
std::vector<Ray> shadow_rays(const Mesh& mesh, std::span<const Ray> rays, std::span<const Hit> hits,
                             const Vec3& light);

/// A point light that stands in the same room as the camera, whatever the scene: from the eye up and, by half
/// as much, to the right, half way to what stands there, at most half the scene's diagonal far.
Vec3 light_by_camera(const Camera& camera, const Structure& structure, const Mesh& mesh);

/// 64 bits that tell lists of rays, or of answers, apart: over every bit, in order, the same on every
/// compiler.
uint64_t hash_of(std::span<const Ray> rays);
uint64_t hash_of(std::span<const Hit> hits);
uint64_t hash_of(std::span<const uint8_t> occluded);

}  // namespace boxwood::bench
