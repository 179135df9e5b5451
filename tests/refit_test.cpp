#include "core/bvh/refit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/catalog/pipeline.h"
#include "core/scene/frame.h"
#include "support/random_mesh.h"
#include "support/test_name.h"

namespace boxwood {
namespace {

std::shared_ptr<const Scene> kitchen_at(int frame) {
    Task task;
    return open_scene(with_frame("kitchen", frame), task);
}

Built run_at(int frame, const std::string& recipe) {
    StageCache cache;
    Task task;
    return run_recipe(parse_recipe(recipe), kitchen_at(frame), cache, task, /*with_levels=*/true).value();
}

/// Builders whose structures can be refitted.
std::vector<std::string> refittable() {
    std::vector<std::string> ids;
    for (const CatalogEntry& entry : builder_catalog())
        if (std::string(entry.output) == Refit::Input::kFamily) ids.push_back(entry.id);
    return ids;
}

bool same_bytes(const Bvh2& a, const Bvh2& b) {
    return a.prims == b.prims && a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(Bvh2::Node)) == 0;
}

class EveryRefittable : public testing::TestWithParam<std::string> {};

TEST_P(EveryRefittable, OnTheFrameOfTheBuildTheTreeIsTheBuiltOneBitForBit) {
    StageCache cache;
    Task task;
    const std::shared_ptr<const Scene> scene = kitchen_at(7);
    const Built built = run_recipe(parse_recipe(GetParam()), scene, cache, task).value();
    const Recipe recipe = parse_recipe(GetParam() + " > refit(from=7)");
    if (built.structure.as<Bvh2>()->prims.size() > scene->mesh.triangle_count()) {
        EXPECT_THROW(run_recipe(recipe, scene, cache, task), Error) << "it holds pieces of triangles";
        return;
    }
    const Built refitted = run_recipe(recipe, scene, cache, task).value();
    EXPECT_TRUE(same_bytes(*built.structure.as<Bvh2>(), *refitted.structure.as<Bvh2>()));
}

INSTANTIATE_TEST_SUITE_P(Refit, EveryRefittable, testing::ValuesIn(refittable()), test_name);

TEST(Refit, KeepsNodesAndLeavesAndMakesEveryBoxTight) {
    const Built old = run_at(0, "bvh-binned-sah"), refitted = run_at(45, "bvh-binned-sah > refit");
    const Bvh2 &before = *old.structure.as<Bvh2>(), &after = *refitted.structure.as<Bvh2>();
    const Mesh& mesh = refitted.scene->mesh;
    EXPECT_EQ(before.prims, after.prims);
    ASSERT_EQ(before.nodes.size(), after.nodes.size());
    size_t changed = 0;
    for (size_t i = 0; i < after.nodes.size(); ++i) {
        const Bvh2::Node& node = after.nodes[i];
        ASSERT_EQ(node.first, before.nodes[i].first);
        ASSERT_EQ(node.count, before.nodes[i].count);
        Box expected;
        for (uint32_t k = node.first; k < node.first + node.count; ++k)
            expected.extend(mesh.triangle(after.prims[k]).bounds());
        if (!node.is_leaf()) {
            for (const uint32_t child : {node.first, node.first + 1})
                expected.extend(Box{after.nodes[child].lower, after.nodes[child].upper});
        }
        ASSERT_EQ(expected, (Box{node.lower, node.upper})) << i;
        changed += node.lower != before.nodes[i].lower || node.upper != before.nodes[i].upper;
    }
    EXPECT_GT(changed, 1000u);
    EXPECT_LT(changed, after.nodes.size() / 2);  // most of the kitchen stands still
    EXPECT_EQ(check_nodes(refitted.levels->list, mesh.triangle_count()), "");
}

/// By hand: two triangles along x change places; the root's box stays, the leaves' boxes change.
TEST(Refit, TwoTrianglesThatChangePlaces) {
    const auto mesh_with = [](float first, float second) {
        Mesh mesh;
        for (const float x : {first, second})
            for (const Vec3& corner : {Vec3(x, 0, 0), Vec3(x + 1, 0, 0), Vec3(x, 1, 0)})
                mesh.positions.push_back(corner);
        mesh.triangles = {UVec3(0, 1, 2), UVec3(3, 4, 5)};
        return mesh;
    };
    Bvh2 bvh;
    bvh.nodes = {{Vec3(0.0f), 1, Vec3(6, 1, 0), 0},
                 {Vec3(0.0f), 0, Vec3(1, 1, 0), 1},
                 {Vec3(5, 0, 0), 1, Vec3(6, 1, 0), 1}};
    bvh.prims = {0, 1};
    Task task;
    const Bvh2 after = Refit{}.apply(mesh_with(5.0f, 0.0f), {}, bvh, task);
    EXPECT_EQ(after.nodes[0], bvh.nodes[0]);
    EXPECT_EQ(after.nodes[1].lower, Vec3(5, 0, 0));
    EXPECT_EQ(after.nodes[1].upper, Vec3(6, 1, 0));
    EXPECT_EQ(after.nodes[2].lower, Vec3(0, 0, 0));
    EXPECT_EQ(after.nodes[2].upper, Vec3(1, 1, 0));
    EXPECT_TRUE(Refit{}.apply(Mesh{}, {}, Bvh2{}, task).nodes.empty());
}

/// Not only the small moves of an animation: every triangle goes to the place of another one.
TEST(Refit, FindsTheSameHitsAsBruteForceHoweverFarTrianglesMoved) {
    const Mesh before = random_triangles(300, 0.1f, 1), after = random_triangles(300, 0.1f, 2);
    Task task;
    const std::vector<Ray> rays = rays_for(after, 1000, 3);
    for (const std::string& builder : refittable()) {
        const Stage stage(*find_entry(builder)), refit(*find_entry("refit"));
        const std::vector<PrimRef> refs = whole_refs(before), refs_after = whole_refs(after);
        const Structure structure =
            refit.method().apply(after, refs_after, stage.method().build(before, refs, task), task);
        const Structure reference = Stage(*find_entry("none")).method().build(after, refs_after, task);
        for (const Mode mode : {Mode::Exact, Mode::Fast}) {
            std::vector<Hit> hits(rays.size()), expected(rays.size());
            structure.closest_hits(after, rays, hits, mode, task);
            reference.closest_hits(after, rays, expected, mode, task);
            EXPECT_EQ(hits, expected) << builder;
        }
    }
}

TEST(Refit, IsTheSameForOneAndManyThreads) {
    const Mesh before = random_triangles(20000, 0.05f, 1), after = random_triangles(20000, 0.05f, 2);
    Task task;
    const Structure built =
        Stage(*find_entry("bvh-binned-sah")).method().build(before, whole_refs(before), task);
    const Bvh2 many = Refit{}.apply(after, {}, *built.as<Bvh2>(), task);
    const ThreadLimit limit(1);
    EXPECT_TRUE(same_bytes(many, Refit{}.apply(after, {}, *built.as<Bvh2>(), task)));
}

}  // namespace
}  // namespace boxwood
