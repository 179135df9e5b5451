#include <gtest/gtest.h>

#include "core/bvh/binned_sah.h"
#include "core/structure/closest.h"
#include "oracle/oracle.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

/// A fan of slivers round one vertex, a pair of coplanar triangles, and random ones; every edge shared bit
/// for bit.
Mesh nasty_mesh(uint64_t seed, float offset, float scale) {
    Mesh mesh;
    Rng rng(seed);
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Vec3& p : {a, b, c}) mesh.positions.push_back(p * scale + Vec3(offset));
        mesh.triangles.push_back(UVec3(first, first + 1, first + 2));
    };
    const Vec3 hub = random_point(rng, 0.1f);
    const Vec3 first_rim(1.0f, 0.0f, 0.3f);
    Vec3 previous = first_rim;
    for (int i = 1; i <= 12; ++i) {
        const float angle = static_cast<float>(i) * 0.52f;
        const Vec3 rim(std::cos(angle), std::sin(angle), 0.3f * std::cos(3.0f * angle));
        const Vec3 next = i == 12 ? first_rim : rim;
        add(hub, previous, next);
        previous = next;
    }
    add(Vec3(-1.0f, -1.0f, -1.0f), Vec3(1.0f, -1.0f, -1.0f), Vec3(-1.0f, 1.0f, -1.0f));
    add(Vec3(1.0f, 1.0f, -1.0f), Vec3(1.0f, -1.0f, -1.0f), Vec3(-1.0f, 1.0f, -1.0f));
    add(Vec3(1.0f, 1.0f, -1.0f), Vec3(1.0f, -1.0f, -1.0f), Vec3(-1.0f, 1.0f, -1.0f));
    for (int i = 0; i < 8; ++i) {
        const Vec3 a = random_point(rng, 1.0f), b = random_point(rng, 1.0f);
        add(a, b, a + 1e-4f * random_point(rng, 1.0f));
    }
    return mesh;
}

/// Rays at vertices, at points of edges, along axes, of any kind, and starting on the surface, with t near 0.
Ray aimed_ray(const Mesh& mesh, Rng& rng, float offset, float scale) {
    Ray ray;
    ray.origin = random_point(rng, 3.0f) * scale + Vec3(offset);
    const Triangle triangle = mesh.triangle(static_cast<uint32_t>(rng.next_index(mesh.triangle_count())));
    Vec3 target = triangle.a;
    const uint64_t kind = rng.next_index(5);
    if (kind == 1) target = glm::mix(triangle.a, triangle.b, rng.next());
    if (kind == 2) target = (triangle.a + triangle.b + triangle.c) / 3.0f;
    if (kind == 3) target = random_point(rng, 1.0f) * scale + Vec3(offset);
    ray.direction = target - ray.origin;
    if (kind == 4) {
        ray.origin = Vec3(target.x, target.y, ray.origin.z);
        ray.direction = Vec3(0.0f, -0.0f, ray.origin.z > target.z ? -1.0f : 1.0f);
    }
    if (rng.next_index(4) == 0) {
        ray.origin = target;
        ray.direction = random_point(rng, 1.0f) * scale;
    }
    if (ray.direction == Vec3(0.0f)) ray.direction.x = scale;
    if (rng.next_index(8) == 0) ray.t_max = 1.0f;
    return ray;
}

void expect_exact(const Mesh& mesh, const std::vector<Ray>& rays) {
    Task task;
    const Structure structure(BinnedSah{.max_leaf_size = 1}.build(mesh, whole_refs(mesh), task));
    std::vector<Hit> hits(rays.size());
    std::vector<Count> counts(rays.size());
    structure.closest_hits_counted(mesh, rays, hits, counts, Mode::Exact, task);
    size_t hit_count = 0;
    uint64_t exact_count = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const std::optional<oracle::ExactHit> expected = oracle::closest_hit(mesh, rays[i]);
        ASSERT_EQ(hits[i].prim, expected ? expected->prim : kNoIndex) << "ray " << i;
        if (expected) {
            ASSERT_EQ(hits[i].t, oracle::round_to_float(expected->t)) << "ray " << i;
            ++hit_count;
        }
        exact_count += counts[i].exact;
    }
    EXPECT_GT(hit_count, rays.size() / 5);
    EXPECT_GT(exact_count, 0u) << "no ray came close to an edge: the test shows nothing";
}

void expect_exact(float offset, float scale, uint64_t seed, int ray_count) {
    const Mesh mesh = nasty_mesh(seed, offset, scale);
    Rng rng(seed);
    std::vector<Ray> rays;
    for (int i = 0; i < ray_count; ++i) rays.push_back(aimed_ray(mesh, rng, offset, scale));
    expect_exact(mesh, rays);
}

TEST(Exact, AgreesWithRationalArithmetic) { expect_exact(0.0f, 1.0f, 1, 4000); }
TEST(Exact, AgreesFarFromTheOrigin) { expect_exact(1000.0f, 0.001f, 2, 2000); }
TEST(Exact, AgreesAtTinyAndHugeScales) {
    expect_exact(0.0f, 0x1p-100f, 3, 1000);
    expect_exact(0.0f, 0x1p100f, 4, 1000);
}

/// Edge functions are computed in whole numbers up to a factor of 2^16 between components, and otherwise in
/// sums of doubles.
TEST(Exact, AgreesWhereComponentsDifferInSize) {
    for (const int range : {8, 13, 14, 15, 16, 17, 18, 24, 60}) {
        const Vec3 scale(1.0f, std::ldexp(1.0f, -range), std::ldexp(1.0f, range / 2));
        Mesh mesh = nasty_mesh(static_cast<uint64_t>(range), 0.0f, 1.0f);
        Rng rng(static_cast<uint64_t>(range));
        std::vector<Ray> rays;
        for (int i = 0; i < 500; ++i) {
            Ray ray = aimed_ray(mesh, rng, 0.0f, 1.0f);
            ray.origin *= scale;
            ray.direction *= scale;
            rays.push_back(ray);
        }
        for (Vec3& position : mesh.positions) position *= scale;
        expect_exact(mesh, rays);
    }
}

TEST(Exact, HasNoLeakAtTheVertexOfAFan) {
    const Mesh mesh = nasty_mesh(7, 0.0f, 1.0f);
    Rng rng(8);
    for (int i = 0; i < 2000; ++i) {
        Ray ray;
        ray.origin = random_point(rng, 0.2f) + Vec3(0.0f, 0.0f, 3.0f);
        ray.direction = mesh.positions[0] - ray.origin;  // the hub, inside the closed ring
        ClosestHit<Mode::Exact> closest(ray);
        NoCount count;
        for (uint32_t prim = 0; prim < 12; ++prim) closest.test(mesh.triangle(prim), prim, count);
        ASSERT_TRUE(closest.hit(mesh).is_hit()) << "ray " << i;
    }
}

/// The hit of two triangles tested in both orders, and how many decisions took exact arithmetic.
struct Tie {
    Hit hits[2];
    uint64_t exact_count = 0;
};
Tie test_both_orders(const Ray& ray, const Triangle& first, const Triangle& second) {
    const Mesh mesh;
    Tie tie;
    for (uint32_t order = 0; order < 2; ++order) {
        Count count;
        ClosestHit<Mode::Exact> closest(ray);
        closest.test(order == 0 ? first : second, order, count);
        closest.test(order == 0 ? second : first, 1 - order, count);
        tie.hits[order] = closest.hit(mesh);
        tie.exact_count += count.exact;
    }
    return tie;
}

Ray ray_from(const Vec3& origin, const Vec3& direction) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

TEST(Exact, CopiesAndFloorsTieWithoutExactArithmetic) {
    const Triangle triangle{Vec3(0.1f, 0.2f, 1.0f), Vec3(2.0f, 0.3f, 1.7f), Vec3(0.4f, 2.0f, 1.3f)};
    const Triangle copy{triangle.c, triangle.a, triangle.b};
    const Tie copies =
        test_both_orders(ray_from(Vec3(0.7f, 0.7f, 0.0f), Vec3(0.1f, 0.0f, 1.0f)), triangle, copy);
    const Triangle floor{Vec3(0.0f, 0.0f, 1.1f), Vec3(2.0f, 0.0f, 1.1f), Vec3(0.0f, 2.0f, 1.1f)};
    const Triangle other{Vec3(-1.0f, 0.0f, 1.1f), Vec3(2.0f, 0.5f, 1.1f), Vec3(0.0f, 3.0f, 1.1f)};
    const Tie floors =
        test_both_orders(ray_from(Vec3(0.7f, 0.7f, 0.0f), Vec3(0.1f, 0.0f, 1.0f)), floor, other);
    for (const Tie& tie : {copies, floors}) {
        EXPECT_EQ(tie.hits[0].prim, 0u);
        EXPECT_EQ(tie.hits[1], tie.hits[0]);
        EXPECT_EQ(tie.exact_count, 0u);
    }
}

TEST(Exact, SharedEdgesAndVerticesTieOnlyWhereTheRayMeetsThem) {
    // Two roofs over the edge from (-1, 0, 2) to (1, 0, 2), one of them twice as steep.
    const Vec3 p(-1.0f, 0.0f, 2.0f), q(1.0f, 0.0f, 2.0f);
    const Triangle flat{p, q, Vec3(0.0f, 2.0f, 3.0f)}, steep{p, q, Vec3(0.0f, 2.0f, 4.0f)};
    const Triangle at_vertex{p, Vec3(3.0f, 1.0f, 5.0f), Vec3(3.0f, -1.0f, 5.0f)};
    const auto lower_wins = [](const Ray& ray, const Triangle& first, const Triangle& second) {
        const Tie tie = test_both_orders(ray, first, second);
        return tie.hits[0].prim == 0 && tie.hits[1] == tie.hits[0];
    };
    // Through the edge and through the vertex: a tie. Beside them by one unit in the last place: the nearer.
    EXPECT_TRUE(lower_wins(ray_from(Vec3(0.25f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, 1.0f)), flat, steep));
    EXPECT_TRUE(lower_wins(ray_from(Vec3(-1.0f, 0.0f, 0.0f), Vec3(0.0f, 0.0f, 1.0f)), flat, at_vertex));
    const Ray beside = ray_from(Vec3(0.25f, 0x1p-140f, 0.0f), Vec3(0.0f, 0.0f, 1.0f));
    for (const Hit& hit : test_both_orders(beside, flat, steep).hits) EXPECT_EQ(hit.prim, 0u);
    for (const Hit& hit : test_both_orders(beside, steep, flat).hits) EXPECT_EQ(hit.prim, 1u);
}

TEST(RaySlabs, NeverMissABoxThatExactArithmeticMeets) {
    Rng rng(9);
    int meet_count = 0, too_many = 0;
    for (int i = 0; i < 20000; ++i) {
        Box box;
        box.extend(random_point(rng, 1.0f));
        box.extend(i % 3 == 0 ? Vec3(box.lower.x, 0.5f, 0.25f) : random_point(rng, 1.0f));
        Ray ray;
        ray.origin = random_point(rng, 2.0f);
        // At a corner, with the other components as they fall.
        const Vec3 corner(rng.next() < 0.5f ? box.lower.x : box.upper.x,
                          rng.next() < 0.5f ? box.lower.y : box.upper.y,
                          rng.next() < 0.5f ? box.lower.z : box.upper.z);
        ray.direction = corner - ray.origin;
        const int axis = static_cast<int>(rng.next_index(3));
        const uint64_t kind = rng.next_index(4);
        if (kind == 1) ray.direction[axis] = rng.next() < 0.5f ? 0.0f : -0.0f;
        if (kind == 2) ray.direction[axis] = std::ldexp(rng.next(-1.0f, 1.0f), -140);
        if (kind == 1 || kind == 2) ray.origin[axis] = corner[axis];
        double entry;
        const bool computed =
            RaySlabs(ray).meets(box.lower, box.upper, std::numeric_limits<double>::infinity(), entry);
        const bool exact = oracle::meets(ray, box);
        ASSERT_TRUE(computed || !exact) << "ray " << i;
        meet_count += exact;
        too_many += computed && !exact;
    }
    EXPECT_GT(meet_count, 4000);
    EXPECT_LT(too_many, 4000);
}

}  // namespace
}  // namespace boxwood
