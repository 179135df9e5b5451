#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.h"

namespace boxwood {

/// The largest float that is at most x; the lowest finite one for what lies below all.
inline float float_below(double x) {
    constexpr double kMost = static_cast<double>(std::numeric_limits<float>::max());
    const float f = static_cast<float>(std::clamp(x, -kMost, kMost));
    if (static_cast<double>(f) <= x || f == -std::numeric_limits<float>::max()) return f;
    return std::nextafter(f, -std::numeric_limits<float>::max());
}

/// A box of floats that contains all points from lower to upper, which are off by a few roundings.
inline Box outward_box(const DVec3& lower, const DVec3& upper) {
    constexpr double kRoundings = 0x1p-48;
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        const double largest = std::max(std::abs(lower[axis]), std::abs(upper[axis]));
        box.lower[axis] = float_below(lower[axis] - kRoundings * largest);
        box.upper[axis] = -float_below(-upper[axis] - kRoundings * largest);
    }
    return box;
}

/// A point as floats, as far as floats reach.
inline Vec3 finite_point(const DVec3& p) {
    constexpr double kMost = static_cast<double>(std::numeric_limits<float>::max());
    return Vec3(glm::clamp(p, -kMost, kMost));
}

}  // namespace boxwood
