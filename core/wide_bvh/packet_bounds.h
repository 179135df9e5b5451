#pragma once

#include "core/structure/filter.h"
#include "core/wide_bvh/float_bounds.h"

namespace boxwood {

/// What float SIMD may decide for sure about a triangle and many rays that share their origin, as far as that
/// differs from FloatBounds, whose names are used here: what depends on the triangle alone is computed once
/// for all rays. u = 2^-24.
///
/// Boxes. One r = 1/d serves near and far planes, so what is proportional to the parameter is in the pad: the
/// roundings of r and of the last sum are at most u R_i |r| each, with R_i the distance of the scene's
/// farthest plane along the axis; u |r| (2 (R_i + |o|) + P) in all, fused or not.
///
/// Edge functions. With P a corner from the origin, e the edge that begins there, n = P x e, z the axis along
/// which |d| is largest and s = d / d_z, the edge function is F = d.(P x (P + e)) / d_z = s_x n_x + (s_y n_y
/// + n_z), whose sign decides. Of its monomials s p e those of n_y carry the most roundings that may change
/// the sign: of s, p and e, of the product, of the difference in n, of the product with s, of the inner sum;
/// the last sum cannot. So F has the right sign where it exceeds 7u times the sum of the absolute monomials.
/// With S the largest |s| of all rays and E the largest |e| of all axes, that sum is at most E (|p_x| (1 +
/// S_y) + |p_y| (1 + S_x) + |p_z| (S_x + S_y)). So one bound holds for all rays.
///
/// t. As in interval_of_t of filter.h, with D' = D / d_z = s_x n_x + s_y n_y + n_z, n the triangle's normal,
/// whose factors are two edges, and with the last sum: 8u. N carries 8u as there. |t d_z - N / D'| <= (eN +
/// |t d_z| eD) / (|D'| - eD), at most 16/15 of that over |D'| where |D'| > 16 eD. The inverse, its product
/// with N, 1/d_z, the product with that and the ends are rounded: 5u |t|, at most 5u / |D'| times the
/// monomials of N, and 5u eD / |D'| |t d_z|: of second order. 13u instead of 8u.
///
/// Rounded t, in double, u = 2^-53, in kDoubleTermUnit. As interval_of_t, but N is multiplied with 1 / D,
/// both rounded: 3u |t| with the ends instead of 2u, and eD < 2^-40 |D| is asked for, so that |D| - eD is |D|
/// to second order.
///
/// Packets as one. With r the inverse of any ray, r' that of the least and r" that of the largest size, (p
/// - o) r is at least (p - o) r' and at most (p - o) r" where it is not negative. A near plane where it is
/// negative lies before t = 0, which is a lower bound of its own; behind a far plane no ray meets the box.
/// The pad grows with |r| and is taken at r", with what moved components add, so it covers the roundings of
/// r' and r", which are no larger, and those of r itself.
struct PacketBounds : FloatBounds {
    static constexpr float kSharedEdge = 7.0f * kUnit * kSecondOrder;
    static constexpr float kNumerator = 13.0f * kUnit * kSecondOrder;
    static constexpr float kDenominator = 8.0f * kUnit * kSecondOrder;
    static constexpr double kDoubleTermUnit = FilterBounds::kTermUnit;
};

}  // namespace boxwood
