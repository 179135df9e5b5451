// Packets of rays that share their origin, prepared for float SIMD tests, and their tests of boxes, once for
// each instruction set; bounds in packet_bounds.h.
#if defined(BOXWOOD_PACKET_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_PACKET_RAYS_INL_H
#undef BOXWOOD_PACKET_RAYS_INL_H
#else
#define BOXWOOD_PACKET_RAYS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <span>

#include "core/base/ray.h"
#include "core/wide_bvh/octant-inl.h"
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

HWY_INLINE uint32_t packet_bits(hn::Mask<PacketTag> mask) { return mask_bits(PacketTag(), mask); }
HWY_INLINE hn::Mask<PacketTag> packet_mask(uint32_t bits) { return mask_of(PacketTag(), bits); }

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

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#endif
