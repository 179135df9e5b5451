#include "core/wide_bvh/wide_bvh.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/parallel.h"
#include "core/wide_bvh/collapse.h"
#include "support/all_recipes.h"
#include "support/hand_made_bvh.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

template <uint32_t Width>
WideBvh<Width> collapse(const Mesh& mesh, const Bvh2& bvh, Collapse<Width> method = {}) {
    Task task;
    return method.apply(mesh, {}, bvh, task);
}

Bvh2 built_bvh(const Mesh& mesh, const std::string& recipe) {
    return *run(recipe, mesh).structure.as<Bvh2>();
}

/// Triangle i spans [i, i + 1/2] along x, and [0, 1] along y at z = 0.
Mesh row_of_triangles(uint32_t count) {
    Mesh mesh = random_triangles(count, 0.1f, 1);
    for (uint32_t i = 0; i < count; ++i) {
        const auto x = static_cast<float>(i);
        mesh.positions[3 * i] = Vec3(x, 0.0f, 0.0f);
        mesh.positions[3 * i + 1] = Vec3(x + 0.5f, 0.0f, 0.0f);
        mesh.positions[3 * i + 2] = Vec3(x, 1.0f, 0.0f);
    }
    return mesh;
}

HandMadeNode leaf_of(const Mesh& mesh, uint32_t prim) { return {mesh.triangle(prim).bounds(), {prim}, {}}; }

HandMadeNode joined(HandMadeNode left, HandMadeNode right) {
    Box box = left.box;
    box.extend(right.box);
    return {box, {}, {std::move(left), std::move(right)}};
}

/// Each split parts off one triangle: as deep as it has triangles.
Bvh2 chain(const Mesh& mesh) {
    HandMadeNode root = leaf_of(mesh, 0);
    for (uint32_t i = 1; i < mesh.triangle_count(); ++i) root = joined(leaf_of(mesh, i), std::move(root));
    return hand_made_bvh(root);
}

template <uint32_t Width>
void expect_hits_of_brute_force(const WideBvh<Width>& wide, const Mesh& mesh) {
    Task task;
    const Structure structure(wide), reference = run("none", mesh).structure;
    const std::vector<Ray> rays = rays_for(mesh, 500, 3);
    std::vector<Hit> hits(rays.size()), expected(rays.size());
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        structure.closest_hits(mesh, rays, hits, mode, task);
        reference.closest_hits(mesh, rays, expected, mode, task);
        EXPECT_EQ(hits, expected);
    }
}

TEST(WideBvh, AnEmptyMeshHasNoNodeAndOneTriangleHasARootWithOneLeaf) {
    EXPECT_TRUE(collapse<8>(Mesh{}, Bvh2{}).nodes.empty());
    const Mesh mesh = row_of_triangles(1);
    const WideBvh<8> wide = collapse<8>(mesh, hand_made_bvh(leaf_of(mesh, 0)));
    ASSERT_EQ(wide.nodes.size(), 1u);
    EXPECT_EQ(wide.nodes[0].children[0], WideChild::leaf(0, 1));
    EXPECT_TRUE(wide.nodes[0].children[1].is_empty());
    EXPECT_EQ(check_nodes(wide.list_nodes(), 1), "");
    expect_hits_of_brute_force(wide, mesh);
}

TEST(WideBvh, LanesWithoutATriangleRepeatTheLastOne) {
    const Mesh mesh = random_triangles(301, 0.1f, 2);
    const WideBvh<4> wide = collapse<4>(mesh, built_bvh(mesh, "bvh-sweep-sah"));
    std::multiset<uint32_t> found;
    for (const auto& pack : wide.packs) {
        for (uint32_t lane = 0; lane < pack.kSize; ++lane) {
            const Triangle expected = mesh.triangle(pack.prims[lane]), triangle = pack.triangle(lane);
            EXPECT_TRUE(triangle.a == expected.a && triangle.b == expected.b && triangle.c == expected.c);
            EXPECT_EQ(pack.prims[lane], pack.prims[std::min(lane, pack.count() - 1)]);
        }
        found.insert(pack.prims, pack.prims + pack.count());
    }
    EXPECT_EQ(found.size(), mesh.triangle_count());
    EXPECT_EQ(std::set<uint32_t>(found.begin(), found.end()).size(), mesh.triangle_count());
}

template <uint32_t Width>
void check_order(const typename WideBvh<Width>::Node& node) {
    for (uint32_t octant = 0; octant < 4; ++octant) {
        std::set<uint32_t> lanes;
        bool was_empty = false;
        for (uint32_t rank = 0; rank < Width; ++rank) {
            const uint32_t lane = node.lane_at(octant, rank);
            EXPECT_EQ(node.lane_at(7 - octant, Width - 1 - rank), lane);
            lanes.insert(lane);
            EXPECT_FALSE(was_empty && !node.children[lane].is_empty());
            was_empty = node.children[lane].is_empty();
        }
        EXPECT_EQ(lanes.size(), Width);
    }
}

TEST(WideBvh, EveryOctantHasAllLanesTheEmptyOnesLastAndTheOppositeOneTheReverse) {
    const Mesh mesh = random_triangles(500, 0.3f, 4);
    const Bvh2 bvh = built_bvh(mesh, "bvh-sweep-sah");
    for (const auto& node : collapse<4>(mesh, bvh).nodes) check_order<4>(node);
    for (const auto& node : collapse<8>(mesh, bvh).nodes) check_order<8>(node);
    for (const auto& node : collapse<16>(mesh, bvh).nodes) check_order<16>(node);
}

template <uint32_t Width>
void expect_row_front_to_back() {
    const Mesh mesh = row_of_triangles(Width);
    HandMadeNode root = leaf_of(mesh, 0);
    for (uint32_t i = 1; i < Width; ++i)  // not in the order of the row
        root = joined(leaf_of(mesh, i * (Width / 2 - 1) % Width), std::move(root));
    Collapse<Width> method;
    method.leaf_size = 1;
    const WideBvh<Width> wide = collapse<Width>(mesh, hand_made_bvh(root), method);
    ASSERT_EQ(wide.nodes.size(), 1u);
    for (uint32_t octant = 0; octant < 8; ++octant) {
        for (uint32_t rank = 0; rank < Width; ++rank) {
            const float place = wide.nodes[0].lower[0][wide.nodes[0].lane_at(octant, rank)];
            EXPECT_EQ(place, static_cast<float>((octant & 1u) != 0 ? Width - 1 - rank : rank));
        }
    }
}

/// In a row along x the order is that of x or its reverse, by the sign along x alone. The row's boxes are
/// flat in z, and all equal in y.
TEST(WideBvh, SeparatedChildrenStandFrontToBackInEveryOctant) {
    expect_row_front_to_back<4>();
    expect_row_front_to_back<8>();
    expect_row_front_to_back<16>();
}

/// A ray along +x through the row hits the nearest triangle first: one leaf is tested, but every box of the
/// node counts as a visit; leaves count behind the nodes.
TEST(WideBvh, CountsEveryChildOfAVisitedNodeUnderItsNumber) {
    const Mesh mesh = row_of_triangles(4);
    const HandMadeNode root =
        joined(joined(leaf_of(mesh, 3), leaf_of(mesh, 1)), joined(leaf_of(mesh, 2), leaf_of(mesh, 0)));
    Collapse<4> method;
    method.leaf_size = 1;
    const WideBvh<4> wide = collapse<4>(mesh, hand_made_bvh(root), method);
    ASSERT_EQ(wide.nodes.size(), 1u);
    Ray ray;
    ray.origin = Vec3(-1.0f, 0.25f, -0.01f);
    ray.direction = Vec3(1.0f, 0.0f, 0.009f);
    Count count;
    ClosestHit<Mode::Exact> closest(ray);
    wide.closest_hit(mesh, closest, count);
    EXPECT_EQ(closest.hit(mesh).prim, 0u);
    EXPECT_EQ(count.nodes, 5u);
    EXPECT_EQ(count.tests, 1u);
    std::vector<uint32_t> visits(5, 0);
    NodeVisits node_visits{visits};
    ClosestHit<Mode::Exact> again(ray);
    wide.closest_hit(mesh, again, node_visits);
    EXPECT_EQ(visits, (std::vector<uint32_t>{1, 1, 1, 1, 1}));
}

TEST(WideBvh, ListsLeavesBehindTheNodesWithTheirBoxes) {
    const Mesh mesh = random_triangles(400, 0.1f, 5);
    const WideBvh<8> wide = collapse<8>(mesh, built_bvh(mesh, "bvh-sweep-sah"));
    const NodeList list = wide.list_nodes();
    ASSERT_EQ(list.nodes.size(), wide.nodes.size() + wide.leaf_count);
    EXPECT_EQ(check_nodes(list, mesh.triangle_count()), "");
    for (size_t i = 0; i < list.nodes.size(); ++i) {
        EXPECT_EQ(list.nodes[i].kind == NodeKind::Leaf, i >= wide.nodes.size());
        Box content;
        for (uint32_t r = 0; r < list.nodes[i].ref_count; ++r)
            content.extend(mesh.triangle(list.ref_prims[list.nodes[i].first_ref + r]).bounds());
        if (list.nodes[i].kind == NodeKind::Inner) continue;
        EXPECT_EQ(list.nodes[i].bounds, content) << "node " << i;
    }
}

/// Greedy collapse of a chain whose boxes do not shrink makes the deepest tree; rays through all of it fill
/// the stack.
TEST(WideBvh, TracesTheDeepestTree) {
    Mesh mesh = random_triangles(Bvh2::kMaxDepth + 1, 0.5f, 6);
    const Bvh2 bvh = chain(mesh);
    Collapse<4> greedy;
    greedy.way = Collapse<4>::Greedy;
    greedy.leaf_size = 1;
    const WideBvh<4> wide = collapse<4>(mesh, bvh, greedy);
    EXPECT_EQ(check_nodes(wide.list_nodes(), mesh.triangle_count()), "");
    EXPECT_GT(make_level_table(wide.list_nodes()).level_count(), 20u);
    expect_hits_of_brute_force(wide, mesh);
    expect_hits_of_brute_force(collapse<8>(mesh, bvh), mesh);
    expect_hits_of_brute_force(collapse<16>(mesh, bvh), mesh);
}

TEST(WideBvh, LeavesOfMoreThan31PacksBecomeSeveralWithTheSameBox) {
    const Mesh mesh = random_triangles(1000, 0.5f, 7);
    HandMadeNode root{{}, {}, {}};
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        root.prims.push_back(i);
        root.box.extend(mesh.triangle(i).bounds());
    }
    const WideBvh<4> wide = collapse<4>(mesh, hand_made_bvh(root));
    const NodeList list = wide.list_nodes();
    EXPECT_EQ(check_nodes(list, mesh.triangle_count()), "");
    EXPECT_GE(wide.leaf_count, 9u);
    for (const NodeView& node : list.nodes) EXPECT_EQ(node.bounds, root.box);
    expect_hits_of_brute_force(wide, mesh);
}

template <uint32_t Width>
void expect_same(const WideBvh<Width>& a, const WideBvh<Width>& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    ASSERT_EQ(a.packs.size(), b.packs.size());
    EXPECT_EQ(a.leaf_count, b.leaf_count);
    for (size_t i = 0; i < a.nodes.size(); ++i) {
        const auto children_of = [](const auto& node) {
            return std::vector(node.children, node.children + Width);
        };
        EXPECT_EQ(children_of(a.nodes[i]), children_of(b.nodes[i]));
        EXPECT_EQ(a.nodes[i].orders, b.nodes[i].orders);
        EXPECT_EQ(a.nodes[i].first_leaf, b.nodes[i].first_leaf);
    }
    for (size_t i = 0; i < a.packs.size(); ++i)
        EXPECT_TRUE(std::ranges::equal(a.packs[i].prims, b.packs[i].prims));
}

TEST(WideBvh, IsTheSameForOneAndManyThreads) {
    const Mesh mesh = random_triangles(5000, 0.1f, 8);
    const Bvh2 bvh = built_bvh(mesh, "evh(t=10) > bvh-binned-sah");
    const WideBvh<4> four = collapse<4>(mesh, bvh);
    const WideBvh<8> eight = collapse<8>(mesh, bvh);
    const WideBvh<16> sixteen = collapse<16>(mesh, bvh);
    const ThreadLimit limit(1);
    expect_same(collapse<4>(mesh, bvh), four);
    expect_same(collapse<8>(mesh, bvh), eight);
    expect_same(collapse<16>(mesh, bvh), sixteen);
}

}  // namespace
}  // namespace boxwood
