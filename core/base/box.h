#pragma once

#include <algorithm>
#include <limits>

#include "core/base/vec.h"

namespace boxwood {

/// Axis-aligned box, closed. The default box is empty: lower = +infinity, upper = -infinity.
struct Box {
    Vec3 lower{std::numeric_limits<float>::infinity()};
    Vec3 upper{-std::numeric_limits<float>::infinity()};

    bool is_empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
    void extend(const Vec3& point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    void extend(const Box& box) {
        lower = glm::min(lower, box.lower);
        upper = glm::max(upper, box.upper);
    }
    bool contains(const Box& box) const {
        return box.is_empty() || (glm::all(glm::lessThanEqual(lower, box.lower)) &&
                                  glm::all(glm::greaterThanEqual(upper, box.upper)));
    }
    /// In double, so that it cannot overflow. Zero in each axis of an empty box.
    DVec3 extent() const { return is_empty() ? DVec3(0.0) : DVec3(upper) - DVec3(lower); }
    DVec3 center() const { return 0.5 * (DVec3(lower) + DVec3(upper)); }
    /// Half the surface area: all that counts where areas are compared.
    double half_area() const {
        const DVec3 e = extent();
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
    double surface_area() const { return 2.0 * half_area(); }
    double volume() const {
        const DVec3 e = extent();
        return e.x * e.y * e.z;
    }
    int largest_axis() const {
        const DVec3 e = extent();
        return e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2);
    }
    bool operator==(const Box&) const = default;
};

}  // namespace boxwood
