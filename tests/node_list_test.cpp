#include "core/structure/node_list.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace boxwood {
namespace {

Box box(float lower, float upper) { return {Vec3(lower), Vec3(upper)}; }

NodeView inner(const Box& bounds, uint32_t parent, uint32_t level) {
    return {.bounds = bounds, .parent = parent, .level = level, .kind = NodeKind::Inner};
}

NodeView leaf(const Box& bounds, uint32_t parent, uint32_t level, uint32_t first_ref, uint32_t ref_count) {
    return {bounds, parent, level, NodeKind::Leaf, first_ref, ref_count};
}

//        0
//      1   2(leaf: 0, 1)
//    3   4      leaves: 2 and 2, 1
NodeList small_tree() {
    NodeList list;
    list.nodes = {inner(box(0, 8), kNoIndex, 0), inner(box(0, 4), 0, 1), leaf(box(2, 8), 0, 1, 0, 2),
                  leaf(box(0, 1), 1, 2, 2, 1), leaf(box(1, 4), 1, 2, 3, 2)};
    list.ref_prims = {0, 1, 2, 2, 1};
    return list;
}

TEST(LevelTable, GroupsByLevelLeavesFirstThenByDescendingArea) {
    const LevelTable table = make_level_table(small_tree());
    EXPECT_EQ(table.level_count(), 3u);
    EXPECT_EQ(table.order, (std::vector<uint32_t>{0, 2, 1, 4, 3}));
    EXPECT_EQ(table.level_begin, (std::vector<uint32_t>{0, 1, 3, 5}));
    EXPECT_EQ(table.leaf_count, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_EQ(table.level(1).size(), 2u);
    EXPECT_EQ(table.leaves(1)[0], 2u);
}

TEST(LevelTable, EqualAreasAreOrderedByIndex) {
    NodeList list;
    list.nodes.push_back(inner(box(0, 1), kNoIndex, 0));
    for (uint32_t i = 0; i < 100; ++i) list.nodes.push_back(leaf(box(0, 1), 0, 1, i, 1));
    for (uint32_t i = 0; i < 100; ++i) list.ref_prims.push_back(i);
    const LevelTable table = make_level_table(list);
    for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(table.leaves(1)[i], i + 1);
}

TEST(LevelTable, TheCutKeepsTheLeavesAboveItSoThatThePictureStaysWhole) {
    const LevelTable table = make_level_table(small_tree());
    EXPECT_EQ(table.cut(0), (std::vector<uint32_t>{0}));
    EXPECT_EQ(table.cut(1), (std::vector<uint32_t>{2, 1}));
    EXPECT_EQ(table.cut(2), (std::vector<uint32_t>{2, 4, 3}));
    EXPECT_EQ(table.cut(7), (std::vector<uint32_t>{2, 4, 3}));  // below the last level: all leaves
}

TEST(LevelTable, AnEmptyListHasNoLevels) {
    const LevelTable table = make_level_table({});
    EXPECT_EQ(table.level_count(), 0u);
    EXPECT_EQ(table.level_begin, (std::vector<uint32_t>{0}));
    EXPECT_TRUE(table.cut(0).empty());
    EXPECT_EQ(check_nodes(table.list, 0), "");
}

TEST(LevelTable, CountsTheBytesOfItsArrays) {
    const LevelTable table = make_level_table(small_tree());
    EXPECT_EQ(table.byte_count(), 5 * sizeof(NodeView) + 5 * 4 + (5 + 4 + 3) * 4);
}

TEST(LevelTable, AHugeListIsGroupedInOrder) {
    NodeList list;
    Rng rng(1);
    list.nodes.push_back(inner(box(0, 1), kNoIndex, 0));
    for (uint32_t i = 1; i < 200'001; ++i) {
        const uint32_t parent = (i - 1) / 2;
        const float upper = rng.next();
        NodeView node = inner(box(0, upper), parent, list.nodes[parent].level + 1);
        if (2 * size_t{i} + 1 >= 200'001) node.kind = NodeKind::Leaf;
        list.nodes.push_back(node);
    }
    const LevelTable table = make_level_table(list);
    for (size_t l = 0; l < table.level_count(); ++l)
        for (size_t k = 1; k < table.level(l).size(); ++k) {
            const NodeView& a = list.nodes[table.level(l)[k - 1]];
            const NodeView& b = list.nodes[table.level(l)[k]];
            ASSERT_EQ(a.level, l);
            ASSERT_TRUE(k == table.leaf_count[l] ||
                        (a.kind == b.kind && a.bounds.half_area() >= b.bounds.half_area()));
        }
}

TEST(CheckNodes, AcceptsAValidTree) { EXPECT_EQ(check_nodes(small_tree(), 3), ""); }

TEST(CheckNodes, SaysWhatIsWrong) {
    const auto wrong = [](auto change, size_t triangle_count = 3) {
        NodeList list = small_tree();
        change(list);
        return check_nodes(list, triangle_count);
    };
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[3].bounds = box(0, 5); }), "node 3 sticks out of its parent");
    EXPECT_EQ(wrong([](NodeList& l) {
                  l.nodes[3].bounds = box(0, 5);
                  l.is_nested = false;
              }),
              "");
    EXPECT_EQ(wrong([](NodeList& l) { l.half_areas = {1.0}; }), "there are 5 nodes and 1 areas");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[1].parent = 4; }), "node 1 comes before its parent");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[1].parent = kNoIndex; }), "node 1 is a second root");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[0].parent = 0; }), "node 0 is the first and has a parent");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[0].level = 1; }), "node 0 is the root and not at level 0");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[4].level = 1; }), "node 4 is not one level below its parent");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[4] = leaf(box(3, 4), 2, 2, 3, 2); }),
              "node 4 is the child of a leaf");
    EXPECT_EQ(wrong([](NodeList& l) { l.ref_prims[4] = 2; }), "leaf 4 holds primitive 2 twice");
    EXPECT_EQ(wrong([](NodeList& l) { l.ref_prims[0] = 3; }), "leaf 2 has primitive 3, which does not exist");
    EXPECT_EQ(wrong([](NodeList& l) { l.ref_prims[0] = 2; }), "primitive 0 is in no leaf");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[4].ref_count = 3; }), "leaf 4 has references beyond the list");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[4].first_ref = kNoIndex; }),
              "leaf 4 has references beyond the list");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[4].bounds = Box{}; }), "leaf 4 has primitives in an empty box");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes[2].kind = NodeKind::Inner; }), "inner node 2 has no child");
    EXPECT_EQ(wrong([](NodeList&) {}, 4), "primitive 3 is in no leaf");
    EXPECT_EQ(wrong([](NodeList& l) { l.nodes.clear(); }), "there are primitives and no nodes");
}

}  // namespace
}  // namespace boxwood
