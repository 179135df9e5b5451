#pragma once

#include "tests/support/float_cases.h"

// Rays and triangles on which the float arithmetic of packets rounds as much as it can; see float_cases.h.

namespace boxwood {

/// As tiny, relative to a size.
inline float tiny_of(Rng& rng, float size) { return size * tiny(rng); }

/// The ray's line passes edge ab close to b, and a + 2^-7 (1, -1) is b, seen along the ray: there the edge
/// function is the difference of two equal terms, each the product of a shear or an edge with a coordinate
/// that is as small as the edge, and the bound by the largest edge and the farthest corner is the least.
/// The origin makes the function zero to within a rounding of its x.
inline FloatCase along_z_past_small_edge(Rng& rng) {
    constexpr float kSize = 0x1p-7f;
    FloatCase result;
    const float dx = kSize * one(rng) * one(rng) * sign(rng), dz = one(rng);
    const float dy = 0.01f * tiny_of(rng, kSize);
    result.ray.direction = {dx, dy, dz};
    const float ax = 0.25f * tiny_of(rng, kSize), ay = kSize * one(rng) * sign(rng), az = one(rng);
    const float bz = az + tiny_of(rng, kSize), beyond = 1.0f + 0.0005f * (1.0f + rng.next());
    const float cz = az + tiny_of(rng, kSize), oy = 0.25f * tiny_of(rng, kSize), oz = 0.25f * tiny(rng);
    const float bx = dx / dz * bz;
    result.triangle = {{ax, ay, az}, {beyond * bx, -0.0008f * ay, bz}, {0.25f * bx, 0.25f * ay, cz}};
    const auto edge_function = [&](double ox) {
        const DVec3 o(ox, double(oy), double(oz)), a(result.triangle.a), b(result.triangle.b);
        return glm::dot(DVec3(result.ray.direction), glm::cross(a - o, b - o));
    };
    const double at_0 = edge_function(0.0), at_1 = edge_function(1.0);
    result.ray.origin = {static_cast<float>(at_0 / (at_0 - at_1)), oy, oz};
    return result;
}

/// Edges mostly along z, and a plane almost along the ray: D' is the small difference of s_x n_x and s_y n_y,
/// of four edges, and its error counts more than that of N.
inline FloatCase along_z_almost_in_plane(Rng& rng) {
    constexpr float kSize = 0x1p-6f;
    const auto rest = [&] { return 0.1f * tiny_of(rng, kSize); };
    FloatCase result;
    const float dx = 0.5f * one(rng), dy = 0.5f * one(rng), dz = one(rng);
    result.ray.direction = {dx, dy, dz};
    const float ab_x = rest(), ab_y = kSize * one(rng), ab_z = one(rng);
    const float bc_x = -kSize * one(rng), bc_y = rest(), bc_z = one(rng);
    const float bx = rest(), by = rest(), bz = 0.1f * tiny(rng), oy = rest(), oz = rest();
    const Vec3 b(bx, by, bz);
    result.triangle = {b - Vec3(ab_x, ab_y, ab_z), b, b + Vec3(bc_x, bc_y, bc_z)};
    result.ray.origin = {4.0f * one(rng), oy, oz};
    const auto denominator = [&](double cx) {
        const DVec3 at_a(result.triangle.a), at_b(b);
        const DVec3 at_c(cx, double(result.triangle.c.y), double(result.triangle.c.z));
        return glm::dot(DVec3(result.ray.direction), glm::cross(at_b - at_a, at_c - at_b));
    };
    const double at_0 = denominator(0.0), at_1 = denominator(1.0);
    result.triangle.c.x = static_cast<float>((0x1p-15 * double(dz) - at_0) / (at_1 - at_0));
    return result;
}

/// N is nearly A_y n_y, D' nearly s_x n_x, with n_x and n_y of different edges, and 1/D', 1/d_z just above a
/// power of two: of all roundings of t none is small, and none is the same in N and D'.
inline FloatCase with_apart_roundings_of_t(Rng& rng) {
    constexpr float kSize = 0x1p-6f;
    FloatCase result;
    const float ab_x = tiny_of(rng, kSize), ab_y = kSize * one(rng), ab_z = one(rng) * sign(rng);
    const float bc_x = kSize * one(rng) * sign(rng), bc_y = tiny_of(rng, kSize), bc_z = one(rng) * sign(rng);
    const float bx = tiny_of(rng, kSize), by = tiny_of(rng, kSize), bz = tiny(rng);
    const Vec3 b(bx, by, bz);
    result.triangle = {b - Vec3(ab_x, ab_y, ab_z), b, b + Vec3(bc_x, bc_y, bc_z)};
    const float dz = 1.99f - 0.03f * rng.next(), dx = 0.5f * one(rng) * dz, dy = 0.1f * tiny(rng);
    result.ray.direction = {dx, dy, dz};
    const float px = tiny_of(rng, kSize), py = one(rng) * sign(rng), pz = tiny_of(rng, kSize);
    result.ray.origin = result.triangle.a - Vec3(px, py, pz);
    return result;
}

/// A plane across x beyond an origin close to 0: what the origin's distance from 0 adds to the pad is small,
/// and 1/d is just above 1/2.
inline FloatCase before_near_plane(Rng& rng) {
    FloatCase result;
    const float ox = tiny(rng), px = one(rng), dx = 2.0f - 0.03f * rng.next();
    result.ray.origin.x = ox;
    result.ray.direction = {dx, 0.0f, 0.0f};
    result.box = {{px, -0.001f, -0.001f}, {px, 0.001f, 0.001f}};
    return result;
}

/// A ray that enters a box across x where it leaves it across y, to within 2^-30 of t; otherwise as before.
inline FloatCase through_box_edge(Rng& rng) {
    FloatCase result;
    const float dx = 1.95f + 0.02f * rng.next(), dy = dx + 0.02f * rng.next(), px = one(rng);
    const float py = px * dy / dx + tiny(rng), oy = tiny(rng);
    const double ox = double(px) - double(dx) * (double(py) - double(oy)) / double(dy);
    result.ray.origin = {std::nextafter(static_cast<float>(ox), 1.0f), oy, 0.0f};
    result.ray.direction = {dx, dy, 0.0f};
    result.box = {{px, 0.0f, -0.001f}, {px, py, 0.001f}};
    return result;
}

}  // namespace boxwood
