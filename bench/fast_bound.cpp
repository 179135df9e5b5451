#include "bench/fast_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxwood::bench {

/// u = 2^-24, x, y, z the vertices from the origin, sheared so that the ray is the z axis, X = max|x|, |y|,
/// Z = max|z|. ClosestHit<Mode::Fast> computes t = (U z_a + V z_b + W z_c) / ((U + V + W) d_z): a mean of the
/// z with weights U, V, W of one sign.
///
/// - Each weight is off by at most 20 u X (X + Z): ClosestHit's derivation. Exact and computed mean lie
///   between the least and the largest z, R apart, so the error of the weights moves it by at most
///   60 u X (X + Z) R / |S|, S the sum of the weights as they are computed, which is at least the exact sum
///   less 60 u X (X + Z).
/// - Roundings: u of z, of the products, 2 u of their sum, 2 u of the sum of the weights, u each of 1 / d_z,
///   the product with it and the quotient: 8 u, and 10 u with all of second order, of at most Z.
/// - What leaves the range of float is computed on scaled numbers; what is rounded at its ends all the same
/// is
///   less than 2^-28 of the result, and 61 u above covers it.
double fast_t_bound(const Ray& ray, const Triangle& triangle) {
    constexpr double kUnit = 0x1p-24;
    const DVec3 d(ray.direction), o(ray.origin);
    int k = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::abs(d[axis]) > std::abs(d[k])) k = axis;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    DVec3 x(0.0), y(0.0), z(0.0);
    const Vec3* const corners[3] = {&triangle.a, &triangle.b, &triangle.c};
    for (int corner = 0; corner < 3; ++corner) {
        const DVec3 v = DVec3(*corners[corner]) - o;
        x[corner] = v[i] - d[i] / d[k] * v[k];
        y[corner] = v[j] - d[j] / d[k] * v[k];
        z[corner] = v[k];
    }
    double lateral = 0.0, depth = 0.0;
    for (int corner = 0; corner < 3; ++corner) {
        lateral = std::max({lateral, std::abs(x[corner]), std::abs(y[corner])});
        depth = std::max(depth, std::abs(z[corner]));
    }
    const double range = std::max({z[0], z[1], z[2]}) - std::min({z[0], z[1], z[2]});
    const double sum = std::abs((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
    const double weight_error = 61.0 * kUnit * lateral * (lateral + depth);
    const double least_sum = sum - weight_error;
    if (!(least_sum > 0.0)) return std::numeric_limits<double>::infinity();
    return (weight_error * range / least_sum + 10.0 * kUnit * depth) * (1.0 + 0x1p-20) / std::abs(d[k]);
}

}  // namespace boxwood::bench
