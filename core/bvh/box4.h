#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

#include "core/bvh/bvh2.h"
#include "core/refs/prim_ref.h"

namespace boxwood {

/// Four floats that the compiler keeps in one SIMD register on every machine that has them (the vector
/// extension of g++ and clang; Highway's static dispatch is scalar on plain x86-64). Only operations that
/// round as their scalar forms are used, so every machine gives the same bits.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

inline Float4 splat(float value) { return Float4{value, value, value, value}; }
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

/// A box in two registers, for builders: x, y, z; the fourth lane means nothing. Not initialised: see
/// empty_box4.
struct Box4 {
    Float4 lower, upper;

    void extend(Float4 point_lower, Float4 point_upper) {
        lower = min4(lower, point_lower);
        upper = max4(upper, point_upper);
    }
    Box box() const { return {Vec3(lower[0], lower[1], lower[2]), Vec3(upper[0], upper[1], upper[2])}; }
};

inline Box4 empty_box4() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return {splat(kInfinity), splat(-kInfinity)};
}

/// A corner and the four bytes after it: both corners of a PrimRef are followed by bytes of its own.
static_assert(sizeof(PrimRef) == 28);
inline Float4 load_lower(const PrimRef& ref) {
    Float4 result;
    std::memcpy(&result, reinterpret_cast<const char*>(&ref), sizeof result);
    return result;
}
inline Float4 load_upper(const PrimRef& ref) {
    Float4 result;
    std::memcpy(&result, reinterpret_cast<const char*>(&ref) + sizeof(Vec3), sizeof result);
    return result;
}

/// Writes a whole node.
inline void store_node(Bvh2::Node& node, const Box4& box, uint32_t first, uint32_t count) {
    node = {Vec3(box.lower[0], box.lower[1], box.lower[2]), first,
            Vec3(box.upper[0], box.upper[1], box.upper[2]), count};
}

/// See half_center.
inline Float4 half_center4(Float4 lower, Float4 upper) { return splat(0.25f) * lower + splat(0.25f) * upper; }

}  // namespace boxwood
