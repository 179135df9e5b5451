#pragma once

#include <cstdint>

#include "core/base/vec.h"

namespace boxwood {

/// Sine and cosine of an angle.
struct SinCos {
    double sine, cosine;
};

/// Sine and cosine of 2 pi `turns`, 0 <= turns <= 1, with an error below 1e-12. Basic operations only: the
/// same bits from every compiler, which the library's functions do not promise.
SinCos sin_cos_of_turn(double turns);

/// Position of a sample inside its pixel, in [0, 1)^2. Sample 0 is the centre; the others follow a sequence
/// that covers the pixel evenly, shifted by a hash of the pixel.
Vec2 pixel_offset(uint32_t pixel, uint32_t sample);

/// Point `i` of a sequence in [0, 1)^2 for bounce `bounce` of a pixel: even over i, independent over pixels
/// and bounces. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018: R2, in fixed point;
/// shifted by Cranley, Patterson, SIAM J. Numer. Anal. 13, 1976.
Vec2 sequence_point(uint32_t pixel, uint32_t i, uint32_t bounce);

/// Direction in the hemisphere of the unit vector `normal`, with density cosine / pi, from a point of
/// [0, 1)^2. Its length is 1 but for rounding.
DVec3 cosine_direction(const DVec3& normal, const Vec2& point);

}  // namespace boxwood
