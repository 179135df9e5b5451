// Float SIMD tests of triangles for packets of rays that share their origin, once for each instruction set;
// bounds in packet_bounds.h.
#if defined(BOXWOOD_PACKET_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_PACKET_TESTS_INL_H
#undef BOXWOOD_PACKET_TESTS_INL_H
#else
#define BOXWOOD_PACKET_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include "core/structure/filter.h"
#include "core/wide_bvh/packet_rays-inl.h"
#include "core/wide_bvh/wide_bvh.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Triangles in double, one for each ray of a packet, or one for all.
struct PacketTriangles {
    using D = hn::CappedTag<double, kPacketSize>;
    using V = hn::Vec<D>;
    static constexpr uint32_t kStep = hn::MaxLanes(D());

    HWY_ALIGN float corners[3][3][kPacketSize];
    bool are_same = false;  ///< one for all: kStep times

    template <uint32_t Size>
    HWY_INLINE void set(uint32_t i, const TrianglePack<Size>& pack, uint32_t lane) {
        set_corner(i, pack, lane, 0);
        set_corner(i, pack, lane, 1);
        set_corner(i, pack, lane, 2);
    }
    template <uint32_t Size>
    HWY_INLINE void set_corner(uint32_t i, const TrianglePack<Size>& pack, uint32_t lane, uint32_t corner) {
        corners[corner][0][i] = pack.corners[corner][0][lane];
        corners[corner][1][i] = pack.corners[corner][1][lane];
        corners[corner][2][i] = pack.corners[corner][2][lane];
    }
    template <uint32_t Size>
    HWY_INLINE void set_all(const TrianglePack<Size>& pack, uint32_t lane) {
        are_same = true;
        fill_corner(pack, lane, 0);
        fill_corner(pack, lane, 1);
        fill_corner(pack, lane, 2);
    }
    template <uint32_t Size>
    HWY_INLINE void fill_corner(const TrianglePack<Size>& pack, uint32_t lane, uint32_t corner) {
        const hn::Rebind<float, D> df;
        hn::Store(hn::Set(df, pack.corners[corner][0][lane]), df, corners[corner][0]);
        hn::Store(hn::Set(df, pack.corners[corner][1][lane]), df, corners[corner][1]);
        hn::Store(hn::Set(df, pack.corners[corner][2][lane]), df, corners[corner][2]);
    }

    /// What of the interval depends on the triangles alone, those from `first` on.
    struct Planes {
        V nx, ny, nz, sum_x, sum_y, sum_z, numerator, numerator_error;

        template <class Bounds>
        HWY_INLINE Planes(const PacketTriangles& of, const BasicPacketRays<Bounds>& rays, uint32_t first) {
            const D d;
            const V x = of.corner(0, 0, first), y = of.corner(0, 1, first), z = of.corner(0, 2, first);
            const V e1x = hn::Sub(of.corner(1, 0, first), x), e1y = hn::Sub(of.corner(1, 1, first), y),
                    e1z = hn::Sub(of.corner(1, 2, first), z), e2x = hn::Sub(of.corner(2, 0, first), x),
                    e2y = hn::Sub(of.corner(2, 1, first), y), e2z = hn::Sub(of.corner(2, 2, first), z);
            const V nx1 = hn::Mul(e1y, e2z), nx2 = hn::Mul(e1z, e2y), ny1 = hn::Mul(e1z, e2x),
                    ny2 = hn::Mul(e1x, e2z), nz1 = hn::Mul(e1x, e2y), nz2 = hn::Mul(e1y, e2x);
            nx = hn::Sub(nx1, nx2);
            ny = hn::Sub(ny1, ny2);
            nz = hn::Sub(nz1, nz2);
            sum_x = hn::Add(hn::Abs(nx1), hn::Abs(nx2));
            sum_y = hn::Add(hn::Abs(ny1), hn::Abs(ny2));
            sum_z = hn::Add(hn::Abs(nz1), hn::Abs(nz2));
            const V ax = hn::Sub(x, hn::Set(d, double(rays.origin[0]))),
                    ay = hn::Sub(y, hn::Set(d, double(rays.origin[1]))),
                    az = hn::Sub(z, hn::Set(d, double(rays.origin[2])));
            numerator = dot(ax, ay, az, nx, ny, nz);
            numerator_error = hn::Mul(hn::Set(d, 8.0 * Bounds::kDoubleTermUnit),
                                      dot(hn::Abs(ax), hn::Abs(ay), hn::Abs(az), sum_x, sum_y, sum_z));
        }
    };
    /// t of the rays from `first` on and their triangles' planes; the interval holds where `is_sure` does.
    struct Interval {
        V lower, upper;
        hn::Mask<D> is_sure;
    };
    /// As interval_of_t does.
    template <class Bounds>
    HWY_INLINE static Interval interval(const Planes& of, const BasicPacketRays<Bounds>& rays,
                                        uint32_t first) {
        const D d;
        const V dx = in_double(rays.directions[0] + first), dy = in_double(rays.directions[1] + first),
                dz = in_double(rays.directions[2] + first);
        const V denominator = dot(dx, dy, dz, of.nx, of.ny, of.nz);
        const V denominator_error =
            hn::Mul(hn::Set(d, 7.0 * Bounds::kDoubleTermUnit),
                    dot(hn::Abs(dx), hn::Abs(dy), hn::Abs(dz), of.sum_x, of.sum_y, of.sum_z));
        const V inverse = hn::Div(hn::Set(d, 1.0), denominator);
        const V quotient = hn::Mul(of.numerator, inverse), size = hn::Abs(quotient);
        const V error = hn::MulAdd(hn::MulAdd(size, denominator_error, of.numerator_error),
                                   hn::Mul(hn::Abs(inverse), hn::Set(d, 1.0 + 0x1p-38)),
                                   hn::Mul(hn::Set(d, 3.0 * Bounds::kDoubleTermUnit), size));
        return {hn::Sub(quotient, error), hn::Add(quotient, error),
                hn::Lt(denominator_error, hn::Mul(hn::Set(d, 0x1p-40), hn::Abs(denominator)))};
    }
    /// Sets t of all rays, rounded once; those whose bits are set are right.
    template <class Bounds>
    HWY_INLINE uint32_t round_t(const BasicPacketRays<Bounds>& rays, float* t) const {
        uint32_t right = 0;
        Planes planes(*this, rays, 0);
        for (uint32_t first = 0; first < kPacketSize; first += kStep) {
            if (first > 0 && !are_same) planes = Planes(*this, rays, first);
            const hn::Rebind<float, D> df;
            const Interval t_here = interval(planes, rays, first);
            const auto lower = hn::DemoteTo(df, t_here.lower), upper = hn::DemoteTo(df, t_here.upper);
            hn::Store(upper, df, t + first);
            right |= (mask_bits(df, hn::Eq(lower, upper)) & mask_bits(D(), t_here.is_sure)) << first;
        }
        return right;
    }

private:
    static HWY_INLINE V in_double(const float* from) {
        return hn::PromoteTo(D(), hn::Load(hn::Rebind<float, D>(), from));
    }
    HWY_INLINE V corner(uint32_t i, uint32_t axis, uint32_t first) const {
        return in_double(corners[i][axis] + first);
    }
    static HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
        return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
    }
};

/// Vectors of the triangles of a pack, or of a part of it where vectors are short, in the rays' axes.
template <uint32_t Size>
struct PackVectors {
    using D = hn::CappedTag<float, Size>;
    using V = hn::Vec<D>;
    V x, y, z;

    HWY_INLINE PackVectors(V in_x, V in_y, V in_z) : x(in_x), y(in_y), z(in_z) {}
    template <uint32_t Width, class Bounds>
    HWY_INLINE PackVectors(const float corners[3][Size], uint32_t first, const Frustum<Width, Bounds>& rays)
        : x(hn::Load(D(), corners[rays.x] + first)),
          y(hn::Load(D(), corners[rays.y] + first)),
          z(hn::Load(D(), corners[rays.z] + first)) {}
    HWY_INLINE PackVectors minus(const PackVectors& v) const {
        return {hn::Sub(x, v.x), hn::Sub(y, v.y), hn::Sub(z, v.z)};
    }
    HWY_INLINE V largest() const { return hn::Max(hn::Max(hn::Abs(x), hn::Abs(y)), hn::Abs(z)); }
    /// Sum of the absolute components, each multiplied with a weight.
    HWY_INLINE V sum(V of_x, V of_y, V of_z) const {
        return hn::MulAdd(of_x, hn::Abs(x), hn::MulAdd(of_y, hn::Abs(y), hn::Mul(of_z, hn::Abs(z))));
    }
};

/// What the triangles of a pack, or of the part of it that begins at lane `first`, are to all rays of a
/// frustum; see PacketBounds.
template <uint32_t Size>
struct PackEdges {
    using Vectors = PackVectors<Size>;
    using D = typename Vectors::D;
    using V = typename Vectors::V;
    static constexpr uint32_t kPart = hn::MaxLanes(D());
    HWY_ALIGN float edges[3][3][kPart];  ///< n of each edge function, by axis x, y, z of the rays
    HWY_ALIGN float bounds[kPart];       ///< of the edge functions of a triangle
    Vectors a, ab, bc;                   ///< corner a from the origin, edges

    template <uint32_t Width, class Bounds>
    HWY_INLINE PackEdges(const TrianglePack<Size>& pack, uint32_t first, const Frustum<Width, Bounds>& rays)
        : PackEdges({pack.corners[0], first, rays}, {pack.corners[1], first, rays},
                    {pack.corners[2], first, rays},
                    {hn::Set(D(), rays.origin[rays.x]), hn::Set(D(), rays.origin[rays.y]),
                     hn::Set(D(), rays.origin[rays.z])},
                    rays) {}

private:
    template <uint32_t Width, class Bounds>
    HWY_INLINE PackEdges(const Vectors& at_a, const Vectors& at_b, const Vectors& at_c, const Vectors& origin,
                         const Frustum<Width, Bounds>& rays)
        : a(at_a.minus(origin)), ab(at_b.minus(at_a)), bc(at_c.minus(at_b)) {
        const D d;
        const Vectors b = at_b.minus(origin), c = at_c.minus(origin), ca = at_a.minus(at_c);
        store_cross(a, ab, edges[0]);
        store_cross(b, bc, edges[1]);
        store_cross(c, ca, edges[2]);
        const float shear_x = rays.shear_sizes[0], shear_y = rays.shear_sizes[1];
        const V of_x = hn::Set(d, 1.0f + shear_y), of_y = hn::Set(d, 1.0f + shear_x),
                of_z = hn::Set(d, shear_x + shear_y);
        const V size =
            hn::Max(hn::Max(a.sum(of_x, of_y, of_z), b.sum(of_x, of_y, of_z)), c.sum(of_x, of_y, of_z));
        const V size_of_edges = hn::Max(hn::Max(ab.largest(), bc.largest()), ca.largest());
        hn::Store(hn::MulAdd(hn::Mul(hn::Set(d, Bounds::kSharedEdge), size_of_edges), size,
                             hn::Set(d, Bounds::kUnderflow)),
                  d, bounds);
    }
    static HWY_INLINE void store_cross(const Vectors& p, const Vectors& e, float n[3][kPart]) {
        const D d;
        hn::Store(hn::MulSub(p.y, e.z, hn::Mul(p.z, e.y)), d, n[0]);
        hn::Store(hn::MulSub(p.z, e.x, hn::Mul(p.x, e.z)), d, n[1]);
        hn::Store(hn::MulSub(p.x, e.y, hn::Mul(p.y, e.x)), d, n[2]);
    }
};

/// The least and the largest of a triangle's three edge functions, for the rays of vector i.
struct EdgeFunctions {
    PacketVector least, most;

    template <uint32_t Size, class Bounds>
    HWY_INLINE EdgeFunctions(const BasicPacketRays<Bounds>& rays, const PackEdges<Size>& of, uint32_t lane,
                             uint32_t i) {
        const PacketVector u = rays.sheared_dot(of.edges[0], lane, i),
                           v = rays.sheared_dot(of.edges[1], lane, i),
                           w = rays.sheared_dot(of.edges[2], lane, i);
        least = hn::Min(u, hn::Min(v, w));
        most = hn::Max(u, hn::Max(v, w));
    }
    HWY_INLINE hn::Mask<PacketTag> is_missed(PacketVector bound) const {
        return hn::And(hn::Lt(least, hn::Neg(bound)), hn::Gt(most, bound));
    }
    HWY_INLINE hn::Mask<PacketTag> is_hit(PacketVector bound) const {
        return hn::Or(hn::Gt(least, bound), hn::Lt(most, hn::Neg(bound)));
    }
};

/// The planes of the same triangles.
template <uint32_t Size>
struct PackPlanes {
    using D = typename PackEdges<Size>::D;
    using V = hn::Vec<D>;
    static constexpr uint32_t kPart = PackEdges<Size>::kPart;
    HWY_ALIGN float normals[3][kPart];  ///< by axis x, y, z of the rays
    HWY_ALIGN float numerators[kPart], numerator_errors[kPart], denominator_errors[kPart];

    template <uint32_t Width, class Bounds>
    HWY_INLINE PackPlanes(const PackEdges<Size>& of, const Frustum<Width, Bounds>& rays) {
        const D d;
        const V nx1 = hn::Mul(of.ab.y, of.bc.z), nx2 = hn::Mul(of.ab.z, of.bc.y),
                ny1 = hn::Mul(of.ab.z, of.bc.x), ny2 = hn::Mul(of.ab.x, of.bc.z),
                nz1 = hn::Mul(of.ab.x, of.bc.y), nz2 = hn::Mul(of.ab.y, of.bc.x);
        const V nx = hn::Sub(nx1, nx2), ny = hn::Sub(ny1, ny2), nz = hn::Sub(nz1, nz2);
        const V sum_x = hn::Add(hn::Abs(nx1), hn::Abs(nx2)), sum_y = hn::Add(hn::Abs(ny1), hn::Abs(ny2)),
                sum_z = hn::Add(hn::Abs(nz1), hn::Abs(nz2));
        hn::Store(nx, d, normals[0]);
        hn::Store(ny, d, normals[1]);
        hn::Store(nz, d, normals[2]);
        hn::Store(hn::MulAdd(of.a.x, nx, hn::MulAdd(of.a.y, ny, hn::Mul(of.a.z, nz))), d, numerators);
        const V underflow = hn::Set(d, Bounds::kUnderflow);
        const V sum = hn::MulAdd(hn::Abs(of.a.x), sum_x,
                                 hn::MulAdd(hn::Abs(of.a.y), sum_y, hn::Mul(hn::Abs(of.a.z), sum_z)));
        hn::Store(hn::MulAdd(hn::Set(d, Bounds::kNumerator), sum, underflow), d, numerator_errors);
        const V sheared = hn::MulAdd(hn::Set(d, rays.shear_sizes[0]), sum_x,
                                     hn::MulAdd(hn::Set(d, rays.shear_sizes[1]), sum_y, sum_z));
        hn::Store(hn::MulAdd(hn::Set(d, Bounds::kDenominator), sheared, underflow), d, denominator_errors);
    }
};

/// t of a triangle's plane, for the rays of vector i; the interval holds where `is_sure` does.
struct PlaneInterval {
    PacketVector lower, upper;
    hn::Mask<PacketTag> is_sure;

    template <uint32_t Size, class Bounds>
    HWY_INLINE PlaneInterval(const BasicPacketRays<Bounds>& rays, const PackPlanes<Size>& planes,
                             uint32_t lane, uint32_t i) {
        const PacketTag d;
        const PacketVector denominator = rays.sheared_dot(planes.normals, lane, i);
        const PacketVector denominator_error = hn::Set(d, planes.denominator_errors[lane]);
        is_sure = hn::Gt(hn::Abs(denominator), hn::Mul(hn::Set(d, 16.0f), denominator_error));
        const PacketVector inverse = hn::Div(hn::Set(d, 1.0f), denominator);
        const PacketVector z = hn::Mul(hn::Set(d, planes.numerators[lane]), inverse);
        const PacketVector size = hn::Mul(hn::Set(d, 16.0f / 15.0f * Bounds::kSecondOrder), hn::Abs(inverse));
        const PacketVector z_error = hn::Mul(
            size, hn::MulAdd(hn::Abs(z), denominator_error, hn::Set(d, planes.numerator_errors[lane])));
        const PacketVector inverse_z = rays.inverse[rays.z][i];
        const PacketVector t = hn::Mul(z, inverse_z);
        const PacketVector error = hn::MulAdd(z_error, hn::Abs(inverse_z), hn::Set(d, Bounds::kUnderflow));
        lower = hn::Sub(t, error);
        upper = hn::Add(t, error);
    }
};

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#endif
