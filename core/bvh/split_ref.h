#pragma once

#include "core/bvh/box4.h"

namespace boxwood {

/// A reference under construction in the layout of two SIMD registers.
struct SplitRef {
    Vec3 lower;
    uint32_t prim;
    Vec3 upper;
    uint32_t unused = 0;

    Box bounds() const { return {lower, upper}; }
};
static_assert(sizeof(SplitRef) == 32);

inline Float4 load_lower(const SplitRef& ref) {
    Float4 result;
    std::memcpy(&result, reinterpret_cast<const char*>(&ref), sizeof result);
    return result;
}
inline Float4 load_upper(const SplitRef& ref) {
    Float4 result;
    std::memcpy(&result, reinterpret_cast<const char*>(&ref) + sizeof(Float4), sizeof result);
    return result;
}

/// The fourth lane as 0: a primitive's index read as a float is a denormal, which is slow to multiply.
inline Float4 xyz(Float4 value) {
    const Int4 kept = reinterpret_cast<Int4>(value) & Int4{-1, -1, -1, 0};
    return reinterpret_cast<Float4>(kept);
}

/// Another value in one lane. By a mask: a lane that is written in memory would hold up the next load of all.
inline Float4 with_lane(Float4 value, int lane, float x) {
    constexpr Int4 kLanes = {0, 1, 2, 3};
    return kLanes == Int4{lane, lane, lane, lane} ? splat(x) : value;
}

inline Float4 make4(const Vec3& v) { return Float4{v.x, v.y, v.z, 0.0f}; }
inline Box4 box4(const Box& box) { return {make4(box.lower), make4(box.upper)}; }

/// Half the surface area of a box that is not empty, in double, which no box of floats overflows.
inline double half_area(const Box4& box) {
    const double x = static_cast<double>(box.upper[0]) - static_cast<double>(box.lower[0]);
    const double y = static_cast<double>(box.upper[1]) - static_cast<double>(box.lower[1]);
    const double z = static_cast<double>(box.upper[2]) - static_cast<double>(box.lower[2]);
    return x * y + y * z + z * x;
}

/// Of what two boxes have in common; 0 if nothing.
inline double common_half_area(const Box4& a, const Box4& b) {
    const Box4 common = {max4(a.lower, b.lower), min4(a.upper, b.upper)};
    for (int axis = 0; axis < 3; ++axis)
        if (!(common.lower[axis] <= common.upper[axis])) return 0.0;
    return half_area(common);
}

/// Box of a set of references and box of half their centres.
struct SetBounds {
    Box4 box = empty_box4();
    Box4 half_centers = empty_box4();

    void extend(const SplitRef& ref) {
        const Float4 lower = xyz(load_lower(ref)), upper = load_upper(ref);
        box.extend(lower, upper);
        const Float4 center = half_center4(lower, upper);
        half_centers.extend(center, center);
    }
    void extend(const SetBounds& other) {
        box.extend(other.box.lower, other.box.upper);
        half_centers.extend(other.half_centers.lower, other.half_centers.upper);
    }
};

}  // namespace boxwood
