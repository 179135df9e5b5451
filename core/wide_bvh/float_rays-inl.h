// Rays prepared for float SIMD tests, once for each instruction set; bounds in float_bounds.h.
#if defined(BOXWOOD_FLOAT_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_FLOAT_RAYS_INL_H
#undef BOXWOOD_FLOAT_RAYS_INL_H
#else
#define BOXWOOD_FLOAT_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <limits>
#include <span>

#include "core/structure/closest.h"
#include "core/wide_bvh/float_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

/// What the tests of a box and of a triangle need of each of up to kCount rays, structure of arrays: made for
/// as many rays at a time as a vector has lanes, so that a ray's own search begins with its first box.
template <Mode mode, class Bounds = FloatBounds>
class FloatRays {
public:
    static constexpr size_t kCount = 64;
    using Floats = float[kCount];
    using Numbers = uint32_t[kCount];

    HWY_ALIGN Floats t_min, t_max;
    /// See FloatBounds, "Boxes".
    HWY_ALIGN Floats near_inverse[3], near_offset[3], far_inverse[3], far_offset[3];
    /// In the order of the axes x, y, z of the shear; z is the one with the largest |d|.
    HWY_ALIGN Floats origin[3], direction[3];
    HWY_ALIGN Numbers axes[3];
    HWY_ALIGN Floats shear_x, shear_y, inverse_z;
    HWY_ALIGN Floats
        edge_bound;            ///< of the edge functions of any triangle, to be multiplied with X; exact mode
    HWY_ALIGN Numbers octant;  ///< bit axis set: the direction's sign bit is
    HWY_ALIGN Numbers usable;  ///< 1: the ray is valid, and the bounds hold; otherwise 0

    /// At most kCount rays.
    HWY_INLINE FloatRays(std::span<const Ray> rays, const FloatScene& scene) {
        for (size_t i = 0; i < rays.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                origin[axis][i] = rays[i].origin[axis];
                direction[axis][i] = rays[i].direction[axis];
            }
            t_min[i] = rays[i].t_min;
            t_max[i] = rays[i].t_max;
        }
        // What a last vector has beyond the rays is computed and not read.
        const size_t lanes = hn::Lanes(D());
        for (size_t i = rays.size(); i % lanes != 0; ++i) {
            for (int axis = 0; axis < 3; ++axis) origin[axis][i] = direction[axis][i] = 1.0f;
            t_min[i] = t_max[i] = 0.0f;
        }
        for (size_t i = 0; i < rays.size(); i += lanes) prepare(scene, i);
    }

private:
    using D = hn::CappedTag<float, 16>;
    using V = hn::Vec<D>;
    using DU = hn::RebindToUnsigned<D>;
    using VU = hn::Vec<DU>;

    HWY_INLINE void prepare(const FloatScene& scene, size_t i) {
        const D d;
        const DU du;
        const V o[3] = {hn::Load(d, origin[0] + i), hn::Load(d, origin[1] + i), hn::Load(d, origin[2] + i)};
        const V dir[3] = {hn::Load(d, direction[0] + i), hn::Load(d, direction[1] + i),
                          hn::Load(d, direction[2] + i)};
        const V size[3] = {hn::Abs(dir[0]), hn::Abs(dir[1]), hn::Abs(dir[2])};
        const V largest_d = hn::Max(hn::Max(size[0], size[1]), size[2]);
        V reaches[3];
        for (int axis = 0; axis < 3; ++axis) {
            reaches[axis] = hn::Max(hn::Abs(hn::Sub(hn::Set(d, scene.lower[axis]), o[axis])),
                                    hn::Abs(hn::Sub(hn::Set(d, scene.upper[axis]), o[axis])));
        }
        const V reach = hn::Mul(hn::Max(hn::Max(reaches[0], reaches[1]), reaches[2]),
                                hn::Set(d, 1.0f + 4.0f * FloatBounds::kUnit));
        const V least = hn::Mul(largest_d, hn::Set(d, FloatBounds::kUnit));
        const V most = hn::Set(d, FloatBounds::kLargest);
        // Comparisons with NaN are false.
        hn::Mask<D> is_usable = hn::And(hn::Le(reach, most), hn::Le(largest_d, most));
        V r[3];
        VU signs = hn::Zero(du);
        for (int axis = 0; axis < 3; ++axis) {
            const auto is_moved = hn::Lt(size[axis], least);
            const V moved_d = hn::IfThenElse(is_moved, hn::CopySign(least, dir[axis]), dir[axis]);
            r[axis] = hn::Div(hn::Set(d, 1.0f), moved_d);
            V moved = hn::IfThenElse(is_moved, hn::Mul(reach, hn::Set(d, Bounds::kMoved)),
                                     hn::Set(d, Bounds::kUnderflow));
            if constexpr (mode == Mode::Fast) moved = hn::MulAdd(reach, hn::Set(d, Bounds::kMargin), moved);
            const V size_of_o = hn::Abs(o[axis]), largest = hn::Set(d, scene.largest[axis]);
            const V sizes = HWY_NATIVE_FMA ? size_of_o : hn::MulAdd(hn::Set(d, 2.0f), size_of_o, largest);
            const V pad = hn::Mul(hn::Abs(r[axis]), hn::MulAdd(hn::Set(d, Bounds::kSlab), sizes, moved));
            const V near = hn::Mul(r[axis], hn::Set(d, Bounds::kNear));
            const V far = hn::Mul(r[axis], hn::Set(d, Bounds::kFar));
            hn::Store(near, d, near_inverse[axis] + i);
            hn::Store(hn::NegMulSub(o[axis], near, pad), d, near_offset[axis] + i);
            hn::Store(far, d, far_inverse[axis] + i);
            hn::Store(hn::NegMulAdd(o[axis], far, pad), d, far_offset[axis] + i);
            signs = hn::Or(signs, hn::ShiftLeftSame(hn::ShiftRight<31>(hn::BitCast(du, dir[axis])), axis));
            is_usable = hn::And(is_usable,
                                hn::And(hn::Le(hn::Add(size_of_o, largest), most), hn::Le(size[axis], most)));
        }
        hn::Store(signs, du, octant + i);
        const V from = hn::Load(d, t_min + i), to = hn::Load(d, t_max + i);
        is_usable = hn::And(is_usable, hn::Ge(reach, hn::Set(d, FloatBounds::kSmallestReach)));
        is_usable = hn::And(is_usable, hn::Ge(largest_d, hn::Set(d, FloatBounds::kSmallestDirection)));
        is_usable = hn::And(is_usable, hn::And(hn::Ge(from, hn::Zero(d)), hn::Le(from, to)));
        is_usable = hn::And(is_usable, hn::Lt(from, hn::Set(d, std::numeric_limits<float>::infinity())));
        hn::Store(hn::IfThenElseZero(hn::RebindMask(du, is_usable), hn::Set(du, 1)), du, usable + i);
        hn::Store(hn::Mul(reach, hn::Set(d, Bounds::kFarEdge)), d, edge_bound + i);
        choose_axes(size, o, dir, r, i);
    }
    HWY_INLINE void choose_axes(const V (&size)[3], const V (&o)[3], const V (&dir)[3], const V (&r)[3],
                                size_t i) {
        const D d;
        const DU du;
        const auto is_x_first = hn::Ge(size[0], size[1]);
        const auto is_z_0 = hn::And(is_x_first, hn::Ge(size[0], size[2]));
        const auto is_z_1 = hn::AndNot(is_x_first, hn::Ge(size[1], size[2]));
        const auto chosen = [&](V if_0, V if_1, V if_2) {
            return hn::IfThenElse(is_z_0, if_0, hn::IfThenElse(is_z_1, if_1, if_2));
        };
        const auto number = [&](uint32_t if_0, uint32_t if_1, uint32_t if_2) {
            return hn::IfThenElse(
                hn::RebindMask(du, is_z_0), hn::Set(du, if_0),
                hn::IfThenElse(hn::RebindMask(du, is_z_1), hn::Set(du, if_1), hn::Set(du, if_2)));
        };
        const V z = chosen(dir[0], dir[1], dir[2]);
        const V x = chosen(dir[1], dir[2], dir[0]), y = chosen(dir[2], dir[0], dir[1]);
        hn::Store(number(1, 2, 0), du, axes[0] + i);
        hn::Store(number(2, 0, 1), du, axes[1] + i);
        hn::Store(number(0, 1, 2), du, axes[2] + i);
        hn::Store(x, d, direction[0] + i);
        hn::Store(y, d, direction[1] + i);
        hn::Store(z, d, direction[2] + i);
        hn::Store(chosen(o[1], o[2], o[0]), d, origin[0] + i);
        hn::Store(chosen(o[2], o[0], o[1]), d, origin[1] + i);
        hn::Store(chosen(o[0], o[1], o[2]), d, origin[2] + i);
        hn::Store(hn::Div(x, z), d, shear_x + i);
        hn::Store(hn::Div(y, z), d, shear_y + i);
        hn::Store(chosen(r[0], r[1], r[2]), d, inverse_z + i);
    }
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#endif
