#include "core/bvh/ploc.h"

#include <gtest/gtest.h>

#include <string>

#include "core/bvh/morton.h"
#include "core/measure/tree_stats.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

/// The tree below a node, as "(left right)"; a leaf as its primitives.
std::string text_of(const Bvh2& bvh, uint32_t node = 0) {
    const Bvh2::Node& n = bvh.nodes[node];
    if (!n.is_leaf()) return "(" + text_of(bvh, n.first) + " " + text_of(bvh, n.first + 1) + ")";
    std::string text;
    for (uint32_t i = 0; i < n.count; ++i)
        text += (i > 0 ? "," : "") + std::to_string(bvh.prims[n.first + i]);
    return text;
}

PrimRef unit_cube(uint32_t prim, float x) { return {Box{Vec3(x, 0, 0), Vec3(x + 1, 1, 1)}, prim}; }

/// The paper's rounds, written down as they are told, one cluster after the other.
std::string slow_ploc(std::span<const PrimRef> refs, int radius) {
    struct Cluster {
        Box box;
        std::string text;
    };
    Task task;
    std::vector<Cluster> clusters;
    for (const uint32_t prim : Morton{.max_leaf_size = 1}.build(Mesh{}, refs, task).prims)
        clusters.push_back({refs[prim].bounds, std::to_string(prim)});
    while (clusters.size() > 1) {
        const int count = static_cast<int>(clusters.size());
        const auto area = [&](int i, int j) {
            Box box = clusters[static_cast<size_t>(i)].box;
            box.extend(clusters[static_cast<size_t>(j)].box);
            const Vec3 e = box.upper - box.lower;
            return e.x * e.y + e.y * e.z + e.z * e.x;
        };
        std::vector<int> nearest;
        for (int i = 0; i < count; ++i) {
            int best = -1;
            for (int j = std::max(0, i - radius); j <= std::min(count - 1, i + radius); ++j) {
                if (j == i) continue;
                const bool is_better = best < 0 || area(i, j) < area(i, best) ||
                                       (area(i, j) == area(i, best) && (i ^ j) < (i ^ best));
                if (is_better) best = j;
            }
            nearest.push_back(best);
        }
        std::vector<Cluster> next;
        for (int i = 0; i < count; ++i) {
            const int j = nearest[static_cast<size_t>(i)];
            const bool merges = nearest[static_cast<size_t>(j)] == i;
            if (merges && j < i) continue;
            Cluster cluster = clusters[static_cast<size_t>(i)];
            if (merges) {
                const Cluster& other = clusters[static_cast<size_t>(j)];
                cluster.box.extend(other.box);
                cluster.text = "(" + cluster.text + " " + other.text + ")";
            }
            next.push_back(cluster);
        }
        clusters = next;
    }
    return clusters[0].text;
}

TEST(Ploc, MergesTheNearestFirst) {
    Task task;
    const std::vector<PrimRef> refs = {unit_cube(0, 0), unit_cube(1, 10), unit_cube(2, 1), unit_cube(3, 12)};
    EXPECT_EQ(text_of(Ploc{.max_leaf_size = 1}.build(Mesh{}, refs, task)), "((0 2) (1 3))");
}

TEST(Ploc, DoesWhatThePaperTells) {
    Task task;
    for (const uint32_t count : {2u, 3u, 100u, 700u}) {
        const Mesh mesh = random_triangles(count, 0.1f, count);
        const std::vector<PrimRef> refs = whole_refs(mesh);
        for (const int radius : {1, 3, 4, 6, 16, 100}) {
            EXPECT_EQ(text_of(Ploc{.radius = radius, .max_leaf_size = 1}.build(mesh, refs, task)),
                      slow_ploc(refs, radius))
                << count << " references, radius " << radius;
        }
    }
}

TEST(Ploc, MakesALeafWhereThatIsCheaper) {
    // Two unit cubes side by side, half areas 3 and 3, together 5: 1 + (3 + 3) / 5 = 2.2 tests against 2.
    // Farther apart, 3 and 3 in 21: 1 + 6 / 21 against 2.
    Task task;
    const auto text = [&](float x, int max_leaf_size) {
        const std::vector<PrimRef> refs = {unit_cube(0, 0), unit_cube(1, x)};
        return text_of(Ploc{.max_leaf_size = max_leaf_size}.build(Mesh{}, refs, task));
    };
    EXPECT_EQ(text(1, 2), "0,1");
    EXPECT_EQ(text(1, 1), "(0 1)");
    EXPECT_EQ(text(9, 2), "(0 1)");
}

TEST(Ploc, MergesEqualClustersInPairs) {
    Task task;
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < 4096; ++i) refs.push_back(unit_cube(i, 0));
    const Bvh2 bvh = Ploc{.max_leaf_size = 1}.build(Mesh{}, refs, task);
    EXPECT_EQ(make_level_table(bvh.list_nodes()).level_count(), 13u);
}

TEST(Ploc, EndsSoonWhereEachIsNearestToTheOneBefore) {
    // Growing cubes side by side, each nearest to the smaller one beside it: one pair would merge in a round,
    // and 20000 rounds would take minutes.
    Task task;
    std::vector<PrimRef> refs;
    float x = 0.0f, size = 1.0f;
    for (uint32_t i = 0; i < 40'000; ++i) {
        refs.push_back({Box{Vec3(x, 0, 0), Vec3(x + size, size, size)}, i});
        x += size;
        size *= 1.0005f;
    }
    const Bvh2 bvh = Ploc{}.build(Mesh{}, refs, task);
    EXPECT_EQ(bvh.prims.size(), refs.size());
}

TEST(Ploc, KeepsEveryDepthBound) {
    Task task;
    const Mesh mesh = random_triangles(1000, 0.3f, 5);
    const std::vector<PrimRef> refs = whole_refs(mesh);
    const auto depth = [&](uint32_t bound) {
        const LevelTable levels =
            make_level_table(Ploc{.max_leaf_size = 1}.build_within(bound, mesh, refs, task).list_nodes());
        EXPECT_EQ(check_nodes(levels.list, refs.size()), "");
        return levels.level_count() - 1;
    };
    EXPECT_GT(depth(Bvh2::kMaxDepth), 14u);  // what it has without a bound
    for (uint32_t bound = 10; bound <= 16; ++bound) EXPECT_LE(depth(bound), bound);
}

}  // namespace
}  // namespace boxwood
