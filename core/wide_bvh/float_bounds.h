#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/box.h"

namespace boxwood {

/// What float SIMD may decide for sure, for rays of ordinary size in scenes of ordinary size. u = 2^-24 is
/// the largest relative error of one operation, fused or not; R the distance, along an axis, of the scene's
/// farthest corner from the ray's origin.
///
/// Boxes. The parameter of a plane p of one axis is p r + c, with r = 1/d and c = -(o r), both rounded. Q is
/// the sum of |o| and the largest |p| of the scene's box: |p - o|, |p| and |o| are at most Q. Roundings of r,
/// o r, c, p r and of the sum are at most u Q |r| each, to first order: 5u Q |r| in all. A component below
/// 2^-24 of the largest one D is replaced by that: inside the scene's box D t is at most R, so the point at t
/// moves by at most u R, which is u R |r| of the parameter. Both, and the margin by which fast mode's boxes
/// are larger, are taken off c for near planes and added to it for far ones, so every box is met that is met
/// exactly, and its entry is a lower bound. (Without that a fused slab test misses boxes.)
///
/// Edge functions. As EdgeFilter in filter.h: |U - U*| <= 4X u (2X + 3.5Z) + 2X^2 u <= 24u X max(X, Z), and
/// X, Z <= R.
///
/// t. As interval_of_t in filter.h: numerator and denominator are off by at most 8u times the sum of their
/// absolute monomials, eN and eD; where |D| > 2 eD, |t - t*| <= (eN + |t| eD) / (|D| - eD) <= 2 (eN + |t| eD)
/// / |D|, and 2u |t| for quotient and ends.
///
/// Fast mode compares the t that it calculates itself, in another way: z = (U a_z + V b_z + W c_z) / S, S = U
/// + V + W, with edge functions that obey the same bound e: twice the bound decides for it. With p = b_z -
/// a_z, q = c_z - a_z, l = max(|p|, |q|), (V p + W q) / S is between 0, p and q, so errors of V, W and S move
/// it by at most 5 e l / (|S| - 3e), at most 10 e l / |S| where |S| > 6e; the z by u Z each, p and q by 2u Z;
/// t = z / d_z is rounded once. 10 e l / (|S| |d_z|) + 8u Z / |d_z| covers it.
struct FloatBounds {
    static constexpr float kUnit = 0x1p-24f;
    static constexpr float kSmallestReach = 0x1p-30f;
    static constexpr float kSmallestDirection = 0x1p-40f;
    static constexpr float kLargest = 0x1p40f;
    static constexpr float kSecondOrder = 1.0f + 0x1p-10f;
    static constexpr float kSlab = 6.0f * kUnit, kMoved = kUnit * kSecondOrder;
    static constexpr float kEdge = 24.0f * kUnit * kSecondOrder;
    static constexpr float kTerms = 8.0f * kUnit * kSecondOrder;
    static constexpr float kFastEdges = 10.0f * kSecondOrder, kFastZ = 8.0f * kUnit * kSecondOrder;
    /// Added to the bound of U and of t's terms. Products that underflow are off by 2^-149 at most; a sum
    /// that is above this divides that to less than u R / 4, as R >= 2^-30.
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
