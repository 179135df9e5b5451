// Two recipes in one window, through the real frame.
#include <gtest/gtest.h>
#include <imgui.h>

#include "app/command/shown_recipes.h"
#include "app/viewer/headless.h"
#include "app/viewer/measures.h"
#include "core/base/error.h"
#include "core/render/color_map.h"
#include "core/render/image_compare.h"

namespace boxwood {
namespace {

Session session_of(const std::string& a, const std::string& b) {
    Session session;
    session.state.scene = "cornell";
    session.state.sides[0].recipe = a;
    session.state.sides[1].recipe = b;
    session.state.levels = {0, 999};
    session.state.show_times = false;
    return session;
}

/// cornell by two builders, 684 x 696 pixels between the panels, the bar at x = 638.
class Comparing : public testing::Test {
protected:
    Comparing() : viewer_(session_of("bvh-object-median", "bvh-sweep-sah(max-leaf-size=1)")) {
        headless_.frame().capture(viewer_);
    }
    ~Comparing() override { EXPECT_EQ(headless_.messages().first_error, ""); }

    void frame() { headless_.frame().draw(viewer_); }
    void mouse(const Vec2& at, bool down) {
        ImGui::GetIO().MousePos = {at.x, at.y};
        ImGui::GetIO().MouseDown[0] = down;
        frame();
    }
    void click(const Vec2& at) {
        mouse(at, false);
        mouse(at, true);
        mouse(at, false);
        ImGui::GetIO().DeltaTime = 1.0f;  // the next one is no double click
        frame();
        ImGui::GetIO().DeltaTime = 1.0f / 60.0f;
    }
    void press(int key) {
        ImGui::GetIO().KeysDown[key] = true;
        frame();
        ImGui::GetIO().KeysDown[key] = false;
        frame();
    }
    const ViewerState& state() const { return viewer_.state; }
    const Built& built(Side side) const { return *viewer_.work(side).built(); }

    Headless headless_;
    Viewer viewer_;
};

TEST_F(Comparing, EachSideShowsItsOwnStructure) {
    EXPECT_EQ(print(built(Side::A).recipe), "bvh-object-median");
    EXPECT_EQ(print(built(Side::B).recipe), "bvh-sweep-sah(max-leaf-size=1)");
    EXPECT_EQ(viewer_.built(), viewer_.work(Side::A).built());
    viewer_.state.active = Side::B;
    EXPECT_EQ(viewer_.built(), viewer_.work(Side::B).built());
    const BoxRanges ranges = viewer_.box_ranges();
    for (const Side side : kSides) {
        const BoxValues& values = *viewer_.work(side).values();
        EXPECT_LE(ranges.references.lower, values.references_range.lower);
        EXPECT_GE(ranges.references.upper, values.references_range.upper);
        EXPECT_LE(ranges.sah_share.lower, values.sah_share_range.lower);
        EXPECT_GE(ranges.deepest, static_cast<int>(built(side).levels->level_count()) - 1);
    }
    const auto colors_of = [&](Side side) {
        return make_draw_list(state(), side, *built(side).levels, viewer_.work(side).rays.cast(), ranges)
            .colors.scale;
    };
    for (const BoxColor meaning : {BoxColor::Level, BoxColor::Primitives, BoxColor::SahShare}) {
        viewer_.state.box_color = meaning;
        EXPECT_EQ(colors_of(Side::A), colors_of(Side::B)) << "one scale for both";
    }
}

TEST(Compare, AWipeIsTheLeftOfAAndTheRightOfB) {
    Headless headless;
    const auto capture = [&](const std::string& a, const std::string& b) {
        Session session = session_of(a, b);
        session.state.levels = {1, 3};
        session.state.show_panels = false;
        session.state.width = session.state.height = 300;
        session.state.camera = Camera{.eye = {2.78f, 2.73f, -8.0f}, .target = {2.78f, 2.73f, 2.8f}};
        return headless.capture(session);
    };
    const std::string recipe_a = "bvh-object-median", recipe_b = "evh(t=12) > bvh-sweep-sah";
    const Image wipe = capture(recipe_a, recipe_b), a = capture(recipe_a, ""), b = capture(recipe_b, "");
    uint64_t differs = 0;
    for (int y = 60; y < 300; ++y) {  // below the labels
        for (int x = 0; x < 300; ++x) {
            if (std::abs(x - 150) < 20) continue;  // the bar and its handle
            const uint8_t* expected = x < 150 ? a.pixel(x, y) : b.pixel(x, y);
            ASSERT_TRUE(std::equal(expected, expected + 4, wipe.pixel(x, y))) << x << ", " << y;
            differs += std::equal(expected, expected + 4, x < 150 ? b.pixel(x, y) : a.pixel(x, y)) ? 0 : 1;
        }
    }
    EXPECT_GT(differs, 500u) << "both look alike";
}

TEST(Compare, TheSameRecipeTwiceIsZeroEverywhere) {
    Headless headless;
    Session session = session_of("evh(t=12) > bvh-binned-sah", "evh(t=12) > bvh-binned-sah");
    ViewerState& s = session.state;
    s.traced = TracedView::Over;
    s.heat_difference = true;
    s.show_boxes = false;
    s.width = 820;
    s.height = 320;
    for (const Shading shading : {Shading::Heat, Shading::HeatTests, Shading::HeatExact}) {
        s.shading = shading;
        s.show_times = shading == Shading::Heat;  // timing takes a second
        Viewer viewer(session);
        headless.frame().capture(viewer);
        ASSERT_TRUE(viewer.heat());
        const Image& picture = viewer.heat()->difference;
        EXPECT_EQ(picture.width, 180);
        EXPECT_EQ(viewer.heat()->known, picture.pixel_count());
        EXPECT_EQ(viewer.heat()->more_in_a + viewer.heat()->more_in_b, 0u);
        Image zero(1, 1);
        store_srgb(diverging_srgb(0.0f, true), zero.pixel(0, 0));
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                ASSERT_TRUE(std::equal(zero.rgba.begin(), zero.rgba.end(), picture.pixel(x, y)));
        EXPECT_EQ(viewer.heat()->images[0], viewer.heat()->images[1]);
        const PanelInput input = viewer.panel_input(Vec2(-1.0f));
        const std::vector<MeasurePair> pairs =
            pairs_of(measures_of(viewer.state, input, Side::A), measures_of(viewer.state, input, Side::B));
        EXPECT_EQ(pairs.size(), s.show_times ? 18u : 16u);
        for (const MeasurePair& pair : pairs) EXPECT_EQ(pair.difference(), 0.0) << pair.a.key;
    }
}

TEST_F(Comparing, TheDifferenceIsThatOfTheCountsOfBothStructures) {
    press('J');
    ASSERT_TRUE(state().shows_difference());
    EXPECT_EQ(state().traced, TracedView::Beside);
    viewer_.wait();
    ASSERT_TRUE(viewer_.heat());
    const ViewRect view = make_layout(state()).side(Side::A).traced.rect;
    const std::vector<Ray> rays =
        picture_rays(viewer_.camera(), static_cast<int>(view.width), static_cast<int>(view.height));
    std::array<std::vector<Count>, 2> counts;
    for (const Side side : kSides) {
        std::vector<Hit> hits(rays.size());
        counts[index_of(side)].resize(rays.size());
        built(side).structure.closest_hits_counted(viewer_.scene()->mesh, rays, hits, counts[index_of(side)],
                                                   Mode::Exact, Task{});
    }
    uint64_t more_in_a = 0, more_in_b = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        more_in_a += counts[0][i].nodes > counts[1][i].nodes ? 1 : 0;
        more_in_b += counts[0][i].nodes < counts[1][i].nodes ? 1 : 0;
    }
    EXPECT_EQ(viewer_.heat()->known, rays.size());
    EXPECT_EQ(viewer_.heat()->more_in_a, more_in_a);
    EXPECT_EQ(viewer_.heat()->more_in_b, more_in_b);
    EXPECT_GT(more_in_a + more_in_b, 1000u);
    const PanelInput input = viewer_.panel_input({view.x + 100.5f, view.y + 200.5f});
    const size_t pixel = size_t{200} * static_cast<size_t>(view.width) + 100;
    for (const Side side : kSides) {
        ASSERT_TRUE(input.side(side).pixel);
        EXPECT_EQ(input.side(side).pixel->count.nodes, counts[index_of(side)][pixel].nodes);
    }
}

TEST_F(Comparing, TheBarIsDraggedAndTheDragIsOneStep) {
    const Camera camera = viewer_.camera();
    mouse({616.0f, 300.0f}, false);
    mouse({616.0f, 300.0f}, true);
    for (float x = 618.0f; x <= 738.0f; x += 24.0f) mouse({x, 310.0f}, true);
    EXPECT_TRUE(headless_.frame().editing());
    mouse({738.0f, 310.0f}, true);
    mouse({738.0f, 310.0f}, false);
    EXPECT_NEAR(state().wipe, 442.0f / 640.0f, 1e-4f);
    EXPECT_EQ(viewer_.camera(), camera) << "the camera stays";
    EXPECT_EQ(state().side().node, kNoIndex) << "it is no click";
    mouse({900.0f, 310.0f}, false);
    viewer_.apply({UndoStep{}});
    EXPECT_EQ(state().wipe, 0.5f);
    mouse({616.0f, 300.0f}, false);
    mouse({616.0f, 300.0f}, true);
    mouse({1200.0f, 300.0f}, true);
    mouse({1200.0f, 300.0f}, false);
    EXPECT_EQ(state().wipe, 1.0f) << "it stays in the picture";
}

TEST(WipeBar, IsHitWithinItsReach) {
    ViewerState state = session_of("bvh-sweep-sah", "bvh-sweep-sah").state;
    FrameLayout layout = make_layout(state);
    ASSERT_TRUE(layout.bars[0]);
    EXPECT_EQ(layout.bars[0]->x, 616.0f);
    EXPECT_TRUE(bar_at(layout, {610.0f, 10.0f}, 1.0f));
    EXPECT_TRUE(bar_at(layout, {622.0f, 690.0f}, 1.0f));
    EXPECT_FALSE(bar_at(layout, {609.0f, 10.0f}, 1.0f));
    EXPECT_TRUE(bar_at(layout, {605.0f, 10.0f}, 2.0f)) << "at twice the scale";
    EXPECT_FALSE(bar_at(layout, {616.0f, 700.0f}, 1.0f)) << "the status line";
    EXPECT_EQ(wipe_at(*layout.bars[0], 296.0f), 0.0f);
    EXPECT_EQ(wipe_at(*layout.bars[0], 456.0f), 0.25f);
    EXPECT_EQ(wipe_at(*layout.bars[0], 9999.0f), 1.0f);

    state.traced = TracedView::Beside;
    layout = make_layout(state);
    EXPECT_TRUE(bar_at(layout, {456.0f, 10.0f}, 1.0f));
    EXPECT_TRUE(bar_at(layout, {776.0f, 10.0f}, 1.0f)) << "the traced picture has one too";
    state.shading = Shading::Heat;
    state.heat_difference = true;
    EXPECT_FALSE(bar_at(make_layout(state), {776.0f, 10.0f}, 1.0f)) << "the difference is of both";
    state.compare_view = CompareView::Beside;
    EXPECT_FALSE(make_layout(state).bars[0]);
    state.sides[1].recipe.clear();
    EXPECT_FALSE(make_layout(state).bars[0]);
}

TEST(CompareLayout, BothPicturesHaveOneSizeAndShareTheView) {
    for (const CompareView view : {CompareView::Wipe, CompareView::Beside}) {
        for (const TracedView traced : {TracedView::Off, TracedView::Beside, TracedView::Over}) {
            for (const bool difference : {false, true}) {
                ViewerState state = session_of("bvh-sweep-sah", "bvh-sweep-sah").state;
                state.compare_view = view;
                state.traced = traced;
                state.shading = Shading::Heat;
                state.heat_difference = difference;
                state.wipe = 0.3f;
                const FrameLayout layout = make_layout(state);
                const auto &a = layout.side(Side::A), &b = layout.side(Side::B);
                EXPECT_EQ(a.scene.rect.width, b.scene.rect.width);
                EXPECT_EQ(a.scene.rect.height, b.scene.rect.height);
                EXPECT_EQ(a.traced.rect.width, b.traced.rect.width);
                EXPECT_EQ(a.traced.rect.height, b.traced.rect.height);
                float seen = 0.0f;
                for (const SideLayout* side : {&a, &b}) {
                    seen += side->scene.part.width * side->scene.part.height;
                    if (traced == TracedView::Beside && !(state.shows_difference() && side == &b))
                        seen += side->traced.part.width * side->traced.part.height;
                }
                EXPECT_EQ(seen, layout.view.width * layout.view.height);
                EXPECT_EQ(picture_at(layout, {310.0f, 100.0f})->side, Side::A);
                EXPECT_FALSE(picture_at(layout, {10.0f, 100.0f}));
            }
        }
    }
}

TEST_F(Comparing, AClickSelectsInTheTreeOfItsSide) {
    const Vec2 left(560.0f, 400.0f), right(716.0f, 400.0f);
    click(right);
    EXPECT_EQ(state().active, Side::B);
    const uint32_t node_b = state().side(Side::B).node;
    ASSERT_LT(node_b, built(Side::B).levels->list.nodes.size());
    EXPECT_EQ(state().side(Side::A).node, kNoIndex);
    PickPoint point{right, make_layout(state()).side(Side::B).scene.rect, viewer_.camera(), 1e30f};
    const Ray ray = pointer_ray(point.camera, point.pointer, point.view);
    Hit hit;
    built(Side::B).structure.closest_hits(viewer_.scene()->mesh, std::span(&ray, 1), std::span(&hit, 1),
                                          Mode::Exact, Task{});
    point.surface_t = hit.t;
    EXPECT_EQ(node_b, pick_nodes(state(), *built(Side::B).levels, Visibility{}, nullptr, point).front());
    click(left);
    EXPECT_EQ(state().active, Side::A);
    EXPECT_LT(state().side(Side::A).node, built(Side::A).levels->list.nodes.size());
    EXPECT_EQ(state().side(Side::B).node, node_b) << "the other selection stays";
    EXPECT_EQ(viewer_.panel_input(right).pointed_side, Side::B);
    EXPECT_EQ(viewer_.panel_input(left).pointed_side, Side::A);
}

TEST_F(Comparing, SwappedEverythingChangesSidesAndNothingIsBuiltAgain) {
    viewer_.state.traced = TracedView::Over;
    viewer_.state.shading = Shading::Heat;
    viewer_.wait();
    const auto a = viewer_.work(Side::A).built(), b = viewer_.work(Side::B).built();
    const uint64_t more_in_a = viewer_.heat()->more_in_a, more_in_b = viewer_.heat()->more_in_b;
    const uint64_t runs = viewer_.cache().run_count();
    viewer_.state.sides[0].node = 3;
    frame();
    press('S');
    EXPECT_EQ(state().side(Side::A).recipe, "bvh-sweep-sah(max-leaf-size=1)");
    EXPECT_EQ(state().side(Side::B).recipe, "bvh-object-median");
    EXPECT_EQ(state().side(Side::B).node, 3u);
    EXPECT_EQ(state().active, Side::B) << "the panels show what they showed";
    EXPECT_EQ(viewer_.work(Side::A).built(), b);
    EXPECT_EQ(viewer_.work(Side::B).built(), a);
    viewer_.wait();
    EXPECT_EQ(viewer_.cache().run_count(), runs);
    EXPECT_EQ(viewer_.heat()->more_in_a, more_in_b);
    EXPECT_EQ(viewer_.heat()->more_in_b, more_in_a);
    viewer_.apply({UndoStep{}});
    viewer_.wait();
    EXPECT_EQ(state().side(Side::A).recipe, "bvh-object-median");
    EXPECT_EQ(viewer_.work(Side::A).built(), a);
    EXPECT_EQ(viewer_.heat()->more_in_a, more_in_a);
}

TEST_F(Comparing, KeysTurnItOnAndOffAndUndoBringsItBack) {
    press('C');
    EXPECT_FALSE(state().compares());
    EXPECT_FALSE(viewer_.work(Side::B).built());
    viewer_.wait();
    viewer_.apply({UndoStep{}});
    viewer_.wait();
    EXPECT_EQ(state().side(Side::B).recipe, "bvh-sweep-sah(max-leaf-size=1)");
    EXPECT_TRUE(viewer_.work(Side::B).built());
    press('A');
    EXPECT_EQ(state().active, Side::B);
    press('G');
    EXPECT_EQ(state().compare_view, CompareView::Beside);
    press('C');
    press('C');
    EXPECT_EQ(state().side(Side::B).recipe, "bvh-sweep-sah(max-leaf-size=1)") << "B is what it was";
    viewer_.panel_memory.last_b.clear();
    press('C');
    viewer_.panel_memory.last_b.clear();
    press('C');
    EXPECT_EQ(state().side(Side::B).recipe, state().side(Side::A).recipe) << "B begins as a copy of A";
}

TEST_F(Comparing, ABadRecipeOfBLeavesAAndWhatBShowed) {
    const auto a = viewer_.work(Side::A).built(), b = viewer_.work(Side::B).built();
    viewer_.state.sides[1].recipe = "bvh-swoop-sah";
    EXPECT_THROW(viewer_.wait(), Error);
    EXPECT_EQ(viewer_.work(Side::A).built(), a);
    EXPECT_EQ(viewer_.work(Side::B).built(), b);
    EXPECT_NE(viewer_.panel_input(Vec2(-1.0f)).side(Side::B).build_error, "");
    EXPECT_EQ(viewer_.panel_input(Vec2(-1.0f)).side(Side::A).build_error, "");
    viewer_.state.sides[1].recipe = "bvh-binned-sah";
    viewer_.wait();
    EXPECT_EQ(viewer_.work(Side::A).built(), a) << "only B is built";
    EXPECT_EQ(print(viewer_.work(Side::B).built()->recipe), "bvh-binned-sah");
}

TEST(ShownRecipes, TwoAreCompared) {
    ViewerState state;
    show_recipes({}, state);
    EXPECT_EQ(state, ViewerState{});
    show_recipes({"whole > bvh-sweep-sah", "evh(t=16) > bvh-sweep-sah"}, state);
    EXPECT_EQ(state.side(Side::A).recipe, "bvh-sweep-sah");
    EXPECT_EQ(state.side(Side::B).recipe, "evh(t=16) > bvh-sweep-sah");
    show_recipes({"bvh-binned-sah"}, state);
    EXPECT_EQ(state.side(Side::A).recipe, "bvh-binned-sah");
    EXPECT_FALSE(state.compares());
    EXPECT_THROW(show_recipes({"grid", "octree", "bsp"}, state), Error);
    EXPECT_THROW(show_recipes({"grid", "octre"}, state), Error);
}

}  // namespace
}  // namespace boxwood
