#include "core/kdtree/kd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/kdtree/kd_build.h"
#include "core/kdtree/kd_median.h"
#include "core/kdtree/kd_sah.h"
#include "oracle/polygon.h"
#include "support/all_recipes.h"
#include "support/lattice.h"
#include "support/random_mesh.h"
#include "support/shared_scene.h"

namespace boxwood {
namespace {

/// Every point of a triangle lies in a leaf that holds it, and every leaf that holds it touches it.
void expect_exact_references(const std::string& recipe, const Mesh& mesh) {
    const NodeList list = run(recipe, mesh).structure.list_nodes();
    std::vector<std::vector<Box>> cells(mesh.triangle_count());
    for (const NodeView& node : list.nodes) {
        for (uint32_t i = 0; i < node.ref_count; ++i) {
            const uint32_t prim = list.ref_prims[node.first_ref + i];
            ASSERT_TRUE(oracle::touches(mesh.triangle(prim), node.bounds)) << recipe << ": superfluous";
            cells[prim].push_back(node.bounds);
        }
    }
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
        ASSERT_TRUE(oracle::covers(cells[prim], mesh.triangle(prim))) << recipe << ": missed";
}

TEST(KdTree, LeavesHoldTheTrianglesThatTouchThemAndMissNone) {
    Mesh far = random_triangles(12, 0.3f, 4);
    for (Vec3& position : far.positions) position += Vec3(1e6f, -1e6f, 1e5f);
    for (const Mesh& mesh : {random_triangles(15, 0.5f, 3), lattice_mesh(20, 4), far}) {
        for (const char* references : {"whole", "esc(s=4)", "evh(t=6)"}) {
            for (const char* builder : {"kd-sah(traversal-cost=0.1)", "kd-median(leaf-size=1)",
                                        "kd-median(leaf-size=1, middle=references)"})
                expect_exact_references(std::string(references) + " > " + builder, mesh);
        }
    }
}

TEST(KdTree, FindsTheSameHitsAsBruteForceThroughWallsEdgesAndCornersOfCells) {
    Task task;
    const Mesh mesh = lattice_mesh(100, 5);
    const std::vector<Ray> rays = lattice_rays(1500, 6);
    const Structure reference = run("none", mesh).structure;
    for (const char* recipe : {"kd-sah", "kd-sah(traversal-cost=0)", "kd-median(leaf-size=1)"}) {
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

TEST(KdTree, VisitsTheCellsThatTheRayMeets) {
    const Mesh mesh = random_triangles(60, 0.05f, 7);
    Task task;
    const Structure structure(KdSah{}.build(mesh, whole_refs(mesh), task));
    const NodeList list = structure.list_nodes();
    ASSERT_GT(list.nodes.size(), 60u);
    size_t checked = 0;
    for (const Ray& ray : rays_for(mesh, 300, 8)) {
        Hit hit;
        structure.closest_hits(mesh, {&ray, 1}, {&hit, 1}, Mode::Exact, task);
        if (hit.is_hit()) continue;
        std::vector<uint32_t> visits(list.nodes.size(), 0);
        structure.add_visits(mesh, {&ray, 1}, visits, Mode::Exact, task);
        const RaySlabs slabs(ray);
        for (size_t i = 1; i < list.nodes.size(); ++i) {
            double entry;
            const bool meets = slabs.meets(list.nodes[i].bounds.lower, list.nodes[i].bounds.upper,
                                           std::numeric_limits<double>::infinity(), entry);
            ASSERT_EQ(visits[i] != 0, meets);
            ++checked;
        }
    }
    EXPECT_GT(checked, 1000u);
}

/// The planes of a finished tree, by cell.
class PlanesOf {
public:
    explicit PlanesOf(const KdTree& tree) {
        const NodeList list = tree.list_nodes();
        for (size_t i = 0; i < list.nodes.size(); ++i)
            if (list.nodes[i].kind == NodeKind::Inner)
                splits_[key(list.nodes[i].bounds)] = {tree.nodes[i].axis(), tree.nodes[i].plane(), true};
    }
    std::optional<KdSplit> operator()(std::span<const PrimRef>, const Box& cell) const {
        const auto found = splits_.find(key(cell));
        return found == splits_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    static std::array<float, 6> key(const Box& b) {
        return {b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z};
    }
    std::map<std::array<float, 6>, KdSplit> splits_;
};

/// References of the tree with the given planes.
size_t reference_count(const Mesh& mesh, const std::vector<PrimRef>& refs, const KdTree& planes, bool clip) {
    const KdLimits limits{.clip = clip, .leaf_size = 0, .max_depth = 64, .budget = 1000};
    Task task;
    return build_kd_tree(mesh, refs, limits, PlanesOf(planes), task).prims.size();
}

TEST(KdTree, ForTheSamePlanesClippingAddsNoReferences) {
    Task task;
    for (const Mesh& mesh : {random_triangles(300, 0.5f, 9), lattice_mesh(200, 10)}) {
        const std::vector<PrimRef> refs = whole_refs(mesh);
        for (const bool clip : {false, true}) {
            const KdTree planes = KdMedian{.clip = clip, .leaf_size = 1}.build(mesh, refs, task);
            const size_t clipped = reference_count(mesh, refs, planes, true);
            const size_t unclipped = reference_count(mesh, refs, planes, false);
            EXPECT_LT(clipped, unclipped);
        }
    }
}

TEST(KdTree, ForTheSamePlanesClippingAddsNoReferencesOnRealScenes) {
    Task task;
    size_t scene_count = 0;
    for (const char* name : {"cad_housing_coarse.glb", "trusses.glb"}) {
        const std::optional<Scene> scene = shared_scene(name);
        if (!scene) continue;
        ++scene_count;
        const std::vector<PrimRef> refs = whole_refs(scene->mesh);
        for (const bool clip : {false, true}) {
            const KdTree planes = KdSah{.clip = clip}.build(scene->mesh, refs, task);
            EXPECT_LT(reference_count(scene->mesh, refs, planes, true),
                      reference_count(scene->mesh, refs, planes, false))
                << name;
        }
    }
    if (scene_count == 0) GTEST_SKIP() << "no real scenes beside the sources";
}

TEST(KdMedian, SplitsInTheMiddleOfTheCellOrOfTheReferences) {
    // Middles along x: 0.5, 1.5, 2.5, 9.5 in a cell of 10 x 1 x 1.
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 1.0f, 2.0f, 9.0f})
        triangles.push_back({{x, 0, 0}, {x + 1, 0, 1}, {x + 0.5f, 1, 0.5f}});
    const Mesh mesh = make_mesh(triangles);
    Task task;
    const auto root = [&](int middle) {
        const KdMedian params{.middle = middle, .leaf_size = 1, .max_depth = 1};
        return params.build(mesh, whole_refs(mesh), task);
    };
    EXPECT_EQ(root(0).nodes[0], KdTree::Node::inner(0, 5.0f, 2));
    EXPECT_EQ(root(0).nodes[1], KdTree::Node::leaf(0, 3));
    EXPECT_EQ(root(1).nodes[0], KdTree::Node::inner(0, 2.5f, 2));
    EXPECT_EQ(root(1).nodes[1], KdTree::Node::leaf(0, 3));
    EXPECT_EQ(root(1).nodes[2], KdTree::Node::leaf(3, 2));
}

TEST(KdMedian, TakesAnotherAxisWhereThePlaneCutsEverything) {
    // Long along x, apart along y only.
    std::vector<Triangle> triangles;
    for (const float y : {0.0f, 2.0f}) triangles.push_back({{0, y, 0}, {10, y, 1}, {10, y + 1, 1}});
    const Mesh mesh = make_mesh(triangles);
    Task task;
    const KdTree tree = KdMedian{.leaf_size = 1, .max_depth = 1}.build(mesh, whole_refs(mesh), task);
    EXPECT_EQ(tree.nodes[0], KdTree::Node::inner(1, 1.5f, 2));
}

TEST(RefBudget, SharesOutAllOfItByReferences) {
    const RefBudget budget{100};
    EXPECT_TRUE(budget.allows(60, 40));
    EXPECT_FALSE(budget.allows(61, 40));
    EXPECT_EQ(budget.left_share(10, 30).refs, 25u);
    EXPECT_EQ(budget.left_share(0, 30).refs, 0u);
    EXPECT_EQ(budget.left_share(100, 0).refs, 100u);
    EXPECT_EQ((RefBudget{uint64_t{1} << 36}).left_share(1u << 30, 1u << 30).refs, uint64_t{1} << 35);
}

TEST(KdLimits, DepthIsBounded) {
    EXPECT_EQ(KdLimits{}.depth_for(1), 8u);
    EXPECT_EQ(KdLimits{}.depth_for(1024), 21u);
    EXPECT_EQ((KdLimits{.max_depth = 64}).depth_for(1), 64u);
    EXPECT_LE(KdLimits{}.depth_for(size_t{1} << 31), KdTree::kMaxDepth);
}

}  // namespace
}  // namespace boxwood
