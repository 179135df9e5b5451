#include "core/kdtree/ropes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/kdtree/kd_median.h"
#include "core/kdtree/kd_sah.h"
#include "support/all_recipes.h"
#include "support/lattice.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

RopedKdTree rope(const Mesh& mesh, const KdTree& tree) {
    Task task;
    return AddRopes{}.apply(mesh, whole_refs(mesh), tree, task);
}

TEST(Ropes, PointToTheLowestNodeThatContainsTheFace) {
    const Mesh mesh = random_triangles(500, 0.1f, 1);
    Task task;
    const RopedKdTree roped = rope(mesh, KdMedian{.leaf_size = 2}.build(mesh, whole_refs(mesh), task));
    size_t inner_count = 0, outside_count = 0;
    for (uint32_t node = 0; node < roped.cells.size(); ++node) {
        if (roped.leaves[node] == kNoIndex) continue;
        const Box& cell = roped.cells[node];
        for (size_t f = 0; f < 6; ++f) {
            const int axis = static_cast<int>(f % 3);
            const bool is_upper = f >= 3;
            Box face = cell;
            (is_upper ? face.lower : face.upper)[axis] = (is_upper ? cell.upper : cell.lower)[axis];
            const uint32_t target = roped.ropes[roped.leaves[node]].faces[f];
            if (target == kNoIndex) {
                EXPECT_EQ(face.lower[axis],
                          (is_upper ? roped.tree.bounds.upper : roped.tree.bounds.lower)[axis]);
                ++outside_count;
                continue;
            }
            const Box& beyond = roped.cells[target];
            ASSERT_TRUE(beyond.contains(face));
            ASSERT_EQ((is_upper ? beyond.lower : beyond.upper)[axis], face.lower[axis]);
            const KdTree::Node& found = roped.tree.nodes[target];
            if (found.is_leaf()) continue;
            ++inner_count;  // then its plane cuts the face
            ASSERT_NE(found.axis(), axis);
            ASSERT_LT(face.lower[found.axis()], found.plane());
            ASSERT_GT(face.upper[found.axis()], found.plane());
        }
    }
    EXPECT_GT(inner_count, 100u);
    EXPECT_GT(outside_count, 100u);
}

TEST(Ropes, FindTheSameHitsAsBruteForceThroughWallsEdgesAndCornersOfCells) {
    Task task;
    for (const Mesh& mesh : {lattice_mesh(30, 2), lattice_mesh(120, 3)}) {
        const Structure reference = run("none", mesh).structure;
        std::vector<Ray> rays = lattice_rays(1500, 4);
        for (const Ray& ray : rays_for(mesh, 300, 5)) rays.push_back(ray);
        for (const char* recipe : {"kd-sah(traversal-cost=0) > ropes", "kd-median(leaf-size=1) > ropes"}) {
            const Structure structure = run(recipe, mesh).structure;
            for (const Mode mode : {Mode::Exact, Mode::Fast}) {
                std::vector<Hit> hits(rays.size()), expected(rays.size());
                structure.closest_hits(mesh, rays, hits, mode, task);
                reference.closest_hits(mesh, rays, expected, mode, task);
                for (size_t i = 0; i < rays.size(); ++i)
                    ASSERT_EQ(hits[i], expected[i]) << recipe << " ray " << i;
            }
        }
    }
}

TEST(Ropes, VisitEveryLeafThatTheRayCrossesAndFewerInnerNodes) {
    const Mesh mesh = random_triangles(400, 0.02f, 6);
    Task task;
    const KdTree tree = KdMedian{.leaf_size = 1}.build(mesh, whole_refs(mesh), task);
    const Structure plain(tree), roped(rope(mesh, tree));
    const NodeList list = plain.list_nodes();
    size_t missing_rays = 0, inner_by_stack = 0, inner_by_ropes = 0;
    for (const Ray& ray : rays_for(mesh, 500, 7)) {
        Hit hit;
        plain.closest_hits(mesh, {&ray, 1}, {&hit, 1}, Mode::Exact, task);
        if (hit.is_hit()) continue;
        ++missing_rays;
        std::vector<uint32_t> by_stack(list.nodes.size(), 0), by_ropes(list.nodes.size(), 0);
        plain.add_visits(mesh, {&ray, 1}, by_stack, Mode::Exact, task);
        roped.add_visits(mesh, {&ray, 1}, by_ropes, Mode::Exact, task);
        for (size_t i = 0; i < list.nodes.size(); ++i) {
            if (list.nodes[i].kind == NodeKind::Inner) {
                inner_by_stack += by_stack[i];
                inner_by_ropes += by_ropes[i];
            } else if (by_stack[i] > 0) {
                ASSERT_GT(by_ropes[i], 0u);
            }
        }
    }
    EXPECT_LT(inner_by_ropes, inner_by_stack);
    EXPECT_GT(missing_rays, 100u);
}

TEST(Ropes, EndWhereTheHitIsNearerThanTheNextCell) {
    // Two walls across the ray; the second one is never tested.
    Mesh mesh = random_triangles(2, 0.1f, 8);
    for (uint32_t i = 0; i < 2; ++i) {
        const float x = 1.0f + 8.0f * static_cast<float>(i);
        mesh.positions[3 * i] = {x, -1, -1};
        mesh.positions[3 * i + 1] = {x, 3, -1};
        mesh.positions[3 * i + 2] = {x + 0.5f, -1, 3};
    }
    Task task;
    const Structure roped(rope(mesh, KdMedian{.leaf_size = 1}.build(mesh, whole_refs(mesh), task)));
    Ray ray;
    ray.origin = Vec3(-1.0f, 0.1f, 0.2f);
    ray.direction = Vec3(1.0f, 0.01f, 0.02f);
    Hit hit;
    Count count;
    roped.closest_hits_counted(mesh, {&ray, 1}, {&hit, 1}, {&count, 1}, Mode::Exact, task);
    EXPECT_EQ(hit.prim, 0u);
    EXPECT_EQ(count.tests, 1u);
}

}  // namespace
}  // namespace boxwood
