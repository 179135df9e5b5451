#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/box.h"

namespace boxwood {

/// What float SIMD may decide for sure, for rays of ordinary size in scenes of ordinary size. u = 2^-24 is
/// the largest relative error of one operation; products may be fused with the sum that follows, or not. R is
/// the distance, along an axis, of the scene's farthest corner from the ray's origin. What is of second order
/// has room in kSecondOrder: 2^-10 is 2^14 u.
///
/// Boxes. The parameter of a plane p of one axis is p r + c, with r = f/d and c = -(o r) -+ pad. The
/// roundings of 1/d, of r and of the last sum are proportional to the parameter: f = 1 - 3u makes that of a
/// near plane ahead no larger than it is, as (1 + u)^3 (1 - 3u) < 1, and f = 1 + 4u (1 + 3u is no float) that
/// of a far plane no smaller. A near plane behind the origin is none, as t_min is not negative, and behind a
/// far plane no ray meets the box. What is left does not grow with the distance: the rounding of c, u |o r|;
/// where products are not fused with sums, also those of p r and o r, u |r| (2 |o| + P) in all, with P the
/// largest |p|. So a ray that starts a few u |o| off a flat box, as every ray does that leaves a triangle
/// across an axis, is seen not to meet it. A component below 2^-24 of the largest one D is replaced by that:
/// inside the scene's box D t is at most R, so the point at t moves by at most u R, which is u R |r| of the
/// parameter. Both, and the margin by which fast mode's boxes are larger, are taken off near planes and added
/// to far ones, so every box is met that is met exactly, and its entry is a lower bound. (Without that a
/// fused slab test misses boxes.)
///
/// Edge functions, exact mode. As for EdgeFilter in filter.h, with X the largest |x| or |y| of the sheared
/// vertices and Z the largest |z|, x is off by at most e = u (2X + 3.5Z), and U, its sign's roundings, by 4X
/// e
/// + 2 e^2 + 2u X^2 = u (10 X^2 + 14 X Z) + 24.5 u^2 Z^2. Let |U|, which is at most 2 X^2, exceed 24u X
/// max(X, Z): then X > 12u Z, the last term is below 2.1u X Z, and of second order from X = 2^-10 Z on, where
/// 10 X^2 begins to count. So U has the right sign. By R alone, as |a_x| and |a_z| are at most R, but X up to
/// 2R: e = u (3.5R + X), and U is off by at most 26u X R.
///
/// t, exact mode. As for interval_of_t in filter.h: numerator and denominator are off by at most eN = 8u, eD
/// = 7u times the sum of their absolute monomials; |t - N / D| <= (eN + |t| eD) / (|D| - eD). Where |D| > 16
/// eD that is at most 16/15 (eN + |t| eD) / |D|. The inverse, its product with N and the ends are rounded:
/// 3u |t|, which is at most 3u / |D| times the monomials of N: 11u instead of 8u.
///
/// Fast mode. What counts is the triangle that ClosestHit<Mode::Fast> sees, and the t that it compares. The
/// sheared vertices are bit for bit the same; of U only the products round, by u X^2 each. Two rounded
/// products are in the order of the exact ones, so only where one product is fused the sign may be wrong, and
/// |U| is then at most u X^2. With f = (U a_z + V b_z + W c_z) / S, S = U + V + W, and f' that of the search,
/// both between the least and the largest of these z, S (f - f') is the sum over the corners of U's error
/// times (a_z - f'): at most 2u X^2 times 2 (max z - min z), as the three distances from a point between the
/// ends are at most two ranges. The last rounding of U, V, W moves f by u Z; the products round by u Z, their
/// sum by 2u Z, S too, 1/S, the product with it, 1/d_z, the product with that, the search's own t and the
/// ends by u Z each: 12u Z / |d_z|.
struct FloatBounds {
    static constexpr float kUnit = 0x1p-24f;
    static constexpr float kSmallestReach = 0x1p-30f;
    static constexpr float kSmallestDirection = 0x1p-40f;
    static constexpr float kLargest = 0x1p40f;
    static constexpr float kSecondOrder = 1.0f + 0x1p-10f;
    static constexpr float kNear = 1.0f - 3.0f * kUnit, kFar = 1.0f + 4.0f * kUnit;  ///< of 1/d
    static constexpr float kSlab = kUnit * kSecondOrder, kMoved = kUnit * kSecondOrder;
    static constexpr float kMargin = 5.5f * kUnit * kSecondOrder;  ///< ClosestHit<Mode::Fast>::kMargin
    static constexpr float kEdge = 24.0f * kUnit * kSecondOrder;
    static constexpr float kFarEdge = 26.0f * kUnit * kSecondOrder;
    static constexpr float kTermUnit = kUnit * kSecondOrder;
    static constexpr float kFastEdge = kUnit * kSecondOrder;
    static constexpr float kFastRange = 4.0f * kUnit * kSecondOrder;
    static constexpr float kFastZ = 12.0f * kUnit * kSecondOrder;
    /// Added to every bound: products that underflow are off by 2^-150, times 2^41 for what they are
    /// multiplied with at most, and no inverse is below 2^-40 where this is multiplied with it.
    static constexpr float kUnderflow = 0x1p-94f;
};

/// Box of all primitives, as the setup of a ray reads it; the fourth lane is 0.
struct alignas(16) FloatScene {
    float lower[4]{}, upper[4]{}, largest[4]{};  ///< largest: |lower| or |upper|

    FloatScene() = default;
    explicit FloatScene(const Box& box) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = box.lower[axis];
            upper[axis] = box.upper[axis];
            largest[axis] = std::max(std::abs(lower[axis]), std::abs(upper[axis]));
        }
    }
};

}  // namespace boxwood
