// What the 3D view draws of nodes that are no boxes, and by the marks of nodes and triangles.
#include <glad/gl.h>
#include <gtest/gtest.h>

#include "app/viewer/marks.h"
#include "core/catalog/pipeline.h"
#include "support/gl_picture.h"
#include "support/test_stages.h"
#include "support/traced_scene.h"

namespace boxwood {
namespace {

/// A horizontal line of these pixels of the picture, as front_camera(true) sees it.
OutlineSegment pixel_line(uint32_t node, int left, int right, int y) {
    const auto at = [&](int x) {
        return Vec3(static_cast<float>(x - 100), 99.5f - static_cast<float>(y), 0.0f) / 50.0f;
    };
    OutlineSegment segment{node, at(left), at(right)};
    return segment;
}

bool is_lit(const Image& image, int x, int y) { return at(image, x, y).red > 200; }

/// Two leaves of 40 x 40 pixels, at (20, 80) and (120, 80).
NodeList two_leaves() {
    return root_with_leaves({{Vec3(-1.6f, -0.4f, 0.0f), Vec3(-0.8f, 0.4f, 0.0f)},
                             {Vec3(0.4f, -0.4f, 0.0f), Vec3(1.2f, 0.4f, 0.0f)}});
}

TEST_F(GlTest, AnOutlineIsDrawnInPlaceOfTheBox) {
    NodeList nodes = two_leaves();
    nodes.outlines = {pixel_line(2, 125, 155, 90), pixel_line(2, 125, 155, 110)};
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    const Image image = draw(plain_list(levels, {1, 1}), front_camera(true));
    EXPECT_EQ(renderer_.box_counts(), (BoxCounts{.candidates = 2, .drawn = 2}));
    EXPECT_TRUE(is_lit(image, 20, 100)) << "the left leaf has no outline: its box is drawn";
    EXPECT_TRUE(is_lit(image, 140, 90));
    EXPECT_TRUE(is_lit(image, 140, 110));
    EXPECT_FALSE(is_lit(image, 120, 100)) << "the right leaf's box";
    EXPECT_FALSE(is_lit(image, 140, 80));
    EXPECT_EQ(at(image, 100, 100).red + at(image, 99, 99).red, 0) << "segments that the outline has not";
    DrawList root_alone = plain_list(levels, {0, 0});
    EXPECT_FALSE(is_lit(draw(root_alone, front_camera(true)), 140, 90)) << "an outline has its node's level";
}

TEST_F(GlTest, AnOutlineMayHaveManySegmentsInAnyOrder) {
    NodeList nodes = two_leaves();
    for (int i = 0; i < 30; ++i) {  // 30 segments: three pieces, and mixed with the other node's
        nodes.outlines.push_back(pixel_line(2, 122, 158, 40 + 4 * i));
        if (i % 2 == 0) nodes.outlines.push_back(pixel_line(1, 22, 58, 40 + 4 * i));
    }
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    const Image image = draw(plain_list(levels, {1, 1}), front_camera(true));
    for (int i = 0; i < 30; ++i) {
        EXPECT_TRUE(is_lit(image, 140, 40 + 4 * i)) << i;
        EXPECT_EQ(is_lit(image, 40, 40 + 4 * i), i % 2 == 0) << i;
        EXPECT_FALSE(is_lit(image, 90, 40 + 4 * i)) << i;
    }
    EXPECT_EQ(renderer_.box_counts().drawn, 2u) << "nodes are counted, not their pieces";
}

TEST_F(GlTest, TheBudgetCountsTheSegmentsOfOutlines) {
    // 100 nodes of 24 segments each take two of the budget each; the last is the largest.
    std::vector<Box> boxes;
    for (int i = 0; i < 99; ++i) {
        const auto x = static_cast<float>(i % 10), y = static_cast<float>(i / 10);
        const Vec3 lower(-1.9f + 0.3f * x, -1.9f + 0.3f * y, 0.0f);
        boxes.push_back({lower, lower + Vec3(0.2f, 0.2f, 0.0f)});
    }
    boxes.push_back({Vec3(1.2f, -1.0f, 0.0f), Vec3(1.9f, 1.0f, 0.0f)});
    NodeList nodes = root_with_leaves(boxes);
    for (uint32_t node = 1; node <= 100; ++node) {
        const Box& box = nodes.nodes[node].bounds;
        for (int i = 0; i < 24; ++i) {
            const float y = box.lower.y + (box.upper.y - box.lower.y) * static_cast<float>(i) / 23.0f;
            nodes.outlines.push_back({node, {box.lower.x, y, 0.0f}, {box.upper.x, y, 0.0f}});
        }
    }
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.box_budget = 41;
    const Image image = draw(list, front_camera(true));
    const BoxCounts counts = renderer_.box_counts();
    EXPECT_EQ(counts.candidates, 100u);
    EXPECT_EQ(counts.drawn, 21u) << "20 whole ones, and a half";
    EXPECT_EQ(counts.over_budget, 79u);
    EXPECT_TRUE(is_lit(image, 177, 149)) << "the largest is among them";
}

TEST_F(GlTest, ASurfaceHidesAnOutlineAsItHidesABox) {
    renderer_.set_mesh(square(1.0f, 1.0f));
    NodeList nodes = two_leaves();
    nodes.outlines = {pixel_line(1, 20, 60, 100)};
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.mesh = MeshLook::Shaded;
    list.background_top = list.background_bottom = Vec3(0.0f);
    const Image hidden = draw(list, front_camera(true));
    EXPECT_TRUE(is_lit(hidden, 40, 100)) << "beside the square";
    EXPECT_EQ(difference(at(hidden, 55, 100), at(hidden, 55, 110)), 0) << "behind it";
    list.see_through = true;
    const Image seen = draw(list, front_camera(true));
    EXPECT_GT(difference(at(seen, 55, 100), at(seen, 55, 110)), 10);
}

TEST_F(GlTest, TheSelectedOutlineAndTheRayAreDrawnOverAll) {
    const LevelTable levels = make_level_table(two_leaves());
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.selected = levels.list.nodes[2].bounds;
    list.selection_color = Vec3(0.0f, 1.0f, 0.0f);
    list.selected_outline = {pixel_line(0, 125, 155, 90)};
    list.ray = {pixel_line(0, 10, 190, 30)};
    list.ray_color = Vec3(0.0f, 0.0f, 1.0f);
    const Image image = draw(list, front_camera(true));
    EXPECT_EQ(at(image, 140, 90).green, 255);
    EXPECT_EQ(at(image, 140, 90).red, 0);
    EXPECT_EQ(at(image, 100, 30).blue, 255);
    list.selected_outline.clear();
    EXPECT_EQ(at(draw(list, front_camera(true)), 140, 80).green, 255) << "the box where there is no outline";
}

TEST_F(GlTest, EmptyCellsHaveTheirSwitchAndTheirColour) {
    NodeList nodes = two_leaves();
    nodes.nodes[2].ref_count = 0;
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.empty_color = Vec3(0.0f, 1.0f, 0.0f);
    list.boxes->empty_cells = false;
    const Image without = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts(), (BoxCounts{.candidates = 1, .drawn = 1, .empty = 1}));
    EXPECT_TRUE(is_lit(without, 20, 100));
    EXPECT_EQ(at(without, 120, 100).green, 0);
    list.boxes->empty_cells = true;
    const Image with = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts(), (BoxCounts{.candidates = 2, .drawn = 2}));
    EXPECT_EQ(at(with, 120, 100).green, 255);
    EXPECT_EQ(at(with, 120, 100).red, 0);
}

TEST_F(GlTest, BoxesAreColouredByVisits) {
    const LevelTable levels = make_level_table(two_leaves());
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.colors.meaning = BoxColor::Visits;
    list.colors.scale = {1.0, 8.0, true};
    list.colors.palette.fill(Vec3(0.0f));
    list.colors.palette.back() = Vec3(1.0f, 0.0f, 0.0f);
    list.unvisited_color = Vec3(0.0f, 1.0f, 0.0f);
    const std::vector<uint32_t> marks{9, 0, 8};  // by node: root, left, right
    renderer_.set_box_marks(levels, marks);
    const Image all = draw(list, front_camera(true));
    EXPECT_EQ(at(all, 120, 100).red, 255) << "as often as the scale goes";
    EXPECT_GT(at(all, 20, 100).green, 20) << "not visited: faint";
    EXPECT_LT(at(all, 20, 100).green, 140);
    list.boxes->only_visited = true;
    const Image visited = draw(list, front_camera(true));
    EXPECT_EQ(at(visited, 20, 100).green, 0);
    EXPECT_EQ(renderer_.box_counts(), (BoxCounts{.candidates = 1, .drawn = 1}));
    renderer_.set_box_marks(levels, {});
    list.boxes->only_visited = false;
    EXPECT_LT(at(draw(list, front_camera(true)), 120, 100).red, 50) << "without marks nothing was visited";
}

TEST_F(GlTest, HiddenNodesAndTrianglesAreNotDrawn) {
    renderer_.set_mesh(square(1.0f, 0.0f));
    const LevelTable levels = make_level_table(two_leaves());
    set_boxes(levels);
    renderer_.set_box_marks(levels, std::vector<uint32_t>{0, BoxMark::kHidden, 0});
    DrawList list = plain_list(levels, {1, 1});
    const Image boxes = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts(), (BoxCounts{.candidates = 1, .drawn = 1}));
    EXPECT_FALSE(is_lit(boxes, 20, 100));
    EXPECT_TRUE(is_lit(boxes, 120, 100));

    list.boxes.reset();
    list.mesh = MeshLook::Shaded;
    const uint8_t marks[] = {TriangleMark::kHidden, TriangleMark::kShared};
    renderer_.set_triangle_marks(marks);
    list.shared_color = Vec3(0.0f, 0.0f, 1.0f);
    const Image plain = draw(list, front_camera(true));
    EXPECT_EQ(at(plain, 130, 120).red, 0) << "triangle 0 is hidden, and black is behind it";
    EXPECT_GT(at(plain, 70, 80).red, 50) << "triangle 1 is grey";
    list.shared = true;
    const Image shared = draw(list, front_camera(true));
    EXPECT_GT(at(shared, 70, 80).blue, at(shared, 70, 80).red + 60);
    EXPECT_LT(at(shared, 70, 80).red, at(plain, 70, 80).red);
}

/// The whole way of a structure with outlines, which only tests have: recipe, level table, picture.
TEST_F(GlTest, AStructureBringsItsOutlines) {
    Task task;
    const std::shared_ptr<Scene> scene = random_scene(50, 0.2f);
    const Recipe recipe = parse_recipe("bvh-binned-sah > diagonals", kTestCatalog);
    StageCache cache;
    const std::optional<Built> built = run_recipe(recipe, scene, cache, task, /*with_levels=*/true);
    ASSERT_TRUE(built);
    EXPECT_EQ(check_nodes(built->levels->list, 50), "");
    EXPECT_EQ(built->levels->outline(0).size(), 13u);
    set_boxes(*built->levels);
    const Image diagonals = draw(plain_list(*built->levels, {0, 0}), front_camera(true));
    const DVec3 middle = built->levels->list.nodes[0].bounds.center();
    const int x = static_cast<int>(100.0 + 50.0 * middle.x), y = static_cast<int>(100.0 - 50.0 * middle.y);
    EXPECT_TRUE(is_lit(diagonals, x, y)) << "the middle of the root's diagonal";
    LevelTable boxes = *built->levels;
    boxes.list.outlines.clear();
    boxes.outline_begin.clear();
    set_boxes(boxes);
    EXPECT_FALSE(is_lit(draw(plain_list(boxes, {0, 0}), front_camera(true)), x, y));
}

}  // namespace
}  // namespace boxwood
