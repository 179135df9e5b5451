#include "bench/stress_cases.h"

#include <array>
#include <cmath>
#include <map>

#include "core/base/rng.h"
#include "core/base/sampling.h"
#include "core/structure/closest.h"
#include "core/structure/leaving_ray.h"

namespace boxwood::bench {

namespace {

Vec3 random_point(Rng& rng, float extent = 1.0f) {
    const float x = rng.next(-extent, extent), y = rng.next(-extent, extent), z = rng.next(-extent, extent);
    return {x, y, z};
}

float power_of_two(int exponent) { return std::ldexp(1.0f, exponent); }

void add_triangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3& corner : {a, b, c}) mesh.positions.push_back(corner);
    mesh.triangles.push_back(UVec3(first, first + 1, first + 2));
}

Triangle random_triangle_of(const Mesh& mesh, Rng& rng) {
    return mesh.triangle(static_cast<uint32_t>(rng.next_index(mesh.triangle_count())));
}

/// A vertex, a point of an edge, or one of the inside.
Vec3 aim_at(const Triangle& triangle, Rng& rng) {
    const uint64_t kind = rng.next_index(4);
    if (kind == 0) return triangle.a;
    if (kind == 1) return 0.5f * (triangle.a + triangle.b);
    const float u = rng.next(), v = rng.next();
    if (kind == 2) return glm::mix(triangle.b, triangle.c, u);
    return triangle.a + u * (1.0f - v) * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
}

Ray ray_to(const Vec3& origin, const Vec3& target) {
    Ray ray;
    ray.origin = origin;
    ray.direction = target - origin;
    if (ray.direction == Vec3(0.0f)) ray.direction.x = 1.0f;
    return ray;
}

/// Rays from points at `distance` to the mesh's triangles.
std::vector<Ray> aimed_rays(const Mesh& mesh, Rng& rng, size_t count, float distance,
                            const Vec3& center = Vec3(0.0f)) {
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; ++i) {
        const Vec3 target = aim_at(random_triangle_of(mesh, rng), rng);
        rays.push_back(ray_to(center + random_point(rng, distance), target));
    }
    return rays;
}

/// Unit octahedron, each face into 4^level triangles that share their vertices; pushed out to the sphere.
/// Closed.
Mesh sphere(int level) {
    Mesh mesh;
    mesh.positions = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                      Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};
    mesh.triangles = {UVec3(0, 2, 4), UVec3(2, 1, 4), UVec3(1, 3, 4), UVec3(3, 0, 4),
                      UVec3(2, 0, 5), UVec3(1, 2, 5), UVec3(3, 1, 5), UVec3(0, 3, 5)};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> midpoints;
        const auto midpoint = [&](uint32_t a, uint32_t b) {
            const auto [place, is_new] =
                midpoints.try_emplace(std::minmax(a, b), static_cast<uint32_t>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return place->second;
        };
        Array<UVec3> finer;
        for (const UVec3& t : mesh.triangles) {
            const uint32_t ab = midpoint(t.x, t.y), bc = midpoint(t.y, t.z), ca = midpoint(t.z, t.x);
            for (const UVec3& part :
                 {UVec3(t.x, ab, ca), UVec3(ab, t.y, bc), UVec3(ca, bc, t.z), UVec3(ab, bc, ca)}) {
                finer.push_back(part);
            }
        }
        mesh.triangles = finer;
    }
    return mesh;
}

StressCase slivers(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int i = 0; i < 12; ++i) {
        const Vec3 a = random_point(rng), b = random_point(rng);
        const float thin = power_of_two(-static_cast<int>(rng.next_index(30)));
        add_triangle(result.mesh, a, b, glm::mix(a, b, rng.next()) + random_point(rng, thin));
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 3.0f);
    return result;
}

StressCase needles(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int i = 0; i < 12; ++i) {
        const Vec3 tip = random_point(rng, 1000.0f), foot = random_point(rng);
        add_triangle(result.mesh, tip, foot, foot + random_point(rng, 1e-3f));
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 10.0f);
    return result;
}

/// Parallel layers whose heights differ by one unit in the last place.
StressCase layers(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    Vec3 tilt = random_point(rng, rng.next_index(2) == 0 ? 0.0f : 0.5f);
    for (int i = 0; i < 10; ++i) {
        const float lift = static_cast<float>(rng.next_index(4)) * 0x1p-23f;
        add_triangle(result.mesh, Vec3(-1.0f, -1.0f, 1.0f + lift), Vec3(1.0f, -1.0f, 1.0f + tilt.x + lift),
                     Vec3(-1.0f, 1.0f, 1.0f + tilt.y + lift));
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 3.0f);
    return result;
}

StressCase equal_centroids(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int i = 0; i < 12; ++i) {
        const float s = 1.0f + static_cast<float>(rng.next_index(4));
        add_triangle(result.mesh, Vec3(s, 0.0f, 0.0f), Vec3(0.0f, s, 0.0f), Vec3(-s, -s, 0.0f));
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 4.0f);
    return result;
}

/// One plane, axis-aligned, on whole numbers; rays through cell borders, some along the plane.
StressCase one_plane(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            const Vec3 p(static_cast<float>(x), static_cast<float>(y), 2.0f);
            add_triangle(result.mesh, p, p + Vec3(1, 0, 0), p + Vec3(0, 1, 0));
            add_triangle(result.mesh, p + Vec3(1, 0, 0), p + Vec3(1, 1, 0), p + Vec3(0, 1, 0));
        }
    }
    for (size_t i = 0; i < ray_count; ++i) {
        const Vec3 target(static_cast<float>(rng.next_index(7)) * 0.5f,
                          static_cast<float>(rng.next_index(7)) * 0.5f, 2.0f);
        const Vec3 origin(static_cast<float>(rng.next_index(9)) - 2.0f,
                          static_cast<float>(rng.next_index(9)) - 2.0f,
                          static_cast<float>(rng.next_index(5)));
        result.rays.push_back(ray_to(origin, target));
    }
    return result;
}

/// A stack of boxes on whole numbers and axis-parallel rays in their faces, with both zeros as components.
StressCase walls_at_borders(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p(static_cast<float>(rng.next_index(4)), static_cast<float>(rng.next_index(4)),
                     static_cast<float>(rng.next_index(4)));
        const int axis = static_cast<int>(rng.next_index(3));
        Vec3 u(0.0f), v(0.0f);
        u[(axis + 1) % 3] = 1.0f;
        v[(axis + 2) % 3] = 1.0f;
        add_triangle(result.mesh, p, p + u, p + v);
        add_triangle(result.mesh, p + u, p + u + v, p + v);
    }
    for (size_t i = 0; i < ray_count; ++i) {
        Ray ray;
        ray.origin =
            Vec3(static_cast<float>(rng.next_index(9)) * 0.5f, static_cast<float>(rng.next_index(9)) * 0.5f,
                 static_cast<float>(rng.next_index(9)) * 0.5f);
        const int axis = static_cast<int>(rng.next_index(3));
        for (int other = 0; other < 3; ++other) ray.direction[other] = rng.next_index(2) == 0 ? 0.0f : -0.0f;
        ray.direction[axis] = rng.next_index(2) == 0 ? 1.0f : -1.0f;
        ray.origin[axis] = ray.direction[axis] > 0.0f ? -1.0f : 5.0f;
        result.rays.push_back(ray);
    }
    return result;
}

/// Directions with components down to 2^-140 beside ordinary ones.
StressCase tiny_directions(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result = walls_at_borders(seed + 1, ray_count);
    for (int i = 0; i < 6; ++i)
        add_triangle(result.mesh, random_point(rng, 4.0f), random_point(rng, 4.0f), random_point(rng, 4.0f));
    for (Ray& ray : result.rays) {
        for (int axis = 0; axis < 3; ++axis) {
            if (ray.direction[axis] != 0.0f) continue;
            ray.direction[axis] =
                rng.next(-1.0f, 1.0f) * power_of_two(-60 - static_cast<int>(rng.next_index(81)));
        }
        if (rng.next_index(4) == 0) ray.direction *= power_of_two(-100);
        if (ray.direction == Vec3(0.0f)) ray.direction.y = 1.0f;
    }
    return result;
}

/// The same soup at a scale of 2^-100 to 2^100.
StressCase scales(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result = slivers(seed + 1, ray_count);
    const float scale = power_of_two(static_cast<int>(rng.next_index(201)) - 100);
    for (Vec3& position : result.mesh.positions) position *= scale;
    for (Ray& ray : result.rays) {
        ray.origin *= scale;
        if (rng.next_index(2) == 0) ray.direction *= scale;
    }
    return result;
}

/// A small scene far from the origin, its vertices as rounded there.
StressCase offsets(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    const Vec3 offset = random_point(rng, 1.0f) * std::pow(10.0f, rng.next(2.0f, 7.0f));
    for (int i = 0; i < 14; ++i) {
        const Vec3 p = random_point(rng);
        add_triangle(result.mesh, offset + p, offset + p + random_point(rng, 0.3f),
                     offset + p + random_point(rng, 0.3f));
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 3.0f, offset);
    return result;
}

/// Sizes and distances from 2^-60 to 2^60 in one scene.
StressCase geometric_chain(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    for (int i = 0; i < 16; ++i) {
        const float s = power_of_two(8 * i - 60);
        add_triangle(result.mesh, Vec3(s, s, s), Vec3(2.0f * s, s, s), Vec3(s, 2.0f * s, 1.5f * s));
    }
    for (size_t i = 0; i < ray_count; ++i) {
        const float s = power_of_two(static_cast<int>(rng.next_index(120)) - 60);
        result.rays.push_back(
            ray_to(random_point(rng, s), aim_at(random_triangle_of(result.mesh, rng), rng)));
    }
    return result;
}

/// Three triangles, each above one and below another; copies, also turned over.
StressCase cyclic_overlaps(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    const std::array<Vec3, 3> corners{Vec3(1.0f, 0.0f, 0.1f), Vec3(-0.5f, 0.875f, 0.1f),
                                      Vec3(-0.5f, -0.875f, 0.1f)};
    for (int copy = 0; copy < 4; ++copy) {
        for (size_t i = 0; i < 3; ++i) {
            const Vec3 a = corners[i], b = corners[(i + 1) % 3] * Vec3(1.0f, 1.0f, -1.0f);
            const Vec3 c = a + 0.3f * (corners[(i + 2) % 3] - a);
            if (copy % 2 == 0) {
                add_triangle(result.mesh, a, b, c);
            } else {
                add_triangle(result.mesh, c, b, a);
            }
        }
    }
    result.rays = aimed_rays(result.mesh, rng, ray_count, 3.0f);
    return result;
}

/// Ranges that end at a hit, just before it, or begin there: the plane z = 2 is met at whole t.
StressCase ranges(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result = one_plane(seed + 1, 0);
    for (size_t i = 0; i < ray_count; ++i) {
        Ray ray = ray_to(Vec3(rng.next(0.0f, 3.0f), rng.next(0.0f, 3.0f), 0.0f),
                         Vec3(rng.next(0.0f, 3.0f), rng.next(0.0f, 3.0f), 2.0f));
        const float hit = 1.0f;  // origin and direction reach z = 2 at t = 1 exactly
        ray.direction.z = 2.0f;
        const uint64_t kind = rng.next_index(4);
        if (kind == 0) ray.t_max = hit;
        if (kind == 1) ray.t_max = std::nextafter(hit, 0.0f);
        if (kind == 2) ray.t_min = hit;
        if (kind == 3) ray.t_min = std::nextafter(hit, 2.0f);
        result.rays.push_back(ray);
    }
    return result;
}

/// A fan round one vertex, up to 65,536 slivers, closed to a double cone; rays from inside at the hub, the
/// rim and the spokes. A ray meets the boxes of a good part of all slivers, at the hub those of all. So that
/// no fan takes most of the time, large ones get fewer rays, and fewer of these are aimed at the hub.
StressCase fans(uint64_t seed, size_t ray_count) {
    constexpr float kHubTests = 16.0f;  // at the hub, for each ray on average
    constexpr size_t kLargeFan = 1024;  // slivers of the largest fan that gets all rays
    Rng rng(seed);
    StressCase result;
    const auto count = static_cast<uint32_t>(power_of_two(4 + static_cast<int>(seed % 13)));
    const Vec3 hubs[2] = {Vec3(0.0f, 0.0f, 1.0f) + random_point(rng, 0.1f), Vec3(0.0f, 0.0f, -1.0f)};
    Mesh& mesh = result.mesh;
    for (const Vec3& hub : hubs) mesh.positions.push_back(hub);
    for (uint32_t i = 0; i < count; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(count);
        mesh.positions.push_back(Vec3(std::cos(angle), std::sin(angle), rng.next(-0.2f, 0.2f)));
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t rim = 2 + i, next = 2 + (i + 1) % count;
        mesh.triangles.push_back(UVec3(0, rim, next));
        mesh.triangles.push_back(UVec3(1, next, rim));
    }
    if (count > kLargeFan) ray_count = std::max(kLargeFan * ray_count / count, size_t{1});
    for (size_t i = 0; i < ray_count; ++i) {
        const Vec3 origin = random_point(rng, 0.1f);
        const bool is_at_hub = rng.next() < std::min(1.0f / 3.0f, kHubTests / static_cast<float>(count));
        const Vec3 rim = mesh.positions[2 + rng.next_index(count)];
        Vec3 target = hubs[rng.next_index(2)];
        if (!is_at_hub) target = glm::mix(target, rim, rng.next_index(2) == 0 ? 1.0f : rng.next());
        result.rays.push_back(ray_to(origin, target));
    }
    return result;
}

/// Rays from inside a sphere at its vertices, edges and faces.
StressCase closed_mesh(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    result.mesh = sphere(2 + static_cast<int>(seed % 4));
    const float scale = power_of_two(static_cast<int>(rng.next_index(61)) - 30);
    for (Vec3& position : result.mesh.positions) position *= scale;
    for (size_t i = 0; i < ray_count; ++i) {
        const Vec3 target = aim_at(random_triangle_of(result.mesh, rng), rng);
        result.rays.push_back(ray_to(random_point(rng, 0.5f * scale), target));
    }
    return result;
}

/// Rays that leave a sphere where another ray from outside hit it, within half a turn of the normal: the
/// sphere is convex, so they meet nothing.
StressCase leaving(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    result.mesh = sphere(2 + static_cast<int>(seed % 2));
    const float scale = power_of_two(static_cast<int>(rng.next_index(61)) - 30);
    const Vec3 offset = scale * random_point(rng, rng.next_index(2) == 0 ? 0.0f : 1000.0f);
    for (Vec3& position : result.mesh.positions) position = scale * position + offset;
    while (result.rays.size() < ray_count) {
        const Vec3 target = aim_at(random_triangle_of(result.mesh, rng), rng);
        const Ray ray = ray_to(offset + random_point(rng, 5.0f * scale), target);
        ClosestHit<Mode::Exact> closest(ray);
        NoCount no_count;
        for (uint32_t prim = 0; prim < result.mesh.triangle_count(); ++prim)
            closest.test(result.mesh.triangle(prim), prim, no_count);
        const Hit hit = closest.hit(result.mesh);
        if (!hit.is_hit()) continue;
        const DVec3 direction = glm::normalize(DVec3(ray.direction));
        const DVec3 normal = facing_normal(result.mesh.triangle(hit.prim), direction);
        if (glm::dot(normal, DVec3(target - offset)) < 0.0) continue;  // from within
        const float x = rng.next(), y = rng.next();
        result.rays.push_back(leaving_ray(ray, hit, normal, cosine_direction(normal, Vec2(x, y))));
    }
    return result;
}

StressCase not_finite(uint64_t seed, size_t ray_count) {
    Rng rng(seed);
    StressCase result;
    result.mesh = sphere(2);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (size_t i = 0; i < ray_count; ++i) {
        Ray ray = ray_to(random_point(rng), random_point(rng));
        const int axis = static_cast<int>(rng.next_index(3));
        const float bad = rng.next_index(2) == 0 ? kNan : rng.next_index(2) == 0 ? kInfinity : -kInfinity;
        const uint64_t kind = rng.next_index(4);
        if (kind == 0) ray.origin[axis] = bad;
        if (kind == 1) ray.direction[axis] = bad;
        if (kind == 2) ray.direction = Vec3(0.0f, -0.0f, 0.0f);
        if (kind == 3) ray.t_max = rng.next_index(2) == 0 ? kNan : -1.0f;
        result.rays.push_back(ray);
    }
    return result;
}

constexpr StressKind kKinds[] = {
    {"slivers", "triangles as thin as 2^-30 of their length", Judge::Oracle, 48, slivers},
    {"needles", "tips 1000 times as far as the foot is wide", Judge::Oracle, 48, needles},
    {"layers", "parallel layers one unit in the last place apart", Judge::Oracle, 48, layers},
    {"equal-centroids", "one centre for all, coplanar", Judge::Oracle, 48, equal_centroids},
    {"one-plane", "one plane on whole numbers, rays through corners and along it", Judge::Oracle, 48,
     one_plane},
    {"walls-at-borders", "whole numbers, axis-parallel rays in the faces, +0 and -0", Judge::Oracle, 64,
     walls_at_borders},
    {"tiny-directions", "direction components down to 2^-140", Judge::Oracle, 48, tiny_directions},
    {"scales", "scale 2^-100 to 2^100", Judge::Oracle, 48, scales},
    {"offsets", "offsets up to 1e7 times the extent", Judge::Oracle, 48, offsets},
    {"geometric-chain", "sizes 2^-60 to 2^60 in one scene", Judge::Oracle, 48, geometric_chain},
    {"cyclic-overlaps", "three triangles, each above one and below another", Judge::Oracle, 48,
     cyclic_overlaps},
    {"ranges", "ranges that end or begin at the hit, or just miss it", Judge::Oracle, 48, ranges},
    {"fans", "fans of 16 to 65,536 slivers, aimed at the hub and the spokes", Judge::MustHit, 40000, fans,
     0.1},
    {"closed-mesh", "a sphere from inside, aimed at vertices and edges", Judge::MustHit, 40000, closed_mesh,
     0.9},
    {"leaving", "rays from where a sphere was hit, outwards", Judge::MustMiss, 200, leaving},
    {"not-finite", "NaN, infinity, no direction, an empty range", Judge::MustMiss, 1000, not_finite},
};

}  // namespace

std::span<const StressKind> stress_kinds() { return kKinds; }

}  // namespace boxwood::bench
