#pragma once

#include <gmpxx.h>

#include <cmath>
#include <optional>

#include "core/base/box.h"
#include "core/base/ray.h"

namespace boxwood {

inline mpq_class exact(float value) { return mpq_class(double(value)); }

/// t at which the ray, which meets the box, enters it.
inline mpq_class entry_of(const Ray& ray, const Box& box) {
    mpq_class entry = exact(ray.t_min);
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0f) continue;
        const float plane = ray.direction[axis] > 0.0f ? box.lower[axis] : box.upper[axis];
        const mpq_class t = (exact(plane) - exact(ray.origin[axis])) / exact(ray.direction[axis]);
        if (t > entry) entry = t;
    }
    return entry;
}

/// t at which the ray, which meets the box, leaves it or ends; nothing if it never does.
inline std::optional<mpq_class> exit_of(const Ray& ray, const Box& box) {
    std::optional<mpq_class> exit;
    if (std::isfinite(ray.t_max)) exit = exact(ray.t_max);
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0f) continue;
        const float plane = ray.direction[axis] > 0.0f ? box.upper[axis] : box.lower[axis];
        const mpq_class t = (exact(plane) - exact(ray.origin[axis])) / exact(ray.direction[axis]);
        if (!exit || t < *exit) exit = t;
    }
    return exit;
}

}  // namespace boxwood
