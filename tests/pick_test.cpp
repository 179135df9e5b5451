#include "app/viewer/pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/viewer/draw_list.h"
#include "app/viewer/node_facts.h"

namespace boxwood {
namespace {

constexpr float kNoSurface = std::numeric_limits<float>::infinity();

/// Seen by `front`: a root of 200 x 100 pixels, its upper left corner at (0, 50); a leaf in its left half; in
/// its right half an inner node with two leaves of 50 x 100 pixels, of which the right one is empty.
NodeList tree_to_pick() {
    const auto box = [](float left, float right) {
        return Box{Vec3(left, -1.0f, -1.0f), Vec3(right, 1.0f, 1.0f)};
    };
    NodeList list;
    list.nodes = {
        {.bounds = box(-2.0f, 2.0f), .parent = kNoIndex, .level = 0, .kind = NodeKind::Inner},
        {.bounds = box(-2.0f, 0.0f), .parent = 0, .level = 1, .first_ref = 0, .ref_count = 2},
        {.bounds = box(0.0f, 2.0f), .parent = 0, .level = 1, .kind = NodeKind::Inner},
        {.bounds = box(0.0f, 1.0f), .parent = 2, .level = 2, .first_ref = 2, .ref_count = 2},
        {.bounds = box(1.0f, 2.0f), .parent = 2, .level = 2, .first_ref = 4, .ref_count = 0},
    };
    list.ref_prims = {0, 1, 1, 2};
    return list;
}

/// One world unit is 50 pixels of the picture of 200 x 200.
PickPoint front(float x, float y, float surface_t = kNoSurface) {
    Camera camera;
    camera.eye = {0.0f, 0.0f, 10.0f};
    camera.fov = static_cast<float>(2.0 * std::atan(2.0 / 10.0) * 180.0 / 3.14159265358979323846);
    camera.orthographic = true;
    return {{x, y}, {0.0f, 0.0f, 200.0f, 200.0f}, camera, surface_t};
}

class Picking : public testing::Test {
protected:
    std::vector<uint32_t> pick(const PickPoint& point) const {
        const Visibility visibility = visible_parts(state_.side(), levels_.list, 3);
        return pick_nodes(state_, levels_, visibility, nullptr, point);
    }
    using Nodes = std::vector<uint32_t>;

    ViewerState state_;
    LevelTable levels_ = make_level_table(tree_to_pick());
};

TEST_F(Picking, ALineUnderThePointerComesFirstThenTheBoxesBehindIt) {
    EXPECT_EQ(pick(front(75.0f, 100.0f)), (Nodes{1, 0})) << "no line near: the smallest first";
    EXPECT_EQ(pick(front(150.0f, 100.0f)), (Nodes{3, 2, 0})) << "the line of the leaf, at its edge";
    EXPECT_EQ(pick(front(100.0f, 100.0f)), (Nodes{3, 1, 2, 0})) << "three lines on each other";
    EXPECT_TRUE(pick(front(100.0f, 10.0f)).empty()) << "beside all";
    EXPECT_EQ(pick(front(75.0f, 46.0f)), (Nodes{1, 0})) << "beside the boxes, but near their lines";
}

TEST_F(Picking, OnlyWhatTheStateShowsIsPicked) {
    state_.levels = {0, 0};
    EXPECT_EQ(pick(front(75.0f, 100.0f)), (Nodes{0}));
    state_.levels = {2, 2};
    EXPECT_EQ(pick(front(75.0f, 100.0f)), (Nodes{1})) << "a leaf above the range";
    state_.leaves_above = false;
    EXPECT_TRUE(pick(front(75.0f, 100.0f)).empty());
    EXPECT_TRUE(pick(front(175.0f, 100.0f)).empty()) << "an empty cell";
    state_.show_empty = true;
    EXPECT_EQ(pick(front(175.0f, 100.0f)), (Nodes{4}));
    state_.levels = {0, 2};
    state_.side().hidden_nodes = {2};
    EXPECT_EQ(pick(front(175.0f, 100.0f)), (Nodes{0}));
}

TEST_F(Picking, TheSurfaceHidesWhatIsBehindIt) {
    levels_ = make_level_table([] {
        NodeList list = tree_to_pick();
        list.nodes[3].bounds = {Vec3(0.2f, -0.5f, -1.0f), Vec3(0.8f, 0.5f, -0.5f)};  // 40 to 60 pixels right
        return list;
    }());
    const float before = 9.0f, behind = 20.0f;  // the surface at z = 1 and behind all
    EXPECT_EQ(pick(front(125.0f, 100.0f, behind)).front(), 3u);
    const Nodes found = pick(front(125.0f, 100.0f, before));
    EXPECT_EQ(std::ranges::find(found, 3u), found.end());
    state_.see_through = true;
    EXPECT_EQ(pick(front(110.0f, 100.0f, before)).front(), 3u) << "its left edge, through the surface";
}

TEST_F(Picking, AnOutlineIsPickedWhereItIsDrawn) {
    NodeList list = tree_to_pick();
    list.outlines = {{3, Vec3(0.5f, -1.0f, 0.0f), Vec3(0.5f, 1.0f, 0.0f)}};
    levels_ = make_level_table(list);
    EXPECT_EQ(pick(front(125.0f, 100.0f)).front(), 3u);
    EXPECT_EQ(pick(front(149.0f, 100.0f)), (Nodes{3, 2, 0})) << "inside its box, away from its line";
}

TEST_F(Picking, TheSamePlaceAgainIsTheNextOne) {
    EXPECT_EQ(next_candidate({5, 7, 9}, kNoIndex), 5u);
    EXPECT_EQ(next_candidate({5, 7, 9}, 5), 7u);
    EXPECT_EQ(next_candidate({5, 7, 9}, 9), 5u);
    EXPECT_EQ(next_candidate({}, 9), kNoIndex);
}

TEST_F(Picking, PerspectiveLinesArePickedWhereTheyAreSeen) {
    PickPoint point = front(0.0f, 0.0f);
    point.camera.orthographic = false;
    // The near face at z = 1 is seen with 2 / (9 * 0.2) of the half width: its left edge is 11 pixels
    // outside. The far face at z = -1: 2 / (11 * 0.2), 9 pixels inside.
    point.pointer = {9.0f, 100.0f};
    EXPECT_EQ(pick(point), (Nodes{1, 0}));
    point.camera.eye.z = 0.0f;  // inside: what is behind the eye is not in the way
    point.camera.target.z = -1.0f;
    point.pointer = {100.0f, 100.0f};
    EXPECT_FALSE(pick(point).empty());
}

TEST(Marks, AHiddenNodeTakesWhatIsBelowAndTrianglesOfNoOtherLeaf) {
    const NodeList list = tree_to_pick();
    ViewerState state;
    EXPECT_TRUE(visible_parts(state.side(), list, 3).is_whole());
    state.side().hidden_nodes = {1};
    Visibility seen = visible_parts(state.side(), list, 3);
    EXPECT_EQ(seen.nodes, (std::vector<uint8_t>{1, 0, 1, 1, 1}));
    EXPECT_EQ(seen.triangles, (std::vector<uint8_t>{0, 1, 1})) << "1 is in leaf 3 too";
    state.side().hidden_nodes = {2};
    seen = visible_parts(state.side(), list, 3);
    EXPECT_EQ(seen.nodes, (std::vector<uint8_t>{1, 1, 0, 0, 0}));
    EXPECT_EQ(seen.triangles, (std::vector<uint8_t>{1, 1, 0}));
    state.side().hidden_nodes = {99};
    EXPECT_TRUE(visible_parts(state.side(), list, 3).is_whole()) << "a node that does not exist";
}

TEST(Marks, AnIsolatedNodeIsShownWithWhatIsBelow) {
    const NodeList list = tree_to_pick();
    ViewerState state;
    state.side().isolated = 2;
    Visibility seen = visible_parts(state.side(), list, 3);
    EXPECT_EQ(seen.nodes, (std::vector<uint8_t>{0, 0, 1, 1, 1}));
    EXPECT_EQ(seen.triangles, (std::vector<uint8_t>{0, 1, 1}));
    state.side().hidden_nodes = {3};
    seen = visible_parts(state.side(), list, 3);
    EXPECT_EQ(seen.nodes, (std::vector<uint8_t>{0, 0, 1, 0, 1}));
    EXPECT_EQ(seen.triangles, (std::vector<uint8_t>{0, 0, 0}));
    Visits visits;
    visits.by_node = {5, 4, 3, 2, 1};
    const uint32_t hidden = BoxMark::kHidden;
    EXPECT_EQ(box_marks(seen, &visits), (std::vector<uint32_t>{5 | hidden, 4 | hidden, 3, 2 | hidden, 1}));
    EXPECT_EQ(box_marks(seen, nullptr), (std::vector<uint32_t>{hidden, hidden, 0, hidden, 0}));
    EXPECT_TRUE(box_marks(Visibility{}, nullptr).empty());
}

TEST(Marks, TrianglesSplitByTheStageAndSharedByTheBuilderDiffer) {
    const NodeList list = tree_to_pick();
    const BoxValues values = make_box_values(list);
    EXPECT_EQ(values.prim_leaves, (std::vector<uint32_t>{1, 2, 1}));
    const PrimRef refs[] = {{Box{}, 0}, {Box{}, 1}, {Box{}, 2}, {Box{}, 2}};
    Visibility seen;
    EXPECT_EQ(triangle_marks(refs, values, seen, 3),
              (std::vector<uint8_t>{0, TriangleMark::kShared, TriangleMark::kSplit}));
    seen.nodes = {1, 1, 1, 1, 1};
    seen.triangles = {1, 0, 1};
    EXPECT_EQ(triangle_marks(refs, values, seen, 3)[1], TriangleMark::kShared | TriangleMark::kHidden);
}

TEST(NodeFacts, CountWhatIsBelowANode) {
    const NodeList list = tree_to_pick();
    const BoxValues values = make_box_values(list);
    const NodeFacts facts = node_facts(list, values, 2);
    EXPECT_EQ(facts.path, (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(facts.siblings, (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(facts.children, (std::vector<uint32_t>{3, 4}));
    EXPECT_EQ(facts.child_count, 2u);
    EXPECT_EQ(facts.nodes_below, 2u);
    EXPECT_EQ(facts.leaves_below, 2u);
    EXPECT_EQ(facts.references, 2u);
    EXPECT_EQ(facts.prims, (std::vector<uint32_t>{1, 2}));
    // Half areas: root 20, halves 12, quarters 8. Terms: 20, 24, 12, 16, 0; their sum is 72.
    EXPECT_NEAR(facts.own_share, 12.0 / 72.0, 1e-6);
    EXPECT_NEAR(facts.share_below, 28.0 / 72.0, 1e-6);
    const NodeFacts root = node_facts(list, values, 0);
    EXPECT_EQ(root.references, 4u);
    EXPECT_EQ(root.prim_count, 3u) << "triangle 1 once";
    EXPECT_TRUE(root.siblings.empty());
    const NodeFacts leaf = node_facts(list, values, 1);
    EXPECT_EQ(leaf.leaves_below, 1u);
    EXPECT_EQ(leaf.child_count, 0u);
}

}  // namespace
}  // namespace boxwood
