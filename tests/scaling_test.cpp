#include <gtest/gtest.h>

#include <cmath>

#include "support/all_recipes.h"
#include "support/random_mesh.h"
#include "support/test_name.h"

namespace boxwood {
namespace {

/// Without error: the coordinates are multiples of 2^-24 below 2, so that none is lost at 2^-100.
Vec3 scaled(const Vec3& v, float factor) {
    const Vec3 result = v * factor;
    EXPECT_EQ(result / factor, v);
    return result;
}

class Scaling : public testing::TestWithParam<std::string> {};

TEST_P(Scaling, ByAPowerOfTwoGivesTheSameNodesAndHits) {
    Task task;
    const Mesh mesh = random_triangles(300, 0.3f, 1);
    const std::vector<Ray> rays = rays_for(mesh, 400, 2);
    const Built built = run(GetParam(), mesh);
    const std::vector<NodeView>& nodes = built.levels->list.nodes;
    for (const int exponent : {-100, -61, -1, 40, 100}) {
        const float factor = std::ldexp(1.0f, exponent);
        Mesh scaled_mesh = mesh;
        for (Vec3& p : scaled_mesh.positions) p = scaled(p, factor);
        const Built other = run(GetParam(), scaled_mesh);
        const std::vector<NodeView>& other_nodes = other.levels->list.nodes;
        ASSERT_EQ(other_nodes.size(), nodes.size()) << exponent;
        ASSERT_EQ(other.levels->list.ref_prims, built.levels->list.ref_prims) << exponent;
        for (size_t i = 0; i < nodes.size(); ++i) {
            ASSERT_EQ(other_nodes[i].bounds.lower, nodes[i].bounds.lower * factor) << "node " << i;
            ASSERT_EQ(other_nodes[i].bounds.upper, nodes[i].bounds.upper * factor) << "node " << i;
            ASSERT_EQ(other_nodes[i].parent, nodes[i].parent) << "node " << i;
            ASSERT_EQ(other_nodes[i].kind, nodes[i].kind) << "node " << i;
            ASSERT_EQ(other_nodes[i].first_ref, nodes[i].first_ref) << "node " << i;
            ASSERT_EQ(other_nodes[i].ref_count, nodes[i].ref_count) << "node " << i;
        }
        // With scaled directions t is the same; with the directions as they are it is scaled.
        for (const bool scales_directions : {true, false}) {
            std::vector<Ray> scaled_rays = rays;
            for (Ray& ray : scaled_rays) {
                ray.origin = scaled(ray.origin, factor);
                if (scales_directions) ray.direction = scaled(ray.direction, factor);
            }
            for (const Mode mode : {Mode::Exact, Mode::Fast}) {
                std::vector<Hit> hits(rays.size()), other_hits(rays.size());
                built.structure.closest_hits(mesh, rays, hits, mode, task);
                other.structure.closest_hits(scaled_mesh, scaled_rays, other_hits, mode, task);
                size_t hit_count = 0;
                for (size_t i = 0; i < rays.size(); ++i) {
                    const Hit expected{scales_directions ? hits[i].t : hits[i].t * factor, hits[i].prim};
                    ASSERT_EQ(other_hits[i], expected) << "ray " << i << ", 2^" << exponent;
                    hit_count += hits[i].is_hit();
                }
                EXPECT_GT(hit_count, rays.size() / 10);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, Scaling, testing::ValuesIn(all_recipes()), test_name);

}  // namespace
}  // namespace boxwood
