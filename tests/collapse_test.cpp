#include "core/wide_bvh/collapse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/base/rng.h"
#include "core/structure/sah.h"
#include "support/all_recipes.h"
#include "support/hand_made_bvh.h"
#include "support/random_mesh.h"
#include "support/shared_scene.h"

namespace boxwood {
namespace {

template <uint32_t Width>
WideBvh<Width> collapse(const Mesh& mesh, const Bvh2& bvh, const Collapse<Width>& method) {
    Task task;
    return method.apply(mesh, {}, bvh, task);
}

template <uint32_t Width>
WideCosts costs_of(const Collapse<Width>& method) {
    return {static_cast<double>(method.node_cost), static_cast<double>(method.pack_cost)};
}

/// Flat, so that half its area is its length: 16 is the root's.
Box along_x(float begin, float end) { return {Vec3(begin, 0.0f, 0.0f), Vec3(end, 1.0f, 0.0f)}; }

/// A leaf with primitives first to first + count - 1.
HandMadeNode leaf(float begin, float end, uint32_t first, uint32_t count) {
    HandMadeNode node{along_x(begin, end), {}, {}};
    for (uint32_t i = 0; i < count; ++i) node.prims.push_back(first + i);
    return node;
}

/// Children from which greedy collapse goes astray: [0, 9) opens first, and then its part [0, 8.5); what is
/// left for [8, 16) is to be a node of its own. Six leaves of four triangles, each of length 1.
Bvh2 astray() {
    const HandMadeNode low{along_x(0, 8), {}, {leaf(0, 1, 0, 4), leaf(7, 8, 4, 4)}};
    const HandMadeNode middle{along_x(0, 8.5f), {}, {low, leaf(7.5f, 8.5f, 8, 4)}};
    const HandMadeNode left{along_x(0, 9), {}, {middle, leaf(8, 9, 12, 4)}};
    const HandMadeNode right{along_x(8, 16), {}, {leaf(8, 9, 16, 4), leaf(15, 16, 20, 4)}};
    return hand_made_bvh({along_x(0, 16), {}, {left, right}});
}

TEST(Collapse, GreedyOpensTheLargestChildAndOptimalFindsTheLeastCost) {
    const Mesh mesh = random_triangles(24, 0.1f, 1);
    Collapse<4> method;
    method.way = Collapse<4>::Greedy;
    const WideBvh<4> greedy = collapse<4>(mesh, astray(), method);
    // The root, nodes of length 8 and 8, six leaves of length 1.
    EXPECT_EQ(wide_cost(greedy, WideCosts{}), 1.0 + 8.0 / 16.0 + 8.0 / 16.0 + 6.0 / 16.0);
    method.way = Collapse<4>::Optimal;
    const WideBvh<4> optimal = collapse<4>(mesh, astray(), method);
    // The root, one node of length 8.5, six leaves of length 1.
    EXPECT_EQ(wide_cost(optimal, WideCosts{}), 1.0 + 8.5 / 16.0 + 6.0 / 16.0);
    EXPECT_EQ(optimal.nodes.size(), 2u);
}

TEST(Collapse, MergesASubtreeIntoOneLeafWherePacksCostLess) {
    const Mesh mesh = random_triangles(24, 0.1f, 1);
    const HandMadeNode pair{along_x(0, 8), {}, {leaf(0, 6, 0, 2), leaf(2, 8, 2, 2)}};
    const HandMadeNode root{along_x(0, 16), {}, {pair, leaf(8, 16, 4, 4)}};
    Collapse<4> method;
    const WideBvh<4> merged = collapse<4>(mesh, hand_made_bvh(root), method);
    EXPECT_EQ(merged.leaf_count, 2u);
    EXPECT_EQ(wide_cost(merged, WideCosts{}), 1.0 + 8.0 / 16.0 + 8.0 / 16.0);
    method.leaf_size = 3;
    const WideBvh<4> apart = collapse<4>(mesh, hand_made_bvh(root), method);
    EXPECT_EQ(apart.leaf_count, 3u);
    EXPECT_EQ(wide_cost(apart, WideCosts{}), 1.0 + 6.0 / 16.0 + 6.0 / 16.0 + 8.0 / 16.0);
}

TEST(Collapse, AMergedLeafHoldsAPrimitiveOfSeveralReferencesOnce) {
    const Mesh mesh = random_triangles(4, 0.1f, 1);
    const HandMadeNode root{along_x(0, 16), {}, {leaf(0, 10, 0, 4), leaf(6, 16, 0, 4)}};
    const WideBvh<8> wide = collapse<8>(mesh, hand_made_bvh(root), {});
    EXPECT_EQ(wide.leaf_count, 1u);
    EXPECT_EQ(wide.list_nodes().ref_prims, (std::vector<uint32_t>{0, 1, 2, 3}));
}

/// Every way to cut the subtree of a node into subtrees.
std::vector<std::vector<uint32_t>> cuts_of(const Bvh2& bvh, uint32_t node) {
    std::vector<std::vector<uint32_t>> cuts{{node}};
    if (bvh.nodes[node].is_leaf()) return cuts;
    const uint32_t left = bvh.nodes[node].first;
    for (const std::vector<uint32_t>& l : cuts_of(bvh, left)) {
        for (const std::vector<uint32_t>& r : cuts_of(bvh, left + 1)) {
            cuts.push_back(l);
            cuts.back().insert(cuts.back().end(), r.begin(), r.end());
        }
    }
    return cuts;
}

std::set<uint32_t> prims_below(const Bvh2& bvh, uint32_t node) {
    const Bvh2::Node& n = bvh.nodes[node];
    if (n.is_leaf()) return {bvh.prims.begin() + n.first, bvh.prims.begin() + n.first + n.count};
    std::set<uint32_t> prims = prims_below(bvh, n.first), right = prims_below(bvh, n.first + 1);
    prims.insert(right.begin(), right.end());
    return prims;
}

/// The least cost of all wide hierarchies, by trying every one of them.
template <uint32_t Width>
class BruteForce {
public:
    BruteForce(const Bvh2& bvh, const Collapse<Width>& method) : bvh_(bvh), method_(method) {}

    double least() const { return costs_of(method_).node + std::min(as_leaf(0), children(0)); }

private:
    double children(uint32_t node) const {
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<uint32_t>& cut : cuts_of(bvh_, node)) {
            if (cut.size() > Width || (cut.size() == 1 && !bvh_.nodes[node].is_leaf())) continue;
            double sum = 0.0;
            for (const uint32_t part : cut) sum += as_child(part);
            least = std::min(least, sum);
        }
        return least;
    }
    double as_child(uint32_t node) const {
        const double leaf = as_leaf(node);
        if (bvh_.nodes[node].is_leaf()) return leaf;
        return std::min(leaf, probability(node) * costs_of(method_).node + children(node));
    }
    double as_leaf(uint32_t node) const {
        const size_t count = prims_below(bvh_, node).size();
        if (!bvh_.nodes[node].is_leaf() && count > static_cast<size_t>(method_.leaf_size))
            return std::numeric_limits<double>::infinity();
        return probability(node) * WideBvh<Width>::Pack::packs_for(static_cast<uint32_t>(count)) *
               costs_of(method_).pack;
    }
    double probability(uint32_t node) const {
        const auto area = [&](uint32_t n) {
            return Box{bvh_.nodes[n].lower, bvh_.nodes[n].upper}.half_area();
        };
        return hit_probability(area(node), area(0));
    }

    const Bvh2& bvh_;
    const Collapse<Width>& method_;
};

/// A tree of any shape over leaves with 1 to 6 of the primitives, some in several leaves.
HandMadeNode random_tree(Rng& rng, uint32_t leaf_count, uint32_t prim_count) {
    if (leaf_count == 1) {
        HandMadeNode node{{}, {}, {}};
        for (int corner = 0; corner < 2; ++corner) node.box.extend(random_point(rng, 1.0f));
        const size_t count = 1 + rng.next_index(6);
        std::set<uint32_t> prims;
        while (prims.size() < count) prims.insert(static_cast<uint32_t>(rng.next_index(prim_count)));
        node.prims.assign(prims.begin(), prims.end());
        return node;
    }
    const auto left_count = static_cast<uint32_t>(1 + rng.next_index(leaf_count - 1));
    HandMadeNode left = random_tree(rng, left_count, prim_count);
    HandMadeNode right = random_tree(rng, leaf_count - left_count, prim_count);
    Box box = left.box;
    box.extend(right.box);
    return {box, {}, {std::move(left), std::move(right)}};
}

template <uint32_t Width>
void expect_least_of_all(uint32_t most_leaves, uint64_t seed) {
    Rng rng(seed);
    const Mesh mesh = random_triangles(1000, 0.1f, 1);
    for (int i = 0; i < 60; ++i) {
        const auto leaf_count = static_cast<uint32_t>(1 + rng.next_index(most_leaves));
        const uint32_t prim_count = i % 2 == 0 ? 12 : 1000;  // many in several leaves, or few
        const Bvh2 bvh = hand_made_bvh(random_tree(rng, leaf_count, prim_count));
        Collapse<Width> method;
        method.leaf_size = static_cast<int>(1 + rng.next_index(24));
        method.node_cost = rng.next(0.0f, 2.0f);
        method.pack_cost = rng.next(0.0f, 2.0f);
        const double cost = wide_cost(collapse<Width>(mesh, bvh, method), costs_of(method));
        const double expected = BruteForce<Width>(bvh, method).least();
        EXPECT_NEAR(cost, expected, 1e-12 * expected) << "tree " << i;
    }
}

TEST(Collapse, OptimalIsTheLeastOfAllChoices) {
    expect_least_of_all<4>(8, 1);
    expect_least_of_all<8>(10, 2);
    expect_least_of_all<16>(10, 3);
}

template <uint32_t Width>
void expect_at_most_greedy(const std::string& name, const Mesh& mesh, const Bvh2& bvh) {
    Collapse<Width> method;
    const double optimal = wide_cost(collapse<Width>(mesh, bvh, method), costs_of(method));
    method.way = Collapse<Width>::Greedy;
    const double greedy = wide_cost(collapse<Width>(mesh, bvh, method), costs_of(method));
    EXPECT_LE(optimal, greedy * (1.0 + 1e-12)) << name << ", " << Width;
}

void expect_at_most_greedy(const std::string& name, const Mesh& mesh) {
    for (const char* recipe : {"bvh-binned-sah", "evh(t=10) > bvh-binned-sah(max-leaf-size=1)"}) {
        const Structure binary = run(recipe, mesh).structure;
        expect_at_most_greedy<4>(name, mesh, *binary.as<Bvh2>());
        expect_at_most_greedy<8>(name, mesh, *binary.as<Bvh2>());
        expect_at_most_greedy<16>(name, mesh, *binary.as<Bvh2>());
    }
}

TEST(Collapse, OptimalCostsAtMostAsMuchAsGreedyOnBuiltInScenes) {
    Task task;
    for (const char* name : {"two-triangles", "cornell", "mirror-low"})
        expect_at_most_greedy(name, open_scene(name, task)->mesh);
}

TEST(Collapse, OptimalCostsAtMostAsMuchAsGreedyOnRealScenes) {
    for (const char* name : {"bunny.obj"}) {
        const std::optional<Scene> scene = shared_scene(name);
        if (!scene) GTEST_SKIP() << "no folder of real scenes beside the sources";
        expect_at_most_greedy(name, scene->mesh);
    }
}

/// Exactly what the paper's trees of pieces need: a leaf that holds the primitive and contains the piece.
TEST(Collapse, EveryReferenceLiesInALeafThatHoldsItsPrimitive) {
    const Mesh mesh = random_triangles(300, 0.5f, 9);
    for (const char* maker : {"whole", "evh(t=12)", "esc(s=8)"}) {
        const Built built = run(std::string(maker) + " > bvh-sweep-sah(max-leaf-size=2) > wide8", mesh);
        const NodeList& list = built.levels->list;
        EXPECT_EQ(check_nodes(list, mesh.triangle_count()), "");
        std::vector<std::vector<Box>> boxes(mesh.triangle_count());
        for (const NodeView& node : list.nodes)
            for (uint32_t r = node.first_ref; r < node.first_ref + node.ref_count; ++r)
                boxes[list.ref_prims[r]].push_back(node.bounds);
        for (const PrimRef& ref : built.references->refs) {
            const bool is_held = std::ranges::any_of(
                boxes[ref.prim], [&](const Box& box) { return box.contains(ref.bounds); });
            EXPECT_TRUE(is_held);
        }
    }
}

}  // namespace
}  // namespace boxwood
