// The OpenGL side on a context in memory. Every test ends with a look at what the driver complained about.
#include <cmath>

#include <glad/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "app/gl/program.h"
#include "app/gl/ui_renderer.h"
#include "core/base/rng.h"
#include "support/gl_picture.h"

namespace boxwood {
namespace {

TEST(GlContext, RecordsTheFirstError) {
    const OsmesaContext context;
    EXPECT_EQ(context.messages().error_count, 0);
    glEnable(0xffff);
    EXPECT_EQ(context.messages().error_count, 1);
    EXPECT_NE(context.messages().first_error, "");
    const std::string first = context.messages().first_error;
    glBindVertexArray(12345);
    EXPECT_EQ(context.messages().error_count, 2);
    EXPECT_EQ(context.messages().first_error, first);
}

TEST(GlProgram, PutsIncludedFilesInPlace) {
    const std::string source = shader_source("boxes.vert");
    EXPECT_EQ(source.find("#include"), std::string::npos);
    EXPECT_NE(source.find("struct NodeBox"), std::string::npos);
    EXPECT_THROW(shader_source("absent.vert"), std::logic_error);
}

TEST_F(GlTest, DrawsABoxWhereTheCameraPutsIt) {
    const LevelTable levels = make_level_table(root_with_leaves({{Vec3(-1.0f), Vec3(1.0f, 0.5f, 1.0f)}}));
    set_boxes(levels);
    const Image image = draw(plain_list(levels, {0, 0}), front_camera(true));
    for (const int y : {80, 100, 140}) {  // the box spans x from 50 to 150 and y from 75 to 150
        EXPECT_EQ(at(image, 50, y).red, 255) << y;
        EXPECT_EQ(at(image, 149, y).red, 255) << y;
        EXPECT_EQ(at(image, 46, y).red, 0) << y;
        EXPECT_EQ(at(image, 54, y).red, 0) << y;
        EXPECT_EQ(at(image, 153, y).red, 0) << y;
    }
    EXPECT_EQ(at(image, 100, 75).red, 255);
    EXPECT_EQ(at(image, 100, 149).red, 255);
    EXPECT_EQ(at(image, 100, 71).red, 0);
    EXPECT_EQ(at(image, 100, 100).red, 0);
}

TEST_F(GlTest, DrawsTheSameBoxForAnyPlaceAndSizeOfTheScene) {
    const auto picture = [&](float scale, const Vec3& move) {
        Mesh mesh = square(1.0f, 0.0f);
        for (Vec3& position : mesh.positions) position = position * scale + move;
        renderer_.set_mesh(mesh);
        const LevelTable levels =
            make_level_table(root_with_leaves({{Vec3(-scale) + move, Vec3(scale) + move}}));
        set_boxes(levels);
        Camera camera = front_camera(false);
        camera.eye = camera.eye * scale + move;
        camera.target = camera.target * scale + move;
        DrawList list = plain_list(levels, {0, 0});
        list.mesh = MeshLook::Shaded;
        return draw(list, camera);
    };
    const Image image = picture(1.0f, Vec3(0.0f));
    EXPECT_EQ(picture(std::ldexp(1.0f, 90), Vec3(0.0f)), image);
    EXPECT_EQ(picture(std::ldexp(1.0f, -90), Vec3(0.0f)), image);
    EXPECT_EQ(picture(1.0f, Vec3(65536.0f)), image);
}

/// What cull_boxes.comp decides, in double.
enum class Fate { Outside, UnderPixel, Visible };
Fate fate_of(const Box& box, const CameraFrame& camera, double& margin) {
    double lower[2] = {1e30, 1e30}, upper[2] = {-1e30, -1e30};
    int beyond[4] = {0, 0, 0, 0};
    margin = 1e30;
    for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x,
                      (corner & 2) != 0 ? box.upper.y : box.lower.y,
                      (corner & 4) != 0 ? box.upper.z : box.lower.z);
        const DVec3 offset = p - camera.eye;
        const double depth = glm::dot(offset, camera.forward);
        const double place[2] = {glm::dot(offset, camera.right) / (depth * camera.half_width),
                                 glm::dot(offset, camera.up) / (depth * camera.half_height)};
        for (int axis = 0; axis < 2; ++axis) {
            lower[axis] = std::min(lower[axis], place[axis]);
            upper[axis] = std::max(upper[axis], place[axis]);
            beyond[2 * axis] += place[axis] < -1.0 ? 1 : 0;
            beyond[2 * axis + 1] += place[axis] > 1.0 ? 1 : 0;
            margin = std::min(margin, std::abs(std::abs(place[axis]) - 1.0));
        }
    }
    for (const int count : beyond) {
        if (count == 8) return Fate::Outside;
    }
    const double size = 0.5 * kSize * std::max(upper[0] - lower[0], upper[1] - lower[1]);
    margin = std::min(margin, std::abs(size - 1.0));
    return size < 1.0 ? Fate::UnderPixel : Fate::Visible;
}

TEST_F(GlTest, CountsWhatItCullsAsTheCpuDoes) {
    const Camera camera = front_camera(false);
    const CameraFrame frame = camera_frame(camera, 1.0);
    Rng rng(7);
    std::vector<Box> boxes;
    BoxCounts expected;
    while (boxes.size() < 3000) {
        const float x = rng.next(), y = rng.next(), z = rng.next(), size = rng.next();
        const Vec3 lower(8.0f * x - 4.0f, 8.0f * y - 4.0f, 8.0f * z - 4.0f);
        const Box box = {lower, lower + Vec3(size * size * size * 0.5f)};
        double margin = 0.0;
        const Fate fate = fate_of(box, frame, margin);
        if (margin < 1e-4) continue;  // float may decide otherwise
        boxes.push_back(box);
        expected.outside += fate == Fate::Outside ? 1u : 0u;
        expected.under_pixel += fate == Fate::UnderPixel ? 1u : 0u;
        expected.drawn += fate == Fate::Visible ? 1u : 0u;
    }
    expected.candidates = 3000;
    const LevelTable levels = make_level_table(root_with_leaves(boxes));
    set_boxes(levels);
    draw(plain_list(levels, {1, 1}), camera);
    EXPECT_EQ(renderer_.box_counts(), expected);
    EXPECT_GT(expected.outside, 100u);
    EXPECT_GT(expected.under_pixel, 100u);
}

TEST_F(GlTest, DrawsTheLargestOnScreenWhereTheBudgetEnds) {
    std::vector<Box> boxes;  // 5000 small ones and, last, two large ones
    for (int i = 0; i < 5000; ++i) {
        const Vec3 lower(-1.5f + 0.01f * static_cast<float>(i % 100),
                         -1.0f + 0.03f * static_cast<float>(i / 100), 0.0f);
        boxes.push_back({lower, lower + Vec3(0.03f)});
    }
    boxes.push_back({Vec3(1.0f, -1.0f, 0.0f), Vec3(1.4f, -0.6f, 0.0f)});
    boxes.push_back({Vec3(1.0f, 0.6f, 0.0f), Vec3(1.4f, 1.0f, 0.0f)});
    const LevelTable levels = make_level_table(root_with_leaves(boxes));
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.box_budget = 2;
    const Image image = draw(list, front_camera(true));
    EXPECT_EQ(
        renderer_.box_counts(),
        (BoxCounts{.candidates = 5002, .drawn = 2, .outside = 0, .under_pixel = 0, .over_budget = 5000}));
    EXPECT_EQ(at(image, 150, 140).red, 255);  // left edges of the large boxes
    EXPECT_EQ(at(image, 150, 60).red, 255);
    for (int x = 10; x < 140; ++x) EXPECT_EQ(at(image, x, 100).red, 0) << x;
    list.box_budget = 4500;
    draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts().drawn, 4500u);
    EXPECT_EQ(renderer_.box_counts().over_budget, 502u);
}

/// A flat box of these pixels of the picture, seen by the orthographic front_camera.
Box pixel_box(int left, int top, int size) {
    const auto x = static_cast<float>(left - 100), y = static_cast<float>(100 - top - size);
    const auto side = static_cast<float>(size);
    return {Vec3(x, y, 0.0f) / 50.0f, Vec3(x + side, y + side, 0.0f) / 50.0f};
}

TEST_F(GlTest, OfBoxesOfOneSizeTheFirstAreDrawnAndAllLargerOnes) {
    // Equal boxes at level 1 (of 9 pixels, clear of the limits of a bin), with 5000 of their size outside the
    // view between them, and four larger ones after them: the choice runs over several groups of boxes.
    NodeList nodes = root_with_leaves({});
    const auto add = [&](const Box& box, uint32_t level) {
        nodes.nodes.push_back(node(box, 0, level, NodeKind::Leaf));
    };
    const auto small = [](int i) { return pixel_box(5 + 15 * (i % 10), 5 + 15 * (i / 10), 9); };
    for (int i = 0; i < 50; ++i) add(small(i), 1);
    for (int i = 0; i < 5000; ++i) add(pixel_box(400, 0, 9), 1);
    for (int i = 50; i < 100; ++i) add(small(i), 1);
    for (int i = 0; i < 4; ++i) add(pixel_box(160, 10 + 45 * i, 30), 2);
    LevelTable levels = make_level_table(nodes);
    // In the order of the nodes: areas that are equal on paper differ by rounding.
    for (uint32_t i = 0; i < levels.order.size(); ++i) levels.order[i] = i;
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 2});
    list.box_budget = 4 + 70;
    const Image image = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts().drawn, 74u);
    for (int i = 0; i < 100; ++i) {
        const bool is_drawn = at(image, 5 + 15 * (i % 10), 5 + 15 * (i / 10) + 4).red > 200;
        EXPECT_EQ(is_drawn, i < 70) << i;
    }
    for (int i = 0; i < 4; ++i) EXPECT_GT(at(image, 160, 25 + 45 * i).red, 200) << i;
}

TEST_F(GlTest, UploadsNothingWhenRangeColoursOrStyleChange) {
    NodeList nodes = root_with_leaves({{Vec3(-1.0f), Vec3(-0.5f)}, {Vec3(0.5f), Vec3(1.0f)}});
    const LevelTable levels = make_level_table(nodes);
    renderer_.set_mesh(square(1.0f, 0.0f));
    set_boxes(levels);
    const uint64_t uploads = renderer_.upload_count();
    EXPECT_EQ(uploads, 2u);
    const size_t bytes = renderer_.byte_count();
    DrawList list = plain_list(levels, {0, 0});
    draw(list, front_camera(true));
    const Image root_alone = draw(list, front_camera(true));
    for (const LevelRange range : {LevelRange{1, 1}, LevelRange{0, 1}}) {
        list.boxes = select_boxes(levels, range, false);
        EXPECT_NE(draw(list, front_camera(true)), root_alone);
        list.colors.meaning = BoxColor::SahShare;
        list.see_through = true;
        draw(list, front_camera(false));
    }
    EXPECT_EQ(renderer_.upload_count(), uploads);
    EXPECT_LE(renderer_.byte_count(), bytes + 3 * 44);  // room for what is drawn
}

TEST_F(GlTest, KeepsLeavesAboveTheRange) {
    // Level 1: a leaf on the left and an inner node on the right, which has a leaf at level 2.
    const Box left = {Vec3(-1.6f, -1.0f, 0.0f), Vec3(-0.6f, 1.0f, 0.0f)};
    const Box right = {Vec3(0.4f, -1.0f, 0.0f), Vec3(1.6f, 1.0f, 0.0f)};
    const Box inner = {Vec3(0.6f, -0.8f, 0.0f), Vec3(1.4f, 0.8f, 0.0f)};
    Box all = left;
    all.extend(right);
    NodeList nodes;
    nodes.nodes = {node(all, kNoIndex, 0, NodeKind::Inner), node(left, 0, 1, NodeKind::Leaf),
                   node(right, 0, 1, NodeKind::Inner), node(inner, 2, 2, NodeKind::Leaf)};
    const LevelTable levels = make_level_table(nodes);
    set_boxes(levels);
    const int left_edge = 70, right_edge = 120, inner_edge = 130;
    const auto is_drawn = [&](const Image& image, int x) { return at(image, x, 100).red > 200; };

    DrawList list = plain_list(levels, {2, 2});
    const Image with_leaves = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts().drawn, 2u);
    EXPECT_TRUE(is_drawn(with_leaves, left_edge));
    EXPECT_FALSE(is_drawn(with_leaves, right_edge));
    EXPECT_TRUE(is_drawn(with_leaves, inner_edge));

    list.boxes = select_boxes(levels, {2, 2}, false);
    const Image alone = draw(list, front_camera(true));
    EXPECT_EQ(renderer_.box_counts().candidates, 1u);
    EXPECT_FALSE(is_drawn(alone, left_edge));
    EXPECT_TRUE(is_drawn(alone, inner_edge));
}

TEST_F(GlTest, TheSurfaceHidesABoxOrDimsIt) {
    renderer_.set_mesh(square(1.0f, 1.0f));
    const LevelTable levels = make_level_table(
        root_with_leaves({{Vec3(-0.5f, -0.5f, -1.0f), Vec3(0.5f, 0.5f, -0.5f)}}));  // behind the square
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.mesh = MeshLook::Shaded;
    const Camera camera = front_camera(true);
    const auto edge_over_surface = [&] {
        const Image image = draw(list, camera);
        return difference(at(image, 75, 100), at(image, 100, 100));
    };
    EXPECT_EQ(edge_over_surface(), 0);
    list.see_through = true;
    const int dimmed = edge_over_surface();
    EXPECT_GT(dimmed, 20);
    list.mesh = MeshLook::Hidden;
    EXPECT_GT(edge_over_surface(), dimmed + 100);
    list.mesh = MeshLook::Depth;  // hides without a colour of its own
    list.see_through = false;
    EXPECT_EQ(edge_over_surface(), 0);
    EXPECT_EQ(at(draw(list, camera), 100, 100).red, 0);
}

TEST_F(GlTest, AnEdgeOnTheSurfaceStaysVisible) {
    renderer_.set_mesh(square(1.0f, 0.5f));
    const LevelTable levels =
        make_level_table(root_with_leaves({{Vec3(-0.5f, -0.5f, 0.5f), Vec3(0.5f, 0.5f, 0.5f)}}));
    set_boxes(levels);
    DrawList list = plain_list(levels, {1, 1});
    list.mesh = MeshLook::Shaded;
    for (const bool orthographic : {true, false}) {
        Camera camera = front_camera(orthographic);
        camera.eye = {5.0f, 3.0f, 8.0f};
        const Image on_surface = draw(list, camera);
        DrawList lines_alone = list;
        lines_alone.mesh = MeshLook::Hidden;
        const Image alone = draw(lines_alone, camera);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                if (at(alone, x, y).red == 255) {
                    EXPECT_EQ(at(on_surface, x, y).red, 255) << x << " " << y;
                }
            }
        }
    }
}

TEST_F(GlTest, SplitTrianglesAreRed) {
    renderer_.set_mesh(square(1.0f, 0.0f));
    const Box whole = {Vec3(-1.0f, -1.0f, 0.0f), Vec3(1.0f, 1.0f, 0.0f)};
    const PrimRef refs[] = {{whole, 0}, {whole, 1}, {whole, 1}};
    renderer_.set_references(refs, 2);
    DrawList list;
    list.axis_cross = false;
    list.red_color = Vec3(1.0f, 0.0f, 0.0f);
    const Camera camera = front_camera(true);
    const Image red = draw(list, camera);
    const Rgb plain = at(red, 130, 120);  // below the diagonal: triangle 0
    EXPECT_LT(std::abs(plain.red - plain.green) + std::abs(plain.red - plain.blue), 20);
    EXPECT_GT(at(red, 70, 80).red, 4 * at(red, 70, 80).green + 100);  // above it: triangle 1
    list.red = false;
    EXPECT_EQ(difference(at(draw(list, camera), 70, 80), at(red, 130, 120)), 0);

    list.mesh = MeshLook::Hidden;
    list.reference_boxes = true;
    draw(list, camera);
    EXPECT_EQ(renderer_.reference_box_counts().drawn, 2u);  // those of triangle 1 alone
}

TEST_F(GlTest, DrawsWireAndSelection) {
    renderer_.set_mesh(square(1.0f, 0.0f));
    DrawList list;
    list.axis_cross = false;
    list.wire = true;
    list.wire_width = 2.0f;
    const Camera camera = front_camera(true);
    const Image wire = draw(list, camera);
    EXPECT_GT(difference(at(wire, 100, 100), at(wire, 100, 130)), 60);  // the diagonal
    list.selected_prim = 1;
    list.selection_color = Vec3(0.0f, 1.0f, 0.0f);
    list.selected = Box{Vec3(-1.5f), Vec3(1.5f)};
    const Image selected = draw(list, camera);
    EXPECT_GT(at(selected, 60, 80).green, at(selected, 60, 80).red + 100);
    EXPECT_EQ(difference(at(selected, 130, 120), at(wire, 130, 120)), 0);
    EXPECT_EQ(at(selected, 25, 100).green, 255);  // edge of the selected box
}

TEST_F(GlTest, APictureStandsBehindTheBoxesRowZeroOnTop) {
    Image picture(2, 2);
    for (int x = 0; x < 2; ++x) store_linear(Vec3(1.0f, 0.0f, 0.0f), picture.pixel(x, 0));
    for (int x = 0; x < 2; ++x) store_linear(Vec3(0.0f, 0.0f, 1.0f), picture.pixel(x, 1));
    renderer_.set_picture(picture, 1);
    DrawList list;
    list.mesh = MeshLook::Depth;
    list.axis_cross = false;
    const Image behind = draw(list, front_camera(true));
    EXPECT_EQ(at(behind, 100, 10).red, 255);
    EXPECT_EQ(at(behind, 100, 190).blue, 255);
    renderer_.clear_picture();
    EXPECT_EQ(at(draw(list, front_camera(true)), 100, 10).red, 0);

    PictureRenderer pictures;
    pictures.draw(picture, 1, 1.0f, target_, {0, 0, kSize, 100}, {0, 0, 60, 100});
    store_linear(Vec3(0.0f, 1.0f, 0.0f), picture.pixel(0, 0));
    pictures.draw(picture, 1, 1.0f, target_, {100, 100, 100, 100},
                  {100, 100, 100, 100});  // the same version: not uploaded again
    const Image beside = read_pixels(target_);
    EXPECT_EQ(at(beside, 10, 5).red, 255);
    EXPECT_EQ(at(beside, 10, 95).blue, 255);
    EXPECT_EQ(at(beside, 70, 5).red, 0) << "beside its part";
    EXPECT_EQ(at(beside, 110, 105).green, 0);
    EXPECT_EQ(at(beside, 50, 150).red, 0);
}

TEST_F(GlTest, AWipeShowsTheBoxesOfEachSetInItsPartAlone) {
    // Set 0 has a small square, set 1 a large one, around the middle of one picture.
    const auto levels_of = [](float half) {
        return make_level_table(root_with_leaves({{Vec3(-half, -half, 0.0f), Vec3(half, half, 0.0f)}}));
    };
    const LevelTable small = levels_of(0.5f), large = levels_of(1.5f);
    renderer_.set_mesh(square(1.9f, -1.0f));
    renderer_.set_boxes(small, make_box_values(small.list), 0);
    renderer_.set_boxes(large, make_box_values(large.list), 1);
    const DrawList list = plain_list(small, {0, 0});
    const PixelRect all{0, 0, kSize, kSize};
    renderer_.draw(list, front_camera(true), target_, all, {0, 0, 90, kSize}, 0);
    renderer_.draw(list, front_camera(true), target_, all, {90, 0, 110, kSize}, 1);
    const Image image = read_pixels(target_);
    const auto is_lit = [&](int x, int y) { return at(image, x, y).red > 128; };
    EXPECT_TRUE(is_lit(75, 100)) << "left edge of the small one";
    EXPECT_FALSE(is_lit(25, 100)) << "left edge of the large one";
    EXPECT_FALSE(is_lit(125, 100)) << "right edge of the small one";
    EXPECT_TRUE(is_lit(175, 100)) << "right edge of the large one";
    EXPECT_EQ(renderer_.box_counts(0).drawn, 1u);
    EXPECT_EQ(renderer_.box_counts(1).drawn, 1u);
    renderer_.clear(1);
    renderer_.draw(list, front_camera(true), target_, all, {90, 0, 110, kSize}, 1);
    EXPECT_LT(at(read_pixels(target_), 175, 100).red, 128);
}

TEST_F(GlTest, DrawsOnlyIntoItsRect) {
    target_.clear(0.0f);
    DrawList list;
    list.background_top = list.background_bottom = Vec3(1.0f);
    list.axis_cross = true;
    renderer_.draw(list, front_camera(true), target_, {20, 30, 100, 50});
    const Image image = read_pixels(target_);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const bool is_inside = x >= 20 && x < 120 && y >= 30 && y < 80;
            if (!is_inside) {
                EXPECT_EQ(at(image, x, y).red, 0) << x << " " << y;
            }
        }
    }
    EXPECT_EQ(at(image, 119, 30).red, 255);
    renderer_.draw(list, front_camera(true), target_, {0, 0, 0, 50});  // an empty rect is no error
}

TEST_F(GlTest, TheSameFrameTwiceIsTheSamePicture) {
    std::vector<Box> boxes;
    Rng rng(3);
    for (int i = 0; i < 3000; ++i) {
        const float x = rng.next(), y = rng.next(), z = rng.next();
        const Vec3 lower(3.0f * x - 1.5f, 3.0f * y - 1.5f, 3.0f * z - 1.5f);
        boxes.push_back({lower, lower + Vec3(0.2f)});
    }
    const LevelTable levels = make_level_table(root_with_leaves(boxes));
    set_boxes(levels);
    DrawList list = plain_list(levels, {0, 1});
    list.see_through = true;
    list.box_budget = 1000;
    const Image first = draw(list, front_camera(false));
    EXPECT_EQ(draw(list, front_camera(false)), first);
    set_boxes(levels);
    EXPECT_EQ(draw(list, front_camera(false)), first);
}

TEST_F(GlTest, DrawsTheInterface) {
    ImGuiContext* imgui = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = ImVec2(100.0f, 100.0f);
    ImGui::GetIO().DisplayFramebufferScale = ImVec2(2.0f, 2.0f);
    UiRenderer interface;
    interface.set_fonts(*ImGui::GetIO().Fonts);
    ImGui::NewFrame();
    ImDrawList& shapes = *ImGui::GetBackgroundDrawList();
    shapes.AddRectFilled(ImVec2(10.0f, 20.0f), ImVec2(40.0f, 30.0f), IM_COL32(255, 0, 0, 255));
    shapes.PushClipRect(ImVec2(50.0f, 50.0f), ImVec2(60.0f, 60.0f));
    shapes.AddRectFilled(ImVec2(40.0f, 40.0f), ImVec2(90.0f, 90.0f), IM_COL32(0, 255, 0, 128));
    shapes.PopClipRect();
    ImGui::Render();
    target_.clear(0.0f);
    interface.draw(*ImGui::GetDrawData(), target_);
    const Image image = read_pixels(target_);
    ImGui::DestroyContext(imgui);
    EXPECT_EQ(at(image, 22, 42).red, 255);
    EXPECT_EQ(at(image, 78, 58).red, 255);
    EXPECT_EQ(at(image, 82, 58).red, 0);
    EXPECT_EQ(at(image, 22, 37).red, 0);
    EXPECT_NEAR(at(image, 110, 110).green, 128, 2);
    EXPECT_EQ(at(image, 96, 110).green, 0);
    EXPECT_EQ(at(image, 122, 110).green, 0);
}

TEST_F(GlTest, AnEmptySceneIsOnlyBackground) {
    renderer_.set_mesh(Mesh{});
    const LevelTable levels = make_level_table(NodeList{});
    set_boxes(levels);
    renderer_.set_references({}, 0);
    DrawList list = make_draw_list(ViewerState{}, levels, make_box_values(levels.list));
    list.axis_cross = false;
    list.background_top = list.background_bottom = Vec3(1.0f);
    const Image image = draw(list, front_camera(false));
    EXPECT_EQ(at(image, 100, 100).red, 255);
    EXPECT_EQ(renderer_.box_counts(), BoxCounts{});
}

}  // namespace
}  // namespace boxwood
