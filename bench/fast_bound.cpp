#include "bench/fast_bound.h"

#include <cmath>
#include <limits>

#include "core/structure/filter.h"

namespace boxwood::bench {

/// ClosestHit<Mode::Fast>::hit reports the middle of an interval that contains the exact t, no farther than
/// the triangle's vertices, whose own t are off by two roundings of double; then it rounds to float: by
/// 2^-24 of t, or by 2^-150 where floats are equally far apart.
double fast_t_bound(const Ray& ray, const Triangle& triangle) {
    const Interval t = interval_of_t<FilterBounds>(ray, triangle);
    if (!std::isfinite(t.lower) || !std::isfinite(t.upper)) return std::numeric_limits<double>::infinity();
    const double largest = std::max(std::abs(t.lower), std::abs(t.upper));
    return 0.5 * (t.upper - t.lower) + largest * (0x1p-24 + 0x1p-50) + 0x1p-150;
}

}  // namespace boxwood::bench
