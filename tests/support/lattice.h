#pragma once

#include <vector>

#include "core/base/ray.h"
#include "tests/support/triangle_soup.h"

namespace boxwood {

/// Triangles with corners on whole numbers from 0 to 4: many lie in planes of cells, touch them, or end at
/// them.
inline Mesh lattice_mesh(size_t count, uint64_t seed) {
    Rng rng(seed);
    std::vector<Triangle> triangles;
    const auto point = [&] {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(rng.next_index(5));
        return p;
    };
    while (triangles.size() < count) {
        const Vec3 a = point(), b = point(), c = point();
        if (glm::cross(b - a, c - a) != Vec3(0.0f)) triangles.push_back({a, b, c});
    }
    return make_mesh(triangles);
}

/// Rays through edges and corners of such cells and along their walls, with zeros of both signs, tiny
/// components, and ranges that end at walls.
inline std::vector<Ray> lattice_rays(size_t count, uint64_t seed) {
    Rng rng(seed);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        Ray ray;
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = 0.5f * static_cast<float>(rng.next_index(11)) - 0.5f;
            ray.direction[axis] = static_cast<float>(rng.next_index(5)) - 2.0f;
        }
        const size_t i = rays.size();
        if (i % 3 == 0) ray.direction[static_cast<int>(rng.next_index(3))] = -0.0f;
        if (i % 5 == 0) ray.direction[static_cast<int>(rng.next_index(3))] = 0x1p-140f;
        if (i % 7 == 0) ray.t_max = 1.0f;
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace boxwood
