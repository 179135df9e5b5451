#pragma once

#include <gmpxx.h>

#include <array>
#include <vector>

#include "core/base/box.h"
#include "core/scene/mesh.h"

namespace boxwood {

using ExactPoint = std::array<mpq_class, 3>;

inline ExactPoint exact_point(const Vec3& p) {
    return {mpq_class(double(p.x)), mpq_class(double(p.y)), mpq_class(double(p.z))};
}

/// The part of a convex polygon with sign * (x - plane) <= 0 on the axis, without error.
inline std::vector<ExactPoint> exact_clip(const std::vector<ExactPoint>& polygon, size_t axis,
                                          const mpq_class& plane, int sign) {
    std::vector<ExactPoint> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const ExactPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const mpq_class p_side = sign * (p[axis] - plane), q_side = sign * (q[axis] - plane);
        if (p_side <= 0) kept.push_back(p);
        if ((p_side < 0 && q_side > 0) || (p_side > 0 && q_side < 0)) {
            const mpq_class f = p_side / (p_side - q_side);
            ExactPoint cut;
            for (size_t k = 0; k < 3; ++k) cut[k] = p[k] + f * (q[k] - p[k]);
            kept.push_back(cut);
        }
    }
    return kept;
}

/// The part of a triangle inside a closed box, without error; empty if they have no point in common.
inline std::vector<ExactPoint> exact_clip(const Triangle& triangle, const Box& box) {
    std::vector<ExactPoint> polygon = {exact_point(triangle.a), exact_point(triangle.b),
                                       exact_point(triangle.c)};
    for (int axis = 0; axis < 3; ++axis) {
        const size_t k = static_cast<size_t>(axis);
        polygon = exact_clip(polygon, k, mpq_class(double(box.lower[axis])), -1);
        polygon = exact_clip(polygon, k, mpq_class(double(box.upper[axis])), 1);
    }
    return polygon;
}

}  // namespace boxwood
