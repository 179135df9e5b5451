#include "core/wide_bvh/qualities.h"

#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "core/wide_bvh/morton_part.h"
#include "support/random_mesh.h"
#include "support/skipped.h"

namespace boxwood {
namespace {

/// Large enough for many parts, some nearer to the root than others.
std::shared_ptr<const Scene> scene_of_parts() {
    Task task;
    return open_scene("spaceship", task);
}

/// Each triangle in some leaf, each leaf's triangles inside its box.
void expect_whole(const Mesh& mesh, const WideBvh<16>& bvh) {
    std::vector<bool> is_there(mesh.triangle_count(), false);
    for (const WideBvh<16>::Node& node : bvh.nodes) {
        for (uint32_t lane = 0; lane < 16; ++lane) {
            const WideChild child = node.children[lane];
            if (!child.is_leaf()) continue;
            for (uint32_t i = 0; i < child.pack_count(); ++i) {
                const WideBvh<16>::Pack& pack = bvh.packs[child.first_pack() + i];
                for (uint32_t k = 0; k < pack.count(); ++k) {
                    ASSERT_TRUE(node.bounds(lane).contains(mesh.triangle(pack.prims[k]).bounds()));
                    is_there[pack.prims[k]] = true;
                }
            }
        }
    }
    EXPECT_EQ(std::ranges::count(is_there, true), static_cast<std::ptrdiff_t>(mesh.triangle_count()));
}

TEST(Qualities, LeavesOfManyPartsHoldTheirTriangles) {
    const auto scene = scene_of_parts();
    const std::vector<PrimRef> refs = whole_refs(scene->mesh);
    Task task;
    expect_whole(scene->mesh, Preview{}.build(scene->mesh, refs, task));
    expect_whole(scene->mesh, Balanced{}.build(scene->mesh, refs, task));
}

/// An order of which only the levels between neighbours count.
MortonOrder order_of(std::initializer_list<uint8_t> levels) {
    MortonOrder order;
    order.levels.assign(levels);
    order.keys.assign(levels.size() + 1, 0);
    return order;
}

TEST(Qualities, PacksOfThePreviewEndWhereCodesPart) {
    const auto packs = [](const MortonOrder& order) {
        return morton_packs(order, {0, static_cast<uint32_t>(order.keys.size())});
    };
    // Equal levels: full packs.
    EXPECT_EQ(packs(order_of({9, 9, 9, 9, 9, 9, 9, 9, 9, 9})), (std::vector<uint32_t>{0, 8, 11}));
    // Three bits earlier after five: three lanes are worth it no more; four bits are.
    EXPECT_EQ(packs(order_of({9, 9, 9, 9, 6, 9, 9, 9, 9})), (std::vector<uint32_t>{0, 8, 10}));
    EXPECT_EQ(packs(order_of({9, 9, 9, 9, 5, 9, 9, 9, 9})), (std::vector<uint32_t>{0, 5, 10}));
    // What fits into one pack is one.
    EXPECT_EQ(packs(order_of({0, 1, 2, 3, 4, 5, 6})), (std::vector<uint32_t>{0, 8}));
    EXPECT_EQ(packs(order_of({})), (std::vector<uint32_t>{0, 1}));
}

TEST(Qualities, BestSplitsSpaceWhereBoxesAreLooseAndPiecesNotDearer) {
    const std::string tight = "tight boxes, not split in space", whole = "cheaper whole than split";
    const std::tuple<const char*, bool, bool> cases[] = {
        {"terrain@tris=10k", true, false}, {"spaceship", false, false}, {"kitchen", false, true}};
    for (const auto& [name, is_tight, is_cheaper_whole] : cases) {
        Task task;
        const auto scene = open_scene(name, task);
        const std::vector<PrimRef> refs = whole_refs(scene->mesh);
        const WideBvh<16> best = Best{}.build(scene->mesh, refs, task);
        EXPECT_EQ(skipped(task, tight), is_tight ? refs.size() : 0u) << name;
        EXPECT_EQ(skipped(task, whole), is_cheaper_whole ? refs.size() : 0u) << name;
        size_t count = 0;
        for (const WideBvh<16>::Pack& pack : best.packs) count += pack.count();
        EXPECT_EQ(count == refs.size(), is_tight || is_cheaper_whole) << name;
    }
}

}  // namespace
}  // namespace boxwood
