#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Rays that find mistakes: in turn through pixels of the scene's own and of the fitted view, between random
/// points of the scene's box, at vertices, edges and inner points of triangles, and along the axes, starting
/// at coordinates that occur in the mesh. The same for the same scene, count and seed. None for an empty
/// mesh.
std::vector<Ray> verification_rays(const Scene& scene, size_t count, uint64_t seed = 1);

/// Nearest hits of all rays, on all threads; task.done counts rays. After a stop not to be used.
std::vector<Hit> closest_hits(const Structure& structure, const Mesh& mesh, std::span<const Ray> rays,
                              Mode mode, Task& task);

/// How a structure's answers differ from the expected ones.
struct Disagreement {
    uint64_t wrong = 0;           ///< rays whose hit (primitive and bits of t) or occlusion differs
    std::optional<size_t> first;  ///< the first such ray
    Hit found;                    ///< its hit
    bool occluded = false;        ///< what any_hits says about it
};

/// Casts the rays and compares with expected.size() == rays.size() hits; any hit has to agree with them too.
Disagreement compare_hits(const Structure& structure, const Mesh& mesh, std::span<const Ray> rays,
                          std::span<const Hit> expected, Mode mode, Task& task);

}  // namespace boxwood
