#pragma once

#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// The nearest hit of one ray by the plain tracer; none for a ray that is not valid.
template <Mode mode, uint32_t Width>
Hit plain_closest_hit(const WideBvh<Width>& bvh, const Mesh& mesh, const Ray& ray, const Task& task) {
    if (!is_valid(ray)) return {};
    NoCount count;
    ClosestHit<mode> closest(ray);
    closest.watch(task);
    bvh.closest_hit(mesh, closest, count);
    return closest.hit(mesh);
}

/// Whether anything lies on a ray, by the plain tracer.
template <Mode mode, uint32_t Width>
bool plain_any_hit(const WideBvh<Width>& bvh, const Mesh& mesh, const Ray& ray, const Task& task) {
    if (!is_valid(ray)) return false;
    NoCount count;
    ClosestHit<mode> closest(ray);
    closest.watch(task);
    return bvh.any_hit(mesh, closest, count);
}

}  // namespace boxwood
