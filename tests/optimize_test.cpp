#include "core/bvh/optimize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "core/bvh/binned_sah.h"
#include "core/bvh/linked_tree.h"
#include "core/bvh/object_median.h"
#include "core/bvh/spatial_splits.h"
#include "core/bvh/sweep_sah.h"
#include "core/measure/tree_stats.h"
#include "core/scene/scene.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

double sah_cost(const Bvh2& bvh) { return tree_stats(make_level_table(bvh.list_nodes())).sah_cost; }

Bvh2 optimized(const Bvh2& input, const Optimize& method = {}) {
    Task task;
    return method.apply(Mesh{}, {}, input, task);
}

/// A leaf of the primitive `prim` with the box [x, x + 1] x [0, 1] x [0, 1].
Bvh2::Node cube_at(float x, uint32_t prim) { return {{x, 0, 0}, prim, {x + 1, 1, 1}, 1}; }
Bvh2::Node inner(float lower, float upper, uint32_t left) { return {{lower, 0, 0}, left, {upper, 1, 1}, 0}; }

/// Cubes at 0, 1, 10, 11 of which those at 1 and 10 stand in each other's places, as far as the two on the
/// right go: ((0, 10), ((1, 11), 20)).
Bvh2 misplaced() {
    Bvh2 bvh;
    bvh.nodes = {inner(0, 21, 1), inner(0, 11, 3), inner(1, 21, 5), cube_at(0, 0), cube_at(10, 1),
                 inner(1, 12, 7), cube_at(20, 2),  cube_at(1, 3),   cube_at(11, 4)};
    bvh.prims = {0, 1, 2, 3, 4};
    return bvh;
}

TEST(LinkedTree, FindsTheBestPlaceComputedByHand) {
    // Half area of a row of length L: 2 L + 1. The cube at 10 (node 4) beside that at 11 (node 8): node 1
    // goes, 23; node 5 stays [1, 12]; the new parent has [10, 12], 5. Beside node 7 it would have [1, 11].
    const LinkedTree tree(misplaced());
    const auto move = tree.best_move(4);
    ASSERT_TRUE(move.has_value());
    EXPECT_EQ(move->to, 8u);
    EXPECT_EQ(move->gain, 23.0 - 5.0);
    // The cube at 1 (node 7) beside that at 0: node 5 goes, 23; node 2 shrinks to [11, 21] from [1, 21],
    // 41 to 21; node 1 stays [0, 11]; the new parent has [0, 2], 5.
    const auto other = tree.best_move(7);
    ASSERT_TRUE(other.has_value());
    EXPECT_EQ(other->to, 3u);
    EXPECT_EQ(other->gain, 23.0 + 20.0 - 5.0);
    EXPECT_EQ(tree.gain(7, 3), other->gain);
    EXPECT_EQ(tree.gain(4, 8), move->gain);
}

TEST(LinkedTree, RefusesWhatIsNoMove) {
    const LinkedTree tree(misplaced());
    EXPECT_FALSE(tree.gain(0, 4).has_value());  // the root
    EXPECT_FALSE(tree.gain(1, 8).has_value());  // a child of the root
    EXPECT_FALSE(tree.gain(5, 7).has_value());  // into itself
    EXPECT_FALSE(tree.gain(7, 8).has_value());  // its sibling
    EXPECT_FALSE(tree.gain(7, 5).has_value());  // its parent
    EXPECT_FALSE(tree.gain(7, 0).has_value());  // above the root
}

TEST(LinkedTree, GainIsWhatTheSumOfAreasFallsBy) {
    Task task;
    const Mesh mesh = random_triangles(40, 0.3f, 1);
    const Bvh2 bvh = ObjectMedian{.max_leaf_size = 1}.build(mesh, whole_refs(mesh), task);
    const auto inner_area = [](const Bvh2& tree) {
        double sum = 0.0;
        for (const Bvh2::Node& node : tree.nodes)
            if (!node.is_leaf()) sum += Box{node.lower, node.upper}.half_area();
        return sum;
    };
    const auto count = static_cast<uint32_t>(bvh.nodes.size());
    int tried = 0;
    for (uint32_t node = 0; node < count; ++node) {
        double best = 0.0;
        for (uint32_t to = 0; to < count; ++to) {
            LinkedTree tree(bvh);
            const auto gain = tree.gain(node, to);
            if (!gain) continue;
            tree.move(node, to);
            const Bvh2 moved = tree.bvh(bvh);
            ASSERT_NEAR(*gain, inner_area(bvh) - inner_area(moved), 1e-9) << node << " to " << to;
            ASSERT_EQ(check_nodes(moved.list_nodes(), mesh.triangle_count()), "");
            // Above an ancestor is a place that the search does not look at.
            bool is_above = false;
            for (uint32_t child = node; child != 0;) {
                uint32_t parent = 0;
                for (uint32_t i = 0; i < count; ++i)
                    if (!bvh.nodes[i].is_leaf() &&
                        (bvh.nodes[i].first == child || bvh.nodes[i].first + 1 == child))
                        parent = i;
                is_above = is_above || parent == to;
                child = parent;
            }
            if (!is_above) best = std::max(best, *gain);
            ++tried;
        }
        const LinkedTree tree(bvh);
        if (!tree.is_movable(node)) continue;
        const auto found = tree.best_move(node);
        ASSERT_NEAR(found ? found->gain : 0.0, best, 1e-9) << node;
    }
    EXPECT_GT(tried, 1000);
}

TEST(Optimize, PutsThingsBackTogether) {
    const Bvh2 best = optimized(misplaced(), {.rounds = 16, .share = 1.0f, .least_gain = 0.0f});
    EXPECT_EQ(check_nodes(best.list_nodes(), 5), "");
    // ((0, 1), ((10, 11), 20)): 43 + 5 + 23 + 5 for inner nodes, 3 for each of five leaves, of 43.
    EXPECT_DOUBLE_EQ(sah_cost(best), (43.0 + 5.0 + 23.0 + 5.0 + 15.0) / 43.0);
}

TEST(Optimize, NeverRaisesTheCost) {
    Task task;
    for (const char* name : {"atrium", "spaceship", "cornell"}) {
        const auto scene = open_scene(name, task);
        const std::vector<PrimRef> refs = whole_refs(scene->mesh);
        const Bvh2 sweep = SweepSah{}.build(scene->mesh, refs, task);
        double last = sah_cost(sweep);
        for (const Optimize& method : {Optimize{.rounds = 1, .share = 0.02f}, Optimize{}}) {
            const double cost = sah_cost(optimized(sweep, method));
            EXPECT_LE(cost, last) << name;
            last = cost;
        }
    }
    const Mesh mesh = random_triangles(2000, 0.05f, 2);
    const Bvh2 median = ObjectMedian{.max_leaf_size = 1}.build(mesh, whole_refs(mesh), task);
    EXPECT_LT(sah_cost(optimized(median)), sah_cost(median));
}

TEST(Optimize, KeepsTheLeavesOfCutTriangles) {
    Task task;
    Mesh mesh = random_triangles(3000, 0.7f, 3);
    for (uint32_t i = 0; i < mesh.triangle_count(); ++i)  // long thin ones: they are cut
        mesh.positions[3 * i + 2] =
            mesh.positions[3 * i] + 0.01f * (mesh.positions[3 * i + 2] - mesh.positions[3 * i]);
    const Bvh2 split = SpatialSplits{.max_leaf_size = 2}.build(mesh, whole_refs(mesh), task);
    ASSERT_GT(split.prims.size(), mesh.triangle_count() + 20);
    const Bvh2 best = optimized(split);
    EXPECT_EQ(check_nodes(best.list_nodes(), mesh.triangle_count()), "");
    EXPECT_LT(sah_cost(best), sah_cost(split));
    const auto leaves = [](const Bvh2& bvh) {
        std::vector<std::vector<float>> list;
        for (const Bvh2::Node& node : bvh.nodes) {
            if (!node.is_leaf()) continue;
            std::vector<float> leaf = {node.lower.x, node.lower.y, node.lower.z,
                                       node.upper.x, node.upper.y, node.upper.z};
            for (uint32_t i = 0; i < node.count; ++i)
                leaf.push_back(static_cast<float>(bvh.prims[node.first + i]));
            list.push_back(leaf);
        }
        std::ranges::sort(list);
        return list;
    };
    EXPECT_EQ(leaves(best), leaves(split));
}

/// A tree as deep as may be: each inner node has a leaf on the left.
Bvh2 chain(uint32_t levels) {
    Bvh2 bvh;
    bvh.nodes.resize(1);
    uint32_t node = 0;
    for (uint32_t i = 0; i <= levels; ++i) {
        // Leaves at places that have nothing to do with the tree, so that much is to be moved.
        const Bvh2::Node leaf = cube_at(static_cast<float>(i * 37 % 64), i);
        bvh.prims.push_back(i);
        if (i == levels) {
            bvh.nodes[node] = leaf;
            break;
        }
        bvh.nodes[node].first = static_cast<uint32_t>(bvh.nodes.size());
        bvh.nodes[node].count = 0;
        bvh.nodes.push_back(leaf);
        bvh.nodes.push_back({});
        node = static_cast<uint32_t>(bvh.nodes.size()) - 1;
    }
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        Bvh2::Node& inner_node = bvh.nodes[i];
        if (inner_node.is_leaf()) continue;
        const Bvh2::Node &left = bvh.nodes[inner_node.first], &right = bvh.nodes[inner_node.first + 1];
        inner_node.lower = glm::min(left.lower, right.lower);
        inner_node.upper = glm::max(left.upper, right.upper);
    }
    return bvh;
}

TEST(Optimize, StaysWithinTheDepthOfATree) {
    const Bvh2 deep = chain(Bvh2::kMaxDepth);
    ASSERT_EQ(make_level_table(deep.list_nodes()).level_count(), 65u);
    const Bvh2 best = optimized(deep, {.rounds = 16, .share = 1.0f, .least_gain = 0.0f});
    const LevelTable table = make_level_table(best.list_nodes());
    EXPECT_LE(table.level_count(), 65u);
    EXPECT_EQ(check_nodes(table.list, 65), "");
    EXPECT_LT(sah_cost(best), 0.7 * sah_cost(deep));
    // A pair beside a chain whose deepest leaf is at the limit: one of the pair cannot go there, but can go
    // beside the leaf above it.
    Bvh2 beside = chain(Bvh2::kMaxDepth - 1);
    const auto count = static_cast<uint32_t>(beside.nodes.size());
    for (Bvh2::Node& node : beside.nodes)
        if (!node.is_leaf()) node.first += 4;
    beside.nodes.insert(beside.nodes.begin() + 1, {cube_at(0, 0), cube_at(0, 0)});
    beside.nodes.insert(beside.nodes.begin(), {inner(0, 65, 1), inner(0, 1, 3)});
    EXPECT_EQ(make_level_table(beside.list_nodes()).level_count(), 65u);
    const LinkedTree tree(beside);
    EXPECT_FALSE(tree.gain(3, count + 3).has_value());
    EXPECT_FALSE(tree.gain(3, count + 2).has_value());
    EXPECT_TRUE(tree.gain(3, count).has_value());
}

TEST(Optimize, IsTheSameForAnyNumberOfThreads) {
    Task task;
    const Mesh mesh = random_triangles(20000, 0.2f, 4);
    const Bvh2 input = BinnedSah{}.build(mesh, whole_refs(mesh), task);
    const Bvh2 many = optimized(input);
    const ThreadLimit limit(1);
    const Bvh2 one = optimized(input);
    EXPECT_EQ(many.nodes, one.nodes);
    EXPECT_EQ(many.prims, one.prims);
}

TEST(Optimize, TakesTreesWithNothingToMove) {
    EXPECT_TRUE(optimized(Bvh2{}).nodes.empty());
    Bvh2 leaf;
    leaf.nodes = {cube_at(0, 0)};
    leaf.prims = {0};
    EXPECT_EQ(optimized(leaf).nodes, leaf.nodes);
    Bvh2 pair;
    pair.nodes = {inner(0, 2, 1), cube_at(0, 0), cube_at(1, 1)};
    pair.prims = {0, 1};
    EXPECT_EQ(optimized(pair).nodes, pair.nodes);
}

}  // namespace
}  // namespace boxwood
