#include "app/viewer/draw_list.h"

#include <gtest/gtest.h>

namespace boxwood {
namespace {

/// Root [0,2]x[0,1]x[0,1]: half area 5. Left leaf: unit cube, half area 3, two references. Right inner node:
/// unit cube with two leaves of half its width (half area 2), one and three references.
NodeList tree_to_draw() {
    const Box all = {Vec3(0.0f), Vec3(2.0f, 1.0f, 1.0f)};
    const Box left = {Vec3(0.0f), Vec3(1.0f)};
    const Box right = {Vec3(1.0f, 0.0f, 0.0f), Vec3(2.0f, 1.0f, 1.0f)};
    const Box first = {Vec3(1.0f, 0.0f, 0.0f), Vec3(1.5f, 1.0f, 1.0f)};
    const Box second = {Vec3(1.5f, 0.0f, 0.0f), Vec3(2.0f, 1.0f, 1.0f)};
    NodeList list;
    list.nodes = {
        {.bounds = all, .parent = kNoIndex, .level = 0, .kind = NodeKind::Inner},
        {.bounds = left, .parent = 0, .level = 1, .kind = NodeKind::Leaf, .first_ref = 0, .ref_count = 2},
        {.bounds = right, .parent = 0, .level = 1, .kind = NodeKind::Inner},
        {.bounds = first, .parent = 2, .level = 2, .kind = NodeKind::Leaf, .first_ref = 2, .ref_count = 1},
        {.bounds = second, .parent = 2, .level = 2, .kind = NodeKind::Leaf, .first_ref = 3, .ref_count = 3},
    };
    list.ref_prims = {0, 1, 2, 3, 4, 5};
    return list;
}

TEST(BoxValues, CountReferencesBelowAndShareTheCost) {
    const BoxValues values = make_box_values(tree_to_draw());
    EXPECT_EQ(values.references, (std::vector<float>{6, 2, 4, 1, 3}));
    EXPECT_EQ(values.references_range, (ValueRange{1, 6}));
    // Terms: 5*1, 3*2, 3*1, 2*1, 2*3; their sum is 22.
    const std::vector<float> shares = {5.0f / 22, 6.0f / 22, 3.0f / 22, 2.0f / 22, 6.0f / 22};
    ASSERT_EQ(values.sah_share.size(), shares.size());
    for (size_t i = 0; i < shares.size(); ++i) EXPECT_FLOAT_EQ(values.sah_share[i], shares[i]) << i;
    EXPECT_FLOAT_EQ(values.sah_share_range.lower, 2.0f / 22);
    EXPECT_FLOAT_EQ(values.sah_share_range.upper, 6.0f / 22);
}

TEST(BoxValues, AcceptATreeWithoutAreaAndNone) {
    NodeList points = tree_to_draw();
    for (NodeView& view : points.nodes) view.bounds = {Vec3(1.0f), Vec3(1.0f)};
    const BoxValues values = make_box_values(points);
    EXPECT_FLOAT_EQ(values.sah_share[4], 3.0f / 8);  // of 1 + 2 + 1 + 1 + 3 visits and tests
    EXPECT_EQ(make_box_values(NodeList{}).references_range, ValueRange{});
}

TEST(DrawList, SelectsTheRangeAndTheLeavesAboveIt) {
    const LevelTable levels = make_level_table(tree_to_draw());
    EXPECT_EQ(select_boxes(levels, {0, 0}, true), (BoxSelection{0, 1, true, 1}));
    EXPECT_EQ(select_boxes(levels, {1, 1}, false), (BoxSelection{1, 3, false, 2}));
    EXPECT_EQ(select_boxes(levels, {2, 2}, false), (BoxSelection{2, 5, false, 2}));
    EXPECT_EQ(select_boxes(levels, {2, 2}, true), (BoxSelection{2, 5, true, 3}));
    EXPECT_EQ(select_boxes(levels, {1, 999}, true), (BoxSelection{1, 5, true, 4}));
    EXPECT_EQ(select_boxes(levels, {500, 999}, false), (BoxSelection{2, 5, false, 2}));
    EXPECT_EQ(select_boxes(make_level_table(NodeList{}), {0, 4}, true).count, 0u);
}

TEST(DrawList, FollowsTheState) {
    const LevelTable levels = make_level_table(tree_to_draw());
    const BoxValues values = make_box_values(levels.list);
    ViewerState state;
    EXPECT_EQ(make_draw_list(state, levels, values).mesh, MeshLook::Shaded);
    state.traced = TracedView::Over;
    state.show_wire = true;
    EXPECT_EQ(make_draw_list(state, levels, values).mesh, MeshLook::Depth);
    EXPECT_FALSE(make_draw_list(state, levels, values).wire);
    state.show_mesh = false;
    state.show_boxes = false;
    state.interface_scale = 2.0f;
    state.side().node = 3;
    state.prim = 5;
    const DrawList list = make_draw_list(state, levels, values);
    EXPECT_EQ(list.mesh, MeshLook::Hidden);
    EXPECT_FALSE(list.boxes);
    EXPECT_EQ(list.selected, levels.list.nodes[3].bounds);
    EXPECT_EQ(list.selected_prim, 5u);
    EXPECT_EQ(list.line_width, 2.0f * make_draw_list(ViewerState{}, levels, values).line_width);
}

TEST(DrawList, ColoursSpanTheValuesAndStandOutFromTheBackground) {
    const LevelTable levels = make_level_table(tree_to_draw());
    const BoxValues values = make_box_values(levels.list);
    ViewerState state;
    state.levels = {0, 999};
    EXPECT_EQ(make_draw_list(state, levels, values).colors.scale, (ValueScale{0.0, 2.0, false}));
    state.box_color = BoxColor::Primitives;
    const ColorScale colors = make_draw_list(state, levels, values).colors;
    EXPECT_EQ(colors.scale, (ValueScale{1.0, 6.0, true}));
    EXPECT_EQ(colors.color(1.0), colors.palette.front());
    EXPECT_EQ(colors.color(6.0), colors.palette.back());
    for (const Theme theme : {Theme::Dark, Theme::Light}) {
        state.theme = theme;
        const DrawList list = make_draw_list(state, levels, values);
        const Vec3 luminance(0.2126f, 0.7152f, 0.0722f);
        for (const Vec3& color : list.colors.palette) {
            const float a = glm::dot(luminance, color) + 0.05f;
            const float b = glm::dot(luminance, list.background_top) + 0.05f;
            EXPECT_GT(std::max(a, b) / std::min(a, b), 1.5f);  // contrast ratio of WCAG 2
        }
    }
}

TEST(DrawList, SaysWhatWasNotDrawn) {
    EXPECT_EQ(describe(BoxCounts{}), "no boxes");
    EXPECT_EQ(describe({.candidates = 1, .drawn = 1}), "1 box");
    EXPECT_EQ(describe({.candidates = 3100000, .drawn = 200000, .over_budget = 2900000}),
              "200,000 of 3,100,000 boxes, the largest on screen");
    EXPECT_EQ(describe({.candidates = 1234, .drawn = 1000, .outside = 200, .under_pixel = 34}),
              "1,000 of 1,234 boxes; 200 outside the view; 34 under a pixel");
}

}  // namespace
}  // namespace boxwood
