#pragma once

#include <vector>

#include "core/base/ray.h"
#include "core/base/rng.h"
#include "core/refs/prim_ref.h"
#include "core/scene/mesh.h"

namespace boxwood {

inline Vec3 random_point(Rng& rng, float extent) {
    const float x = rng.next(-extent, extent), y = rng.next(-extent, extent), z = rng.next(-extent, extent);
    return {x, y, z};
}

/// `count` triangles with centres in [-1, 1]^3 and corners up to `size` from them along each axis.
inline Mesh random_triangles(uint32_t count, float size, uint64_t seed) {
    Mesh mesh;
    mesh.objects.push_back({});
    Rng rng(seed);
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 center = random_point(rng, 1.0f);
        for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(center + random_point(rng, size));
        mesh.triangles.push_back(UVec3(3 * i, 3 * i + 1, 3 * i + 2));
        mesh.source_prim.push_back(i);
        mesh.object.push_back(0);
    }
    return mesh;
}

/// Random rays, half of them aimed at vertices of the mesh, some along axes with both zeros as components.
inline std::vector<Ray> rays_for(const Mesh& mesh, size_t count, uint64_t seed) {
    std::vector<Ray> rays;
    Rng rng(seed);
    for (size_t i = 0; i < count; ++i) {
        Ray ray;
        ray.origin = random_point(rng, 2.0f);
        Vec3 target = random_point(rng, 1.0f);
        if (i % 2 == 1 && !mesh.positions.empty())
            target = mesh.positions[rng.next_index(mesh.positions.size())];
        ray.direction = target - ray.origin;
        if (i % 7 == 0) ray.direction[static_cast<int>(i % 3)] = 0.0f;
        if (i % 11 == 0) ray.direction = Vec3(0.0f, -0.0f, i % 2 == 0 ? 1.0f : -3.0f);
        rays.push_back(ray);
    }
    return rays;
}

inline std::vector<PrimRef> whole_refs(const Mesh& mesh) {
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) refs.push_back({mesh.triangle(i).bounds(), i});
    return refs;
}

}  // namespace boxwood
