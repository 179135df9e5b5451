// Float SIMD tests of boxes and triangles for packets of rays that share their origin, once for each
// instruction set; bounds in packet_bounds.h.
#if defined(BOXWOOD_PACKET_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_PACKET_TESTS_INL_H
#undef BOXWOOD_PACKET_TESTS_INL_H
#else
#define BOXWOOD_PACKET_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstring>
#include <span>

#include "core/base/ray.h"
#include "core/structure/filter.h"
#include "core/wide_bvh/packet_bounds.h"
#include "core/wide_bvh/wide_bvh.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;

/// Rays of a packet, a block of 4 x 4 pixels, in kVectors vectors.
constexpr uint32_t kPacketSize = 16;
using PacketTag = hn::CappedTag<float, kPacketSize>;
using PacketVector = hn::Vec<PacketTag>;
constexpr uint32_t kLanes = hn::MaxLanes(PacketTag()), kVectors = kPacketSize / kLanes;

/// Bit i: lane i, of up to 16.
template <class D>
HWY_INLINE uint32_t mask_bits(D d, hn::Mask<D> mask) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    uint16_t bits;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}
HWY_INLINE uint32_t packet_bits(hn::Mask<PacketTag> mask) { return mask_bits(PacketTag(), mask); }
HWY_INLINE hn::Mask<PacketTag> packet_mask(uint32_t bits) {
    const uint8_t bytes[8] = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
    return hn::LoadMaskBits(PacketTag(), bytes);
}

/// One number for each ray of a packet.
struct PacketFloats {
    PacketVector vectors[kVectors];

    HWY_INLINE PacketVector& operator[](uint32_t i) { return vectors[i]; }
    HWY_INLINE const PacketVector& operator[](uint32_t i) const { return vectors[i]; }
    HWY_INLINE float least() const {
        PacketVector all = vectors[0];
        for (uint32_t i = 1; i < kVectors; ++i) all = hn::Min(all, vectors[i]);
        return hn::GetLane(hn::MinOfLanes(PacketTag(), all));
    }
    HWY_INLINE float largest() const {
        PacketVector all = vectors[0];
        for (uint32_t i = 1; i < kVectors; ++i) all = hn::Max(all, vectors[i]);
        return hn::GetLane(hn::MaxOfLanes(PacketTag(), all));
    }
};

/// Places of the near and far planes of rays of an octant in a node, by axis, in floats.
template <uint32_t Width>
struct Planes {
    uint32_t near[3], far[3];

    HWY_INLINE explicit Planes(uint32_t octant) {
        set_axis(octant, 0);
        set_axis(octant, 1);
        set_axis(octant, 2);
    }
    HWY_INLINE void set_axis(uint32_t octant, uint32_t axis) {
        const bool is_negative = (octant >> axis & 1) != 0;
        near[axis] = (is_negative ? 3 + axis : axis) * Width;
        far[axis] = (is_negative ? axis : 3 + axis) * Width;
    }
};

/// Sixteen rays as vectors.
struct RayLanes {
    PacketFloats origins[3], directions[3], t_min, t_max;

    HWY_INLINE explicit RayLanes(const Ray* rays) {
        const PacketTag d;
        static_assert(sizeof(Ray) == 8 * sizeof(float));
        for (uint32_t i = 0; i < kVectors; ++i) {
            // Origin and t_min, direction and t_max in turn: of one half of the rays, then of the other.
            const float* const from = &rays[kLanes * i].origin.x;
            PacketVector first[4], second[4];
            hn::LoadInterleaved4(d, from, first[0], first[1], first[2], first[3]);
            hn::LoadInterleaved4(d, from + size_t{4} * kLanes, second[0], second[1], second[2], second[3]);
            set_axis(0, i, first[0], second[0]);
            set_axis(1, i, first[1], second[1]);
            set_axis(2, i, first[2], second[2]);
            t_min[i] = hn::ConcatEven(d, second[3], first[3]);
            t_max[i] = hn::ConcatOdd(d, second[3], first[3]);
        }
    }
    HWY_INLINE void set_axis(uint32_t axis, uint32_t i, PacketVector first, PacketVector second) {
        const PacketTag d;
        origins[axis][i] = hn::ConcatEven(d, second, first);
        directions[axis][i] = hn::ConcatOdd(d, second, first);
    }
};

/// Rays of one origin and octant prepared for tests in float: each as FloatRay<Mode::Exact> is.
template <class Bounds>
struct BasicPacketRays {
    PacketFloats inverse[3], near_offset[3], far_offset[3], t_min, t_max;
    PacketFloats shear_x, shear_y;
    HWY_ALIGN float directions[3][kPacketSize];
    float origin[3];
    float reaches[3];  ///< distance of the scene's farther plane, by axis
    float pads[3];     ///< of the slabs at most, to be multiplied with |inverse|
    uint32_t octant;   ///< bit axis set: the directions' sign bits are
    uint32_t x, y, z;  ///< axes; z is the one with the largest |d|
    /// Rays that share origin, octant and z with the first of those asked for, are valid, and for which the
    /// bounds hold; the others repeat that one. 0: that one itself is not among them, and nothing is set.
    uint32_t members;

    BasicPacketRays() = default;  ///< sets nothing
    /// Of those rays whose bits are set in `wanted`, one at least.
    HWY_INLINE BasicPacketRays(const Ray* rays, const RayLanes& lanes, const FloatScene& scene,
                               uint32_t wanted) {
        const Ray& first = rays[std::countr_zero(wanted)];
        z = static_cast<uint32_t>(largest_component(first.direction));
        x = z == 2 ? 0 : z + 1;
        y = x == 2 ? 0 : x + 1;
        octant = 0;
        set_origin(first, scene, 0);
        set_origin(first, scene, 1);
        set_origin(first, scene, 2);
        const float reach =
            std::max(std::max(reaches[0], reaches[1]), reaches[2]) * (1.0f + 4.0f * Bounds::kUnit);
        members = is_near_enough(scene, reach) ? wanted & fitting(first, lanes) : 0;
        if (HWY_UNLIKELY((members & (wanted & (0u - wanted))) == 0)) {
            members = 0;
            return;
        }
        copy_members(first, lanes);
        set_slabs(scene, 0, reach);
        set_slabs(scene, 1, reach);
        set_slabs(scene, 2, reach);
        set_shears();
    }
    HWY_INLINE void set_origin(const Ray& first, const FloatScene& scene, uint32_t axis) {
        origin[axis] = first.origin[static_cast<int>(axis)];
        if (std::signbit(first.direction[static_cast<int>(axis)])) octant |= 1u << axis;
        reaches[axis] =
            std::max(std::abs(scene.lower[axis] - origin[axis]), std::abs(scene.upper[axis] - origin[axis]));
    }
    /// Comparisons with NaN are false.
    HWY_INLINE bool is_near_enough(const FloatScene& scene, float reach) const {
        return reach >= Bounds::kSmallestReach && reach <= Bounds::kLargest &&
               std::abs(origin[0]) + scene.largest[0] <= Bounds::kLargest &&
               std::abs(origin[1]) + scene.largest[1] <= Bounds::kLargest &&
               std::abs(origin[2]) + scene.largest[2] <= Bounds::kLargest;
    }
    HWY_INLINE uint32_t fitting(const Ray& first, const RayLanes& lanes) const {
        const PacketTag d;
        const hn::RebindToSigned<PacketTag> di;
        uint32_t bits = 0;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const PacketVector largest = hn::Abs(lanes.directions[z][i]);
            const auto is_valid =
                hn::And(hn::And(hn::Ge(lanes.t_min[i], hn::Zero(d)), hn::Le(lanes.t_min[i], lanes.t_max[i])),
                        hn::Lt(lanes.t_min[i], hn::Set(d, std::numeric_limits<float>::infinity())));
            const auto is_ordinary = hn::And(hn::Ge(largest, hn::Set(d, Bounds::kSmallestDirection)),
                                             hn::Le(largest, hn::Set(d, Bounds::kLargest)));
            const auto is_along =
                hn::And(is_like(first, lanes, 0, i, largest),
                        hn::And(is_like(first, lanes, 1, i, largest), is_like(first, lanes, 2, i, largest)));
            const auto signs = hn::Or(other_sign(first, lanes, 0, i),
                                      hn::Or(other_sign(first, lanes, 1, i), other_sign(first, lanes, 2, i)));
            const auto is_in_octant = hn::RebindMask(d, hn::Gt(signs, hn::Set(di, -1)));
            bits |= packet_bits(hn::And(hn::And(is_valid, is_ordinary), hn::And(is_along, is_in_octant)))
                    << (kLanes * i);
        }
        return bits;
    }
    /// The same coordinate of the origin, and no component beyond the largest.
    HWY_INLINE hn::Mask<PacketTag> is_like(const Ray& first, const RayLanes& lanes, uint32_t axis, uint32_t i,
                                           PacketVector largest) const {
        return hn::And(
            hn::Eq(lanes.origins[axis][i], hn::Set(PacketTag(), first.origin[static_cast<int>(axis)])),
            hn::Le(hn::Abs(lanes.directions[axis][i]), largest));
    }
    /// Negative where a component's sign bit differs from the first ray's.
    HWY_INLINE hn::Vec<hn::RebindToSigned<PacketTag>> other_sign(const Ray& first, const RayLanes& lanes,
                                                                 uint32_t axis, uint32_t i) const {
        const hn::RebindToSigned<PacketTag> di;
        return hn::BitCast(di, hn::Xor(lanes.directions[axis][i],
                                       hn::Set(PacketTag(), first.direction[static_cast<int>(axis)])));
    }
    HWY_INLINE void copy_members(const Ray& first, const RayLanes& lanes) {
        const PacketTag d;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const auto is_member = packet_mask(members >> (kLanes * i));
            t_min[i] = hn::IfThenElse(is_member, lanes.t_min[i], hn::Set(d, first.t_min));
            t_max[i] = hn::IfThenElse(is_member, lanes.t_max[i], hn::Set(d, first.t_max));
            copy_directions(first, lanes, 0, i, is_member);
            copy_directions(first, lanes, 1, i, is_member);
            copy_directions(first, lanes, 2, i, is_member);
        }
    }
    HWY_INLINE void copy_directions(const Ray& first, const RayLanes& lanes, uint32_t axis, uint32_t i,
                                    hn::Mask<PacketTag> is_member) {
        const PacketTag d;
        const PacketVector one = hn::Set(d, first.direction[static_cast<int>(axis)]);
        hn::Store(hn::IfThenElse(is_member, lanes.directions[axis][i], one), d,
                  directions[axis] + kLanes * i);
    }
    HWY_INLINE PacketVector direction(uint32_t axis, uint32_t i) const {
        return hn::Load(PacketTag(), directions[axis] + kLanes * i);
    }
    HWY_INLINE void set_slabs(const FloatScene& scene, uint32_t axis, float reach) {
        const PacketTag d;
        const float rounded =
            Bounds::kSlab * (2.0f * (reaches[axis] + std::abs(origin[axis])) + scene.largest[axis]);
        const float moved_by = reach * Bounds::kMoved;
        pads[axis] = rounded + moved_by + Bounds::kUnderflow;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const PacketVector along = direction(axis, i), size = hn::Abs(along);
            const PacketVector least = hn::Mul(hn::Abs(direction(z, i)), hn::Set(d, Bounds::kUnit));
            const auto is_moved = hn::Lt(size, least);
            const PacketVector r =
                hn::Div(hn::Set(d, 1.0f), hn::IfThenElse(is_moved, hn::CopySign(least, along), along));
            const PacketVector moved =
                hn::IfThenElse(is_moved, hn::Set(d, moved_by), hn::Set(d, Bounds::kUnderflow));
            const PacketVector pad = hn::Mul(hn::Abs(r), hn::Add(hn::Set(d, rounded), moved));
            const PacketVector c = hn::Neg(hn::Mul(hn::Set(d, origin[axis]), r));
            inverse[axis][i] = r;
            near_offset[axis][i] = hn::Sub(c, pad);
            far_offset[axis][i] = hn::Add(c, pad);
        }
    }
    HWY_INLINE void set_shears() {
        for (uint32_t i = 0; i < kVectors; ++i) {
            shear_x[i] = hn::Div(direction(x, i), direction(z, i));
            shear_y[i] = hn::Div(direction(y, i), direction(z, i));
        }
    }
    /// Whether the rays of both can be searched for as one.
    HWY_INLINE bool fits(const BasicPacketRays& other) const {
        return origin[0] == other.origin[0] && origin[1] == other.origin[1] && origin[2] == other.origin[2] &&
               octant == other.octant && z == other.z;
    }

    /// Whether any ray meets the box of a child at its limit or before.
    template <uint32_t Width>
    HWY_INLINE bool any_meets(const float* planes, const Planes<Width>& at, uint32_t lane,
                              const PacketFloats& limits) const {
        const PacketTag d;
        auto met = hn::FirstN(d, 0);
        for (uint32_t i = 0; i < kVectors; ++i) {
            const PacketVector entry =
                hn::Max(hn::Max(near(0, i, planes[at.near[0] + lane]), near(1, i, planes[at.near[1] + lane])),
                        hn::Max(near(2, i, planes[at.near[2] + lane]), t_min[i]));
            const PacketVector exit =
                hn::Min(hn::Min(far(0, i, planes[at.far[0] + lane]), far(1, i, planes[at.far[1] + lane])),
                        hn::Min(far(2, i, planes[at.far[2] + lane]), limits[i]));
            met = hn::Or(met, hn::Le(entry, exit));
        }
        return !hn::AllFalse(d, met);
    }
    HWY_INLINE PacketVector near(uint32_t axis, uint32_t i, float plane) const {
        return hn::MulAdd(hn::Set(PacketTag(), plane), inverse[axis][i], near_offset[axis][i]);
    }
    HWY_INLINE PacketVector far(uint32_t axis, uint32_t i, float plane) const {
        return hn::MulAdd(hn::Set(PacketTag(), plane), inverse[axis][i], far_offset[axis][i]);
    }

    /// (d / d_z).n of the rays of vector i, for n of one lane, by axis x, y, z.
    template <size_t Size>
    HWY_INLINE PacketVector sheared_dot(const float (&n)[3][Size], uint32_t lane, uint32_t i) const {
        const PacketTag d;
        return hn::MulAdd(shear_x[i], hn::Set(d, n[0][lane]),
                          hn::MulAdd(shear_y[i], hn::Set(d, n[1][lane]), hn::Set(d, n[2][lane])));
    }
};

using PacketRays = BasicPacketRays<PacketBounds>;

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

/// All rays of packets that fit each other as one, as vectors over the lanes of a node: no box that a ray
/// meets is missed, nor entered later than by that ray. See PacketBounds.
template <uint32_t Width, class Bounds = PacketBounds>
struct Frustum {
    using Packets = std::span<const BasicPacketRays<Bounds>>;
    using D = hn::CappedTag<float, Width>;
    using V = hn::Vec<D>;
    V near_inverse[3], far_inverse[3], near_offset[3], far_offset[3];
    Planes<Width> at;
    float origin[3];
    uint32_t x, y, z;      ///< axes, as in the packets
    float shear_sizes[2];  ///< largest |shear_x| and |shear_y|

    HWY_INLINE explicit Frustum(Packets packets)
        : at(packets[0].octant), x(packets[0].x), y(packets[0].y), z(packets[0].z) {
        set_axis(packets, 0);
        set_axis(packets, 1);
        set_axis(packets, 2);
        PacketVector x_size = hn::Zero(PacketTag()), y_size = x_size;
        for (const auto& packet : packets) {
            for (uint32_t i = 0; i < kVectors; ++i) {
                x_size = hn::Max(x_size, hn::Abs(packet.shear_x[i]));
                y_size = hn::Max(y_size, hn::Abs(packet.shear_y[i]));
            }
        }
        shear_sizes[0] = hn::GetLane(hn::MaxOfLanes(PacketTag(), x_size));
        shear_sizes[1] = hn::GetLane(hn::MaxOfLanes(PacketTag(), y_size));
    }
    HWY_INLINE void set_axis(Packets packets, uint32_t axis) {
        const D d;
        const auto& first = packets[0];
        origin[axis] = first.origin[axis];
        PacketVector all_least = first.inverse[axis][0], all_largest = all_least;
        for (const auto& packet : packets) {
            for (uint32_t i = 0; i < kVectors; ++i) {
                all_least = hn::Min(all_least, packet.inverse[axis][i]);
                all_largest = hn::Max(all_largest, packet.inverse[axis][i]);
            }
        }
        const float least = hn::GetLane(hn::MinOfLanes(PacketTag(), all_least));
        const float largest = hn::GetLane(hn::MaxOfLanes(PacketTag(), all_largest));
        const bool is_negative = (first.octant >> axis & 1) != 0;
        const float near = is_negative ? largest : least, far = is_negative ? least : largest;
        const float pad = std::abs(far) * first.pads[axis];
        near_inverse[axis] = hn::Set(d, near);
        far_inverse[axis] = hn::Set(d, far);
        near_offset[axis] = hn::Set(d, -(origin[axis] * near) - pad);
        far_offset[axis] = hn::Set(d, -(origin[axis] * far) + pad);
    }
    HWY_INLINE V entry(const float* planes) const {
        const D d;
        return hn::Max(hn::Max(hn::MulAdd(hn::Load(d, planes + at.near[0]), near_inverse[0], near_offset[0]),
                               hn::MulAdd(hn::Load(d, planes + at.near[1]), near_inverse[1], near_offset[1])),
                       hn::Max(hn::MulAdd(hn::Load(d, planes + at.near[2]), near_inverse[2], near_offset[2]),
                               hn::Zero(d)));
    }
    HWY_INLINE V exit(const float* planes, float limit) const {
        const D d;
        return hn::Min(hn::Min(hn::MulAdd(hn::Load(d, planes + at.far[0]), far_inverse[0], far_offset[0]),
                               hn::MulAdd(hn::Load(d, planes + at.far[1]), far_inverse[1], far_offset[1])),
                       hn::Min(hn::MulAdd(hn::Load(d, planes + at.far[2]), far_inverse[2], far_offset[2]),
                               hn::Set(d, limit)));
    }
};

/// Vectors of the triangles of a pack, or of a part of it where vectors are short, in the rays' axes.
template <uint32_t Size>
struct PackVectors {
    using D = hn::CappedTag<float, Size>;
    using V = hn::Vec<D>;
    V x, y, z;

    HWY_INLINE PackVectors(V in_x, V in_y, V in_z) : x(in_x), y(in_y), z(in_z) {}
    template <class Bounds>
    HWY_INLINE PackVectors(const float corners[3][Size], uint32_t first, const Frustum<Size, Bounds>& rays)
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

    template <class Bounds>
    HWY_INLINE PackEdges(const TrianglePack<Size>& pack, uint32_t first, const Frustum<Size, Bounds>& rays)
        : PackEdges({pack.corners[0], first, rays}, {pack.corners[1], first, rays},
                    {pack.corners[2], first, rays},
                    {hn::Set(D(), rays.origin[rays.x]), hn::Set(D(), rays.origin[rays.y]),
                     hn::Set(D(), rays.origin[rays.z])},
                    rays) {}

private:
    template <class Bounds>
    HWY_INLINE PackEdges(const Vectors& at_a, const Vectors& at_b, const Vectors& at_c, const Vectors& origin,
                         const Frustum<Size, Bounds>& rays)
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

    template <class Bounds>
    HWY_INLINE PackPlanes(const PackEdges<Size>& of, const Frustum<Size, Bounds>& rays) {
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
