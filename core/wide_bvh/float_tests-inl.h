// Float SIMD tests of boxes and triangles, once for each instruction set; bounds in float_bounds.h.
#if defined(BOXWOOD_FLOAT_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_FLOAT_TESTS_INL_H
#undef BOXWOOD_FLOAT_TESTS_INL_H
#else
#define BOXWOOD_FLOAT_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include "core/structure/closest.h"
#include "core/wide_bvh/float_bounds.h"
#include "core/wide_bvh/float_rays-inl.h"
#include "core/wide_bvh/octant-inl.h"
#include "core/wide_bvh/wide_bvh.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors over the lanes of a pack, or of a part of it where vectors are short.
template <uint32_t Size>
using PackTag = hn::CappedTag<float, Size>;
template <uint32_t Size>
constexpr uint32_t kPackPart = hn::MaxLanes(PackTag<Size>());

/// One of the prepared rays as the triangle tests take it, over the lanes of a pack.
template <Mode mode, uint32_t Size, class Bounds = FloatBounds>
struct FloatRay {
    using D = PackTag<Size>;
    using V = hn::Vec<D>;
    size_t x, y, z;  ///< axes; z is the one with the largest |d|
    V origin_x, origin_y, origin_z, direction_x, direction_y, direction_z, shear_x, shear_y;
    V inverse_z, t_min;
    V edge_bound;  ///< of the edge functions of any triangle, to be multiplied with X; exact mode only

    HWY_INLINE FloatRay(const FloatRays<mode, Bounds>& rays, size_t i)
        : x(rays.axes[0][i]), y(rays.axes[1][i]), z(rays.axes[2][i]) {
        const D d;
        origin_x = hn::Set(d, rays.origin[0][i]);
        origin_y = hn::Set(d, rays.origin[1][i]);
        origin_z = hn::Set(d, rays.origin[2][i]);
        direction_x = hn::Set(d, rays.direction[0][i]);
        direction_y = hn::Set(d, rays.direction[1][i]);
        direction_z = hn::Set(d, rays.direction[2][i]);
        shear_x = hn::Set(d, rays.shear_x[i]);
        shear_y = hn::Set(d, rays.shear_y[i]);
        inverse_z = hn::Set(d, rays.inverse_z[i]);
        t_min = hn::Set(d, rays.t_min[i]);
        edge_bound = hn::Set(d, rays.edge_bound[i]);
    }
};

/// Which lanes of a pack may be hit, and which surely are, at t in [lower, upper].
template <uint32_t Size>
struct PackHits {
    uint32_t open, sure;
    HWY_ALIGN float lower[Size], upper[Size];
};

/// Vertices relative to the origin, sheared so that the ray is the z axis, and their edge functions.
template <uint32_t Size>
struct Sheared {
    using D = PackTag<Size>;
    using V = hn::Vec<D>;
    /// Fast mode's triangle is the one whose products are rounded.
    template <Mode mode>
    static HWY_INLINE V shear(V slope, V z, V x) {
        return mode == Mode::Fast ? hn::Sub(x, hn::Mul(slope, z)) : hn::NegMulAdd(slope, z, x);
    }

    V ax, ay, az, bx, by, bz, cx, cy, cz, u, v, w;
    V size;  ///< X: the largest |x| or |y|

    template <Mode mode, class Bounds>
    HWY_INLINE Sheared(const TrianglePack<Size>& pack, uint32_t first,
                       const FloatRay<mode, Size, Bounds>& ray) {
        const D d;
        // Not nine addresses.
        const float* const x = pack.corners[0][ray.x] + first;
        const float* const y = pack.corners[0][ray.y] + first;
        const float* const z = pack.corners[0][ray.z] + first;
        constexpr size_t kCorner = sizeof(pack.corners[0]) / sizeof(float);
        az = hn::Sub(hn::Load(d, z), ray.origin_z);
        bz = hn::Sub(hn::Load(d, z + kCorner), ray.origin_z);
        cz = hn::Sub(hn::Load(d, z + 2 * kCorner), ray.origin_z);
        ax = shear<mode>(ray.shear_x, az, hn::Sub(hn::Load(d, x), ray.origin_x));
        bx = shear<mode>(ray.shear_x, bz, hn::Sub(hn::Load(d, x + kCorner), ray.origin_x));
        cx = shear<mode>(ray.shear_x, cz, hn::Sub(hn::Load(d, x + 2 * kCorner), ray.origin_x));
        ay = shear<mode>(ray.shear_y, az, hn::Sub(hn::Load(d, y), ray.origin_y));
        by = shear<mode>(ray.shear_y, bz, hn::Sub(hn::Load(d, y + kCorner), ray.origin_y));
        cy = shear<mode>(ray.shear_y, cz, hn::Sub(hn::Load(d, y + 2 * kCorner), ray.origin_y));
        u = hn::MulSub(cx, by, hn::Mul(cy, bx));
        v = hn::MulSub(ax, cy, hn::Mul(ay, cx));
        w = hn::MulSub(bx, ay, hn::Mul(by, ax));
        size = hn::Max(hn::Max(hn::Max(hn::Abs(ax), hn::Abs(ay)), hn::Max(hn::Abs(bx), hn::Abs(by))),
                       hn::Max(hn::Abs(cx), hn::Abs(cy)));
    }
    /// By the distance of these triangles.
    template <Mode mode, class Bounds>
    HWY_INLINE V edge_bound() const {
        const D d;
        const V underflow = hn::Set(d, Bounds::kUnderflow);
        if constexpr (mode == Mode::Fast)
            return hn::MulAdd(hn::Mul(hn::Set(d, Bounds::kFastEdge), size), size, underflow);
        const V reach = hn::Max(hn::Max(hn::Max(hn::Abs(az), hn::Abs(bz)), hn::Abs(cz)), size);
        return hn::MulAdd(hn::Mul(hn::Set(d, Bounds::kEdge), size), reach, underflow);
    }
    HWY_INLINE hn::Mask<D> is_missed(V bound) const {
        return hn::And(hn::Lt(hn::Min(u, hn::Min(v, w)), hn::Neg(bound)),
                       hn::Gt(hn::Max(u, hn::Max(v, w)), bound));
    }
    HWY_INLINE hn::Mask<D> is_hit(V bound) const {
        return hn::Or(hn::Gt(hn::Min(u, hn::Min(v, w)), bound),
                      hn::Lt(hn::Max(u, hn::Max(v, w)), hn::Neg(bound)));
    }
};

/// An interval of t for every lane of which `is_sure` holds, and that is hit.
template <uint32_t Size>
struct PlaneHits {
    using D = PackTag<Size>;
    using V = hn::Vec<D>;
    V lower, upper;
    hn::Mask<D> is_sure;

    /// Of the plane.
    template <class Bounds>
    HWY_INLINE PlaneHits(const TrianglePack<Size>& pack, uint32_t first,
                         const FloatRay<Mode::Exact, Size, Bounds>& ray, const Sheared<Size>& s) {
        const D d;
        const V ox = hn::Load(d, pack.corners[0][ray.x] + first),
                oy = hn::Load(d, pack.corners[0][ray.y] + first),
                oz = hn::Load(d, pack.corners[0][ray.z] + first);
        const V e1x = hn::Sub(hn::Load(d, pack.corners[1][ray.x] + first), ox),
                e1y = hn::Sub(hn::Load(d, pack.corners[1][ray.y] + first), oy),
                e1z = hn::Sub(hn::Load(d, pack.corners[1][ray.z] + first), oz),
                e2x = hn::Sub(hn::Load(d, pack.corners[2][ray.x] + first), ox),
                e2y = hn::Sub(hn::Load(d, pack.corners[2][ray.y] + first), oy),
                e2z = hn::Sub(hn::Load(d, pack.corners[2][ray.z] + first), oz);
        const V nx1 = hn::Mul(e1y, e2z), nx2 = hn::Mul(e1z, e2y), ny1 = hn::Mul(e1z, e2x),
                ny2 = hn::Mul(e1x, e2z), nz1 = hn::Mul(e1x, e2y), nz2 = hn::Mul(e1y, e2x);
        const V nx = hn::Sub(nx1, nx2), ny = hn::Sub(ny1, ny2), nz = hn::Sub(nz1, nz2);
        const V sum_x = hn::Add(hn::Abs(nx1), hn::Abs(nx2)), sum_y = hn::Add(hn::Abs(ny1), hn::Abs(ny2)),
                sum_z = hn::Add(hn::Abs(nz1), hn::Abs(nz2));
        const V ax = hn::Sub(ox, ray.origin_x), ay = hn::Sub(oy, ray.origin_y);
        const V dx = ray.direction_x, dy = ray.direction_y, dz = ray.direction_z;
        const V numerator = hn::MulAdd(ax, nx, hn::MulAdd(ay, ny, hn::Mul(s.az, nz)));
        const V denominator = hn::MulAdd(dx, nx, hn::MulAdd(dy, ny, hn::Mul(dz, nz)));
        const V underflow = hn::Set(d, Bounds::kUnderflow);
        const V numerator_error = hn::MulAdd(
            hn::Set(d, 11.0f * Bounds::kTermUnit),
            hn::MulAdd(hn::Abs(ax), sum_x, hn::MulAdd(hn::Abs(ay), sum_y, hn::Mul(hn::Abs(s.az), sum_z))),
            underflow);
        const V denominator_error = hn::MulAdd(
            hn::Set(d, 7.0f * Bounds::kTermUnit),
            hn::MulAdd(hn::Abs(dx), sum_x, hn::MulAdd(hn::Abs(dy), sum_y, hn::Mul(hn::Abs(dz), sum_z))),
            underflow);
        is_sure = hn::Gt(hn::Abs(denominator), hn::Mul(hn::Set(d, 16.0f), denominator_error));
        const V inverse = hn::Div(hn::Set(d, 1.0f), denominator);
        const V t = hn::Mul(numerator, inverse);
        const V size = hn::Mul(hn::Set(d, 16.0f / 15.0f * FloatBounds::kSecondOrder), hn::Abs(inverse));
        const V error =
            hn::MulAdd(size, hn::MulAdd(hn::Abs(t), denominator_error, numerator_error), underflow);
        lower = hn::Sub(t, error);
        upper = hn::Add(t, error);
    }
    /// Of the search in fast mode.
    template <class Bounds>
    HWY_INLINE PlaneHits(const TrianglePack<Size>&, uint32_t, const FloatRay<Mode::Fast, Size, Bounds>& ray,
                         const Sheared<Size>& s) {
        const D d;
        const V underflow = hn::Set(d, Bounds::kUnderflow);
        const V inverse_sum = hn::Div(hn::Set(d, 1.0f), hn::Add(s.u, hn::Add(s.v, s.w)));
        const V z = hn::Mul(hn::MulAdd(s.u, s.az, hn::MulAdd(s.v, s.bz, hn::Mul(s.w, s.cz))), inverse_sum);
        const V least = hn::Min(s.az, hn::Min(s.bz, s.cz)), most = hn::Max(s.az, hn::Max(s.bz, s.cz));
        const V products = hn::Mul(hn::Mul(hn::Set(d, Bounds::kFastRange), s.size), s.size);
        const V edges = hn::MulAdd(products, hn::Sub(most, least), underflow);
        const V z_error = hn::MulAdd(hn::Set(d, Bounds::kFastZ), hn::Max(hn::Abs(least), hn::Abs(most)),
                                     hn::Mul(edges, hn::Abs(inverse_sum)));
        const V t = hn::Mul(z, ray.inverse_z);
        const V error = hn::MulAdd(z_error, hn::Abs(ray.inverse_z), underflow);
        lower = hn::Sub(t, error);
        upper = hn::Add(t, error);
        is_sure = hn::Le(lower, upper);
    }
};

/// Of the part of a pack that begins at lane `first`: its lanes that may be hit at `limit` or before.
template <Mode mode, uint32_t Size, class Bounds>
HWY_INLINE uint32_t test_part(const TrianglePack<Size>& pack, uint32_t first,
                              const FloatRay<mode, Size, Bounds>& ray, float limit, PackHits<Size>& hits) {
    const PackTag<Size> d;
    using V = hn::Vec<PackTag<Size> >;
    const Sheared<Size> s(pack, first, ray);
    if constexpr (mode == Mode::Exact) {
        const V far_bound = hn::MulAdd(ray.edge_bound, s.size, hn::Set(d, Bounds::kUnderflow));
        if (HWY_LIKELY(hn::AllTrue(d, s.is_missed(far_bound)))) return 0;
    }
    // In exact mode again, with the bound for these triangles' own distance instead of the scene's.
    const V bound = s.template edge_bound<mode, Bounds>();
    const auto missed = s.is_missed(bound);
    const PlaneHits<Size> plane(pack, first, ray, s);
    const auto sure = hn::And(s.is_hit(bound), plane.is_sure);
    // Where a branch would often be mispredicted: a ray that leaves a surface meets its triangle, before
    // t_min.
    const auto is_outside = hn::Or(hn::Gt(plane.lower, hn::Set(d, limit)), hn::Lt(plane.upper, ray.t_min));
    const auto closed = hn::Or(missed, hn::And(sure, is_outside));
    hits.sure |= mask_bits(d, sure) << first;
    hn::Store(plane.lower, d, hits.lower + first);
    hn::Store(plane.upper, d, hits.upper + first);
    return ((1u << kPackPart<Size>)-1) & ~mask_bits(d, closed);
}

/// False if no triangle of the pack can be hit in the ray's range, at `limit` or before.
template <Mode mode, uint32_t Size, class Bounds>
HWY_INLINE bool test_pack(const TrianglePack<Size>& pack, const FloatRay<mode, Size, Bounds>& ray,
                          float limit, PackHits<Size>& hits) {
    hits.open = hits.sure = 0;
    for (uint32_t first = 0; first < Size; first += kPackPart<Size>)
        hits.open |= test_part(pack, first, ray, limit, hits) << first;
    return hits.open != 0;
}

/// One of the prepared rays as the box tests take it, over the lanes of a node.
template <uint32_t Width>
struct BoxRay {
    using D = hn::CappedTag<float, Width>;
    using V = hn::Vec<D>;
    V near_inverse_x, near_inverse_y, near_inverse_z, near_x, near_y, near_z;
    V far_inverse_x, far_inverse_y, far_inverse_z, far_x, far_y, far_z, t_min;
    /// Those of the first node's planes that come first and last along the ray.
    const float *near_planes_x, *near_planes_y, *near_planes_z;
    const float *far_planes_x, *far_planes_y, *far_planes_z;

    template <Mode mode, class Bounds>
    HWY_INLINE BoxRay(const FloatRays<mode, Bounds>& rays, size_t i, const Planes<Width>& planes,
                      const typename WideBvh<Width>::Node* nodes)
        : near_planes_x(nodes->lower[0] + planes.near[0]),
          near_planes_y(nodes->lower[0] + planes.near[1]),
          near_planes_z(nodes->lower[0] + planes.near[2]),
          far_planes_x(nodes->lower[0] + planes.far[0]),
          far_planes_y(nodes->lower[0] + planes.far[1]),
          far_planes_z(nodes->lower[0] + planes.far[2]) {
        const D d;
        near_inverse_x = hn::Set(d, rays.near_inverse[0][i]);
        far_inverse_x = hn::Set(d, rays.far_inverse[0][i]);
        near_inverse_y = hn::Set(d, rays.near_inverse[1][i]);
        far_inverse_y = hn::Set(d, rays.far_inverse[1][i]);
        near_inverse_z = hn::Set(d, rays.near_inverse[2][i]);
        far_inverse_z = hn::Set(d, rays.far_inverse[2][i]);
        near_x = hn::Set(d, rays.near_offset[0][i]);
        near_y = hn::Set(d, rays.near_offset[1][i]);
        near_z = hn::Set(d, rays.near_offset[2][i]);
        far_x = hn::Set(d, rays.far_offset[0][i]);
        far_y = hn::Set(d, rays.far_offset[1][i]);
        far_z = hn::Set(d, rays.far_offset[2][i]);
        t_min = hn::Set(d, rays.t_min[i]);
    }
    /// `at`: of a node's first lane to be tested, in floats from the first node's first lane.
    HWY_INLINE V entry(size_t at) const {
        const D d;
        return hn::Max(hn::Max(hn::MulAdd(hn::Load(d, near_planes_x + at), near_inverse_x, near_x),
                               hn::MulAdd(hn::Load(d, near_planes_y + at), near_inverse_y, near_y)),
                       hn::Max(hn::MulAdd(hn::Load(d, near_planes_z + at), near_inverse_z, near_z), t_min));
    }
    HWY_INLINE V exit(size_t at, float limit) const {
        const D d;
        return hn::Min(
            hn::Min(hn::MulAdd(hn::Load(d, far_planes_x + at), far_inverse_x, far_x),
                    hn::MulAdd(hn::Load(d, far_planes_y + at), far_inverse_y, far_y)),
            hn::Min(hn::MulAdd(hn::Load(d, far_planes_z + at), far_inverse_z, far_z), hn::Set(d, limit)));
    }
    /// See entry().
    static HWY_INLINE size_t place_of(uint32_t node) {
        return size_t{node} * (sizeof(typename WideBvh<Width>::Node) / sizeof(float));
    }
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#endif
