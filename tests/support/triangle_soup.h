#pragma once

#include <vector>

#include "core/base/rng.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Positions and triangles alone; no two triangles share a vertex.
inline Mesh make_mesh(const std::vector<Triangle>& triangles) {
    Mesh mesh;
    for (const Triangle& t : triangles) {
        const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {t.a, t.b, t.c});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

inline Vec3 random_point(Rng& rng, float lower, float upper) {
    const float x = rng.next(lower, upper), y = rng.next(lower, upper), z = rng.next(lower, upper);
    return {x, y, z};
}

inline Box random_box(Rng& rng, float lower, float upper) {
    Box box;
    box.extend(random_point(rng, lower, upper));
    box.extend(random_point(rng, lower, upper));
    return box;
}

inline Triangle random_triangle(Rng& rng, float lower, float upper) {
    const Vec3 a = random_point(rng, lower, upper), b = random_point(rng, lower, upper);
    return {a, b, random_point(rng, lower, upper)};
}

/// Corners in the cube [lower, upper]^3.
inline std::vector<Triangle> random_triangles(size_t count, float lower, float upper, uint64_t seed) {
    Rng rng(seed);
    std::vector<Triangle> triangles;
    for (size_t i = 0; i < count; ++i) triangles.push_back(random_triangle(rng, lower, upper));
    return triangles;
}

}  // namespace boxwood
