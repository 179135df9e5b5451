#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "support/all_recipes.h"
#include "support/random_mesh.h"
#include "support/test_name.h"

namespace boxwood {
namespace {

class EveryMethod : public testing::TestWithParam<std::string> {};

TEST_P(EveryMethod, FindsTheSameHitsAsBruteForce) {
    Task task;
    for (const float size : {0.02f, 0.4f}) {
        const Mesh mesh = random_triangles(300, size, 1);
        const Structure structure = run(GetParam(), mesh).structure;
        const Structure reference = run("none", mesh).structure;
        const std::vector<Ray> rays = rays_for(mesh, 1000, 5);
        for (const Mode mode : {Mode::Exact, Mode::Fast}) {
            std::vector<Hit> hits(rays.size()), expected(rays.size());
            std::vector<uint8_t> occluded(rays.size());
            structure.closest_hits(mesh, rays, hits, mode, task);
            reference.closest_hits(mesh, rays, expected, mode, task);
            structure.any_hits(mesh, rays, occluded, mode, task);
            size_t hit_count = 0;
            for (size_t i = 0; i < rays.size(); ++i) {
                ASSERT_EQ(hits[i], expected[i]) << "ray " << i;
                ASSERT_EQ(occluded[i] != 0, expected[i].is_hit()) << "ray " << i;
                hit_count += expected[i].is_hit();
            }
            EXPECT_GT(hit_count, rays.size() / 10);
        }
    }
}

TEST_P(EveryMethod, CountsItsVisitsNodeByNode) {
    Task task;
    const Mesh mesh = random_triangles(300, 0.1f, 1);
    const Structure structure = run(GetParam(), mesh).structure;
    const std::vector<Ray> rays = rays_for(mesh, 200, 6);
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        std::vector<Hit> hits(rays.size());
        std::vector<Count> counts(rays.size());
        std::vector<uint32_t> visits(structure.list_nodes().nodes.size(), 0);
        structure.closest_hits_counted(mesh, rays, hits, counts, mode, task);
        structure.add_visits(mesh, rays, visits, mode, task);
        uint64_t expected = 0, sum = 0;
        for (const Count& count : counts) expected += count.nodes;
        for (const uint32_t visit : visits) sum += visit;
        EXPECT_EQ(sum, expected);
    }
}

TEST_P(EveryMethod, MakesAValidHierarchyThatHoldsEveryPrimitive) {
    const Mesh mesh = random_triangles(1000, 0.2f, 2);
    EXPECT_EQ(check_nodes(run(GetParam(), mesh).levels->list, mesh.triangle_count()), "");
}

TEST_P(EveryMethod, IsTheSameForOneAndManyThreads) {
    const Mesh mesh = random_triangles(9000, 0.05f, 3);
    const NodeList many = run(GetParam(), mesh).structure.list_nodes();
    const ThreadLimit limit(1);
    const NodeList one = run(GetParam(), mesh).structure.list_nodes();
    ASSERT_EQ(one.nodes.size(), many.nodes.size());
    EXPECT_EQ(one.ref_prims, many.ref_prims);
    for (size_t i = 0; i < one.nodes.size(); ++i) {
        ASSERT_EQ(one.nodes[i].bounds, many.nodes[i].bounds) << "node " << i;
        ASSERT_EQ(one.nodes[i].parent, many.nodes[i].parent) << "node " << i;
        ASSERT_EQ(one.nodes[i].first_ref, many.nodes[i].first_ref) << "node " << i;
    }
}

/// Sizes from 2^-100 to 2^100 in one scene: every split parts off one triangle.
Mesh geometric_chain() {
    Mesh mesh = random_triangles(200, 0.1f, 4);
    for (uint32_t i = 0; i < 200; ++i) {
        const float s = std::ldexp(1.0f, static_cast<int>(i) - 100);
        const Vec3 corners[3] = {Vec3(s, s, s), Vec3(2.0f * s, s, s), Vec3(s, 2.0f * s, s)};
        for (uint32_t corner = 0; corner < 3; ++corner) mesh.positions[3 * i + corner] = corners[corner];
    }
    return mesh;
}

TEST_P(EveryMethod, EndsOnDegenerateScenes) {
    Mesh equal = random_triangles(3000, 0.2f, 5);
    for (UVec3& triangle : equal.triangles) triangle = UVec3(0, 1, 2);
    Mesh flat = random_triangles(500, 0.2f, 6);
    for (Vec3& position : flat.positions) position.z = 0.5f;
    Mesh huge = random_triangles(100, 0.5f, 7);
    for (Vec3& position : huge.positions) position *= 1e38f;
    Mesh tiny = random_triangles(100, 0.5f, 8);
    for (Vec3& position : tiny.positions) position *= 1e-38f;
    for (const Mesh& mesh : {random_triangles(1, 0.5f, 9), equal, flat, huge, tiny, geometric_chain()}) {
        const Built built = run(GetParam(), mesh);
        EXPECT_EQ(check_nodes(built.levels->list, mesh.triangle_count()), "");
        EXPECT_LE(built.levels->level_count(), 65u);
    }
    EXPECT_EQ(run(GetParam(), Mesh{}).levels->list.ref_prims.size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Catalog, EveryMethod, testing::ValuesIn(all_recipes()), test_name);

}  // namespace
}  // namespace boxwood
