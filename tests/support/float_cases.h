#pragma once

#include <cmath>
#include <limits>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/base/rng.h"
#include "core/scene/mesh.h"

// Rays on which float arithmetic rounds as much as it can: mantissas just above a power of two, where half an
// ulp is the largest fraction, and terms of different size, so that every operation rounds.

namespace boxwood {

struct FloatCase {
    Ray ray;
    Triangle triangle{};
    Box box{};  ///< of all primitives; of the triangle where there is one
};

/// Just above 1.
inline float one(Rng& rng) { return 1.0f + 0.03f * rng.next(); }
inline float sign(Rng& rng) { return rng.next() < 0.5f ? -1.0f : 1.0f; }
/// Between 2^-15 and 2^-6, either sign: a sum with 1 rounds, and differences of it matter to float.
inline float tiny(Rng& rng) {
    const float value = one(rng) * sign(rng);
    return std::ldexp(value, -7 - static_cast<int>(rng.next_index(9)));
}
inline Vec3 point(Rng& rng, float extent) {
    const float x = rng.next(-extent, extent), y = rng.next(-extent, extent), z = rng.next(-extent, extent);
    return {x, y, z};
}

/// A ray through the middle of edge bc to within 2^-32. Sheared, b and c are at (1, 1) and (-1, -1), their
/// distance along the ray is 1 too; or, `far`, (2, 2) and (-2, -2), where x, y, z themselves are 1.
inline FloatCase aimed_at_edge(Rng& rng, bool far) {
    const float x_sign = sign(rng), y_sign = sign(rng), size = far ? 1.0f : 2.0f, turn = far ? -1.0f : 1.0f;
    const float bx = size * one(rng) * x_sign, by = size * one(rng) * y_sign, bz = one(rng);
    const float dz = one(rng), dx = dz * (1.0f - 0.02f * rng.next()) * x_sign * turn;
    const float dy = dz * (1.0f - 0.02f * rng.next()) * y_sign * turn;
    const float oy = tiny(rng), oz = tiny(rng);
    FloatCase result;
    result.ray.direction = {dx, dy, dz};
    result.triangle.b = {bx, by, bz};
    result.triangle.c = -result.triangle.b;
    result.triangle.a = {-0.5f * y_sign, 0.5f * x_sign, 0.0f};
    // The sheared b and c are opposite but for the sheared origin, which must be parallel to them.
    const double sx = double(dx) / double(dz), sy = double(dy) / double(dz);
    const double ratio = (double(bx) - sx * double(bz)) / (double(by) - sy * double(bz));
    const double ox = (double(oy) - sy * double(oz)) * ratio + sx * double(oz);
    result.ray.origin = {static_cast<float>(ox), oy, oz};
    result.ray.direction *= sign(rng);
    return result;
}

/// N = A.n is nearly A_x e1_y e2_z, D = d.n nearly d_y e1_z e2_x, and the signs are such that the roundings
/// of A_x and e2_x, and of e1_z and e2_z, which come from the same coordinate of a, add up in N / D.
inline FloatCase with_large_roundings_of_t(Rng& rng) {
    const float ax = tiny(rng), ay = tiny(rng), az = tiny(rng);
    const float by = one(rng) + 0.03f, bz = -one(rng), cx = one(rng), cz = one(rng);
    const float bx = tiny(rng), cy = tiny(rng), dx = tiny(rng), dy = one(rng), dz = tiny(rng);
    const float ox = -one(rng) - 0.03f, oy = tiny(rng), oz = tiny(rng);
    FloatCase result;
    result.triangle = {{ax, ay, az}, {bx, by, bz}, {cx, cy, cz}};
    result.ray.origin = {ox, oy, oz};
    result.ray.direction = {dx, dy, dz};
    return result;
}

/// A ray along x, from ox, and a plane across it.
inline FloatCase across_x(float ox, float px, float dx) {
    FloatCase result;
    result.ray.origin.x = ox;
    result.ray.direction = {dx, 0.0f, 0.0f};
    result.box = {{px, -0.001f, -0.001f}, {px, 0.001f, 0.001f}};
    return result;
}

/// A plane whose parameter is p/d, but for rounding.
inline FloatCase from_zero(Rng& rng) {
    const float px = rng.next(1.0f, 2.0f), dx = rng.next(1.0f, 2.0f);
    return across_x(0.0f, px, dx);
}

/// A plane so near that of its parameter little is left but the roundings of the terms. These are just above
/// 1/2.
inline FloatCase beside_plane(Rng& rng) {
    const float px = one(rng), dx = 2.0f - 0.03f * rng.next();
    return across_x(px - 0x1p-12f * one(rng), px, dx);
}

/// A plane, 0 between it and the origin. 1/d is just above 1/2.
inline FloatCase before_plane(Rng& rng) {
    const float ox = -one(rng), px = one(rng), dx = 2.0f - 0.03f * rng.next();
    return across_x(ox, px, dx);
}

/// A ray in the upper face of a flat box at 0, to its far end; its component across is too small to count.
inline FloatCase in_flat_box(Rng& rng) {
    FloatCase result;
    const float dx = rng.next() < 0.5f ? 0.0f : std::ldexp(one(rng), -130), dz = one(rng);
    result.ray.direction = {dx, 0.0f, dz};
    result.ray.origin.x = -dx;
    const float end = one(rng);
    result.box = {{-0.0f, -0.25f, end}, {0.0f, 0.25f, end}};
    return result;
}

/// A ray that touches a box in a corner only, or in an edge, at t = k exactly.
inline FloatCase at_corner(Rng& rng) {
    FloatCase result;
    const float k = 1.0f + static_cast<float>(rng.next_index(30));
    const int exponent = static_cast<int>(rng.next_index(60)) - 30;
    Vec3 corner, d;
    for (int axis = 0; axis < 3; ++axis) {
        corner[axis] = static_cast<float>(rng.next_index(8192)) - 4096.0f;
        d[axis] = (1.0f + static_cast<float>(rng.next_index(4096))) * sign(rng);
        if (rng.next_index(6) == 0) d[axis] = 0.0f * sign(rng);
    }
    if (d == Vec3(0.0f)) d.x = 1.0f;
    const int first_axis = static_cast<int>(rng.next_index(3));
    for (int axis = 0; axis < 3; ++axis) {
        const float size = std::ldexp(one(rng), static_cast<int>(rng.next_index(20)) - 4);
        const bool is_above = rng.next() < 0.5f, enters = axis == first_axis;
        const bool is_upper = d[axis] == 0.0f ? is_above : (d[axis] > 0.0f) == enters;
        result.box.lower[axis] = std::ldexp(is_upper ? corner[axis] : corner[axis] - size, exponent);
        result.box.upper[axis] = std::ldexp(is_upper ? corner[axis] + size : corner[axis], exponent);
        result.ray.origin[axis] = std::ldexp(corner[axis] - k * d[axis], exponent);
        result.ray.direction[axis] = std::ldexp(d[axis], exponent / 2);
    }
    return result;
}

/// A ray that passes an edge of a triangle at some units of float, on the outside: far nearer than the edge's
/// ends, of which one is behind the origin. The edge lies in a face of the triangle's box.
inline FloatCase past_edge(Rng& rng) {
    const float ox = 0x1p-10f * one(rng) * sign(rng), oz = 0x1p-10f * one(rng) * sign(rng);
    const float dz = 2.0f - 0.03f * rng.next(), dx = dz * (1.0f - 0.01f * rng.next());
    const float bz = one(rng), cz = -one(rng), y = one(rng);
    const double offset = double(rng.next(0.0f, 6.0f)) * 0x1p-24;
    const double x =
        double(ox) + double(dx) / double(dz) * (0.5 * (double(bz) + double(cz)) - double(oz)) + offset;
    FloatCase result;
    result.ray.origin = {ox, 0.0f, oz};
    result.ray.direction = {dx, 0.0f, dz};
    const float px = static_cast<float>(x);
    result.triangle = {{px, y, bz}, {px, -y, cz}, {px + 1.0f, 0.0f, 0.0f}};
    return result;
}

/// Thin, short and far triangles, with corners that differ by roundings.
inline FloatCase past_sliver(Rng& rng) {
    FloatCase result;
    result.ray.origin = point(rng, 2.0f);
    result.triangle.a = point(rng, 1.0f);
    const float size = std::ldexp(1.0f, -static_cast<int>(rng.next_index(25)));
    result.triangle.b = result.triangle.a + point(rng, size);
    const float rest = std::ldexp(size, -static_cast<int>(rng.next_index(25)));
    result.triangle.c = result.triangle.b + point(rng, rest);
    result.ray.direction = result.triangle.a + point(rng, size) - result.ray.origin;
    return result;
}

/// A ray along z through the middle of edge bc to within a rounding of c.
inline FloatCase along_z_at_edge(Rng& rng) {
    FloatCase result;
    const float bx = one(rng), by = one(rng), cx = -one(rng);
    result.triangle.b = {bx, by, 1.0f};
    result.triangle.c = {cx, cx * by / bx, 1.0f};
    result.triangle.a = {-0.5f * sign(rng), 0.0f, 1.0f};
    result.triangle.a.y = -result.triangle.a.x;
    return result;
}

/// A ray along z through the middle of a long thin triangle that is steep to it.
inline FloatCase along_z_through_sliver(Rng& rng) {
    FloatCase result;
    const auto corner = [&](float side, float z) {
        const float x = side * one(rng), y = x + 0x1p-11f * rng.next(-1.0f, 1.0f);
        return Vec3(x, y, z);
    };
    result.triangle.a = corner(1.0f, 1.0f);
    result.triangle.b = corner(-1.0f, 2.0f);
    result.triangle.c = corner(-1.0f, 2.0f);
    return result;
}

/// A ray along z past corner c of a triangle across it, on the inside. Half the bound of t is just below four
/// units of t.
inline FloatCase along_z_inside_corner(Rng& rng) {
    FloatCase result;
    const float z = one(rng), dz = 1.56f + 0.04f * rng.next();
    const float ax = one(rng), ay = tiny(rng), bx = tiny(rng), by = one(rng);
    const float cx = -0x1p-6f * one(rng), cy = -0x1p-6f * one(rng);
    result.triangle = {{ax, ay, z}, {bx, by, z}, {cx, cy, z}};
    result.ray.direction.z = dz;
    return result;
}

/// Triangles and rays of all sizes and offsets, aimed at corners, edges and the inside, along axes and almost
/// so, with ranges that begin or end close to the hit.
inline FloatCase anywhere(Rng& rng) {
    FloatCase result;
    const int size = static_cast<int>(rng.next_index(64)) - 30,
              speed = static_cast<int>(rng.next_index(70)) - 35;
    const Vec3 offset = rng.next_index(3) == 0 ? point(rng, 100.0f) : Vec3(0.0f);
    const Vec3 a = offset + point(rng, 1.0f), b = offset + point(rng, 1.0f), c = offset + point(rng, 1.0f);
    float u = rng.next(), v = rng.next() * (1.0f - u);
    if (rng.next_index(3) == 0) v = 0.0f;
    if (rng.next_index(6) == 0) u = 0.0f;
    const Vec3 target = a + u * (b - a) + v * (c - a);
    Vec3 d = point(rng, 1.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const uint64_t kind = rng.next_index(10);
        if (kind < 2) d[axis] *= 0.0f;
        if (kind == 2) d[axis] = std::ldexp(d[axis], -20 - static_cast<int>(rng.next_index(110)));
    }
    if (d == Vec3(0.0f)) d.y = -1.0f;
    const float t =
        rng.next_index(8) == 0 ? 0.0f : std::ldexp(rng.next(), 2 - static_cast<int>(rng.next_index(8)));
    const auto scaled = [size](const Vec3& p) {
        return Vec3(std::ldexp(p.x, size), std::ldexp(p.y, size), std::ldexp(p.z, size));
    };
    result.triangle = {scaled(a), scaled(b), scaled(c)};
    result.ray.origin = scaled(target - t * d);
    for (int axis = 0; axis < 3; ++axis) result.ray.direction[axis] = std::ldexp(d[axis], speed);
    const float near_hit = std::ldexp(t, size - speed);
    const uint64_t range = rng.next_index(6);
    if (range == 0) result.ray.t_max = near_hit;
    if (range == 1) result.ray.t_min = near_hit;
    return result;
}

}  // namespace boxwood
