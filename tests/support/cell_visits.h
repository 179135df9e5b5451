#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/structure/structure.h"
#include "oracle/polygon.h"
#include "tests/support/random_mesh.h"

namespace boxwood {

/// Rays at corners, edges and faces of the nodes' boxes, along them, and at random points, some along axes
/// with both zeros and with tiny components.
inline std::vector<Ray> rays_at_walls(const std::vector<NodeView>& nodes, size_t count, uint64_t seed) {
    std::vector<Ray> rays;
    Rng rng(seed);
    const DVec3 extent = nodes[0].bounds.extent();
    const auto point = [&](float reach) {
        Vec3 p = Vec3(nodes[0].bounds.center());
        for (int axis = 0; axis < 3; ++axis)
            p[axis] += rng.next(-reach, reach) * static_cast<float>(std::max(extent[axis], 1e-30));
        return p;
    };
    const auto at_wall = [&] {
        const Box& box = nodes[rng.next_index(nodes.size())].bounds;
        Vec3 p = point(0.5f);
        for (int axis = 0; axis < 3; ++axis) {
            const uint64_t place = rng.next_index(5);
            if (place < 2) p[axis] = box.lower[axis];
            if (place == 2) p[axis] = box.upper[axis];
        }
        return p;
    };
    while (rays.size() < count) {
        Ray ray;
        ray.origin = rng.next_index(2) == 0 ? at_wall() : point(1.0f);
        ray.direction = at_wall() - ray.origin;
        const auto axis = static_cast<int>(rng.next_index(3));
        const uint64_t kind = rng.next_index(4);
        if (kind == 0) ray.direction[axis] = rng.next_index(2) == 0 ? 0.0f : -0.0f;
        if (kind == 1) ray.direction[axis] = std::ldexp(1.0f, -140);
        if (kind == 2) ray.direction[(axis + 1) % 3] = ray.direction[axis] = -0.0f;
        if (ray.direction != Vec3(0.0f)) rays.push_back(ray);
    }
    return rays;
}

/// A ray that hits nothing must visit exactly the nodes whose boxes it meets, each once, and the root.
template <Mode mode, AccelerationStructure S>
void expect_visits_of_boxes_met(const S& structure, const Mesh& mesh, const std::vector<Ray>& rays,
                                size_t least_misses) {
    const NodeList list = structure.list_nodes();
    size_t misses = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        std::vector<uint32_t> visits(list.nodes.size(), 0), expected(list.nodes.size(), 0);
        ClosestHit<mode> ray(rays[i]);
        NodeVisits counter{visits};
        structure.closest_hit(mesh, ray, counter);
        if (ray.hit(mesh).is_hit()) continue;
        ++misses;
        for (size_t n = 0; n < list.nodes.size(); ++n) {
            double entry;
            expected[n] = ray.meets(list.nodes[n].bounds.lower, list.nodes[n].bounds.upper, entry) ? 1 : 0;
        }
        expected[0] = 1;
        ASSERT_EQ(visits, expected) << "ray " << i;
    }
    EXPECT_GE(misses, least_misses);
}

/// Every leaf must have exactly the primitives that touch its cell by rational arithmetic.
inline void expect_exact_references(const NodeList& list, const Mesh& mesh) {
    for (size_t n = 0; n < list.nodes.size(); ++n) {
        const NodeView& leaf = list.nodes[n];
        if (leaf.kind != NodeKind::Leaf) continue;
        std::vector<uint32_t> expected;
        for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
            if (oracle::touches(mesh.triangle(prim), leaf.bounds)) expected.push_back(prim);
        const auto first = list.ref_prims.begin() + leaf.first_ref;
        ASSERT_EQ(std::vector<uint32_t>(first, first + leaf.ref_count), expected) << "leaf " << n;
    }
}

/// A ray must test each primitive of the leaves that it visits once; some it must come across more often.
template <AccelerationStructure S>
void expect_no_test_twice(const S& structure, const Mesh& mesh, const std::vector<Ray>& rays) {
    const NodeList list = structure.list_nodes();
    uint64_t tests = 0, references = 0;
    for (const Ray& each : rays) {
        std::vector<uint32_t> visits(list.nodes.size(), 0);
        NodeVisits visit_counter{visits};
        Count count;
        ClosestHit<Mode::Exact> ray(each), same_ray(each);
        structure.closest_hit(mesh, ray, count);
        structure.closest_hit(mesh, same_ray, visit_counter);
        std::vector<uint8_t> is_met(mesh.triangle_count(), 0);
        for (size_t n = 0; n < list.nodes.size(); ++n)
            for (uint32_t r = 0; visits[n] > 0 && r < list.nodes[n].ref_count; ++r) {
                is_met[list.ref_prims[list.nodes[n].first_ref + r]] = 1;
                ++references;
            }
        uint64_t met = 0;
        for (const uint8_t is : is_met) met += is;
        ASSERT_LE(count.tests, met);
        // A hit may end the search before a leaf that was met.
        ASSERT_TRUE(ray.hit(mesh).is_hit() || count.tests == met);
        tests += count.tests;
    }
    EXPECT_GT(4 * references, 5 * tests)
        << "too few primitives are come across twice: the test shows nothing";
}

/// Two small triangles at opposite corners of the cube [-1, 1]^3 + offset: what most rays miss.
inline Mesh two_corners(const Vec3& offset) {
    Mesh mesh;
    for (const float s : {-1.0f, 1.0f}) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(offset + s * Vec3(1.0f, 1.0f, 1.0f));
        mesh.positions.push_back(offset + s * Vec3(0.99f, 1.0f, 0.99f));
        mesh.positions.push_back(offset + s * Vec3(1.0f, 0.99f, 0.99f));
        mesh.triangles.push_back(UVec3(first, first + 1, first + 2));
    }
    return mesh;
}

}  // namespace boxwood
