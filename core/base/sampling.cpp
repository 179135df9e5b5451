#include "core/base/sampling.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"

namespace boxwood {

namespace {

/// 2^32 / g and 2^32 / g^2 for the plastic number g = 1.3247179572...: the step of R2 in each axis.
constexpr uint32_t kStepX = 0xc13fa9a9u;
constexpr uint32_t kStepY = 0x91e10da5u;

float fraction(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// 32 random bits for a pixel and a dimension.
uint32_t shift_of(uint32_t pixel, uint32_t bounce, uint32_t axis) {
    return static_cast<uint32_t>(hashed_float(pixel, 0, bounce, axis) * 0x1p24f) << 8;
}

}  // namespace

SinCos sin_cos_of_turn(double turns) {
    constexpr double kHalfPi = 1.57079632679489661923;
    // turns = quarter / 4 + rest, |rest| <= 1/8: the series below need |x| <= pi / 4 only.
    const double quarter = std::floor(4.0 * turns + 0.5);
    const double x = (4.0 * turns - quarter) * kHalfPi;
    const double x2 = x * x;
    // Taylor series; the first terms left out are x^15 / 15! < 3e-14 and x^16 / 16! < 2e-15.
    const double sine =
        x *
        (1.0 + x2 * (-1.0 / 6.0 +
                     x2 * (1.0 / 120.0 +
                           x2 * (-1.0 / 5040.0 + x2 * (1.0 / 362880.0 + x2 * (-1.0 / 39916800.0 +
                                                                              x2 * (1.0 / 6227020800.0)))))));
    const double cosine =
        1.0 +
        x2 * (-1.0 / 2.0 +
              x2 * (1.0 / 24.0 +
                    x2 * (-1.0 / 720.0 + x2 * (1.0 / 40320.0 + x2 * (-1.0 / 3628800.0 +
                                                                     x2 * (1.0 / 479001600.0 +
                                                                           x2 * (-1.0 / 87178291200.0)))))));
    switch (static_cast<int>(quarter) & 3) {
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        case 3:
            return {-cosine, sine};
        default:
            return {sine, cosine};
    }
}

Vec2 pixel_offset(uint32_t pixel, uint32_t sample) {
    if (sample == 0) return Vec2(0.5f);
    return sequence_point(pixel, sample, 0);
}

Vec2 sequence_point(uint32_t pixel, uint32_t i, uint32_t bounce) {
    const uint32_t x = shift_of(pixel, bounce, 0) + i * kStepX;
    const uint32_t y = shift_of(pixel, bounce, 1) + i * kStepY;
    return {fraction(x), fraction(y)};
}

DVec3 cosine_direction(const DVec3& normal, const Vec2& point) {
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017, listing 3.
    const double sign = std::copysign(1.0, normal.z);
    const double a = -1.0 / (sign + normal.z);
    const double b = normal.x * normal.y * a;
    const DVec3 tangent(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const DVec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    // A point of the unit disk, raised to the hemisphere (Malley's method).
    const double u = static_cast<double>(point.x);
    const SinCos angle = sin_cos_of_turn(static_cast<double>(point.y));
    const double radius = std::sqrt(u);
    const double height = std::sqrt(std::max(0.0, 1.0 - u));
    return tangent * (radius * angle.cosine) + bitangent * (radius * angle.sine) + normal * height;
}

}  // namespace boxwood
