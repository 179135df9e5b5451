// Clicks, keys and requests that cast rays, through the real frame.
#include <gtest/gtest.h>
#include <imgui.h>

#include "app/viewer/headless.h"
#include "app/viewer/ui_context.h"

namespace boxwood {
namespace {

class Selecting : public testing::Test {
protected:
    Selecting() : viewer_(session()) { headless_.frame().capture(viewer_); }
    ~Selecting() override { EXPECT_EQ(headless_.messages().first_error, ""); }

    static Session session() {
        Session session;
        session.state.scene = "cornell";
        session.state.side().recipe = "bvh-binned-sah(max-leaf-size=2)";
        session.state.levels = {0, 999};
        return session;
    }
    void frame() {
        headless_.frame().draw(viewer_);
        viewer_.wait();
    }
    /// The pointer is moved there first; time passes, so that two clicks are no double click.
    void click(const Vec2& at, bool shift = false) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {at.x, at.y};
        io.KeyShift = shift;
        frame();
        io.MouseDown[0] = true;
        frame();
        io.MouseDown[0] = false;
        frame();
        io.KeyShift = false;
        io.DeltaTime = 1.0f;
        frame();
        io.DeltaTime = 1.0f / 60.0f;
    }
    void press(int key, bool shift = false) {
        ImGuiIO& io = ImGui::GetIO();
        io.KeyShift = shift;
        io.KeysDown[key] = true;
        frame();
        io.KeysDown[key] = false;
        io.KeyShift = false;
        frame();
    }
    const ViewerState& state() const { return viewer_.state; }
    const NodeList& nodes() const { return viewer_.built()->levels->list; }

    Headless headless_;
    Viewer viewer_;
    Vec2 middle_{640.0f, 400.0f};  // of the view, on the room's back wall or a block before it
};

TEST_F(Selecting, AClickSelectsANodeAndTheNextClickThereAnother) {
    click(middle_);
    const uint32_t first = state().side().node;
    ASSERT_LT(first, nodes().nodes.size());
    EXPECT_EQ(state().side_panel, SidePanel::Node);
    click(middle_);
    EXPECT_NE(state().side().node, first);
    click({310.0f, 20.0f});  // beside the scene
    EXPECT_EQ(state().side().node, kNoIndex);
    viewer_.apply({UndoStep{}});
    EXPECT_NE(state().side().node, kNoIndex) << "a selection is a step to undo";
}

TEST_F(Selecting, ADragSelectsNothing) {
    ImGuiIO& io = ImGui::GetIO();
    for (const bool down : {false, true}) {
        io.MousePos = {middle_.x, middle_.y};
        io.MouseDown[0] = down;
        frame();
    }
    io.MousePos.x += 40.0f;
    frame();
    io.MousePos.x -= 40.0f;
    frame();
    io.MouseDown[0] = false;
    frame();
    EXPECT_EQ(state().side().node, kNoIndex);
}

TEST_F(Selecting, ArrowsWalkTheTree) {
    viewer_.state.side().node = 0;
    frame();
    press(key::kDown);
    const uint32_t child = state().side().node;
    EXPECT_EQ(nodes().nodes[child].parent, 0u);
    press(key::kRight);
    EXPECT_NE(state().side().node, child);
    EXPECT_EQ(nodes().nodes[state().side().node].parent, 0u);
    press(key::kLeft);
    EXPECT_EQ(state().side().node, child);
    press(key::kUp);
    EXPECT_EQ(state().side().node, 0u);
    press(key::kUp);
    EXPECT_EQ(state().side().node, 0u);
    press(key::kEscape);
    EXPECT_EQ(state().side().node, kNoIndex);
}

TEST_F(Selecting, HidingAndIsolatingChangeThePictureAndArePutBack) {
    const Image whole = headless_.frame().capture(viewer_);
    viewer_.state.side().node = 1;
    frame();
    press(key::kDelete);
    EXPECT_EQ(state().side().hidden_nodes, (std::vector<uint32_t>{1}));
    EXPECT_EQ(state().side().node, kNoIndex);
    const Image hidden = headless_.frame().capture(viewer_);
    EXPECT_NE(hidden, whole);
    EXPECT_FALSE(viewer_.visibility()->shows(1));
    press(key::kDelete, /*shift=*/true);
    EXPECT_TRUE(state().side().hidden_nodes.empty());
    viewer_.state.side_panel = SidePanel::Levels;
    EXPECT_EQ(headless_.frame().capture(viewer_).rgba.size(), whole.rgba.size());

    viewer_.state.side().node = 1;
    frame();
    press('I');
    EXPECT_EQ(state().side().isolated, 1u);
    EXPECT_FALSE(viewer_.visibility()->shows(0));
    EXPECT_TRUE(viewer_.visibility()->shows(1));
    EXPECT_LT(headless_.frame().scene_renderer().box_counts().drawn, nodes().nodes.size() - 1);
    press('I');
    EXPECT_EQ(state().side().isolated, kNoIndex);
}

TEST_F(Selecting, FocusLooksAtTheSelectedNode) {
    viewer_.state.side().node = static_cast<uint32_t>(nodes().nodes.size()) - 1;
    frame();
    press('F');
    const DVec3 center = nodes().nodes[state().side().node].bounds.center();
    EXPECT_LT(glm::distance(DVec3(viewer_.camera().target), center), 1e-3);
}

TEST_F(Selecting, AnotherRecipeForgetsNodesUndoBringsThemBack) {
    click(middle_);
    viewer_.state.side().hidden_nodes = {3};
    frame();
    const ViewerState before = state();
    viewer_.state.side().recipe = "bvh-sweep-sah";
    frame();
    EXPECT_EQ(state().side().node, kNoIndex);
    EXPECT_TRUE(state().side().hidden_nodes.empty());
    viewer_.apply({UndoStep{}});
    frame();
    EXPECT_EQ(state(), before);
}

TEST_F(Selecting, ShiftClickCastsARayAndCountsItsVisits) {
    click(middle_, /*shift=*/true);
    ASSERT_TRUE(state().ray);
    EXPECT_EQ(state().box_color, BoxColor::Visits);
    ASSERT_TRUE(viewer_.cast().visits);
    const Visits& visits = *viewer_.cast().visits;
    EXPECT_EQ(visits.ray_count, 1u);
    EXPECT_EQ(visits.by_node[0], 1u);
    EXPECT_TRUE(viewer_.cast().ray_hit.is_hit());
    EXPECT_LT(visits.visited_nodes, nodes().nodes.size());
    const PickedRay first = *state().ray;
    click(middle_ + Vec2(30.0f, 0.0f));
    EXPECT_NE(*state().ray, first) << "where boxes show a ray's visits a click picks the ray";
    press('V');
    EXPECT_EQ(state().visit_rays, VisitRays::Picture);
    press('V');
    EXPECT_EQ(state().box_color, BoxColor::Level);
}

TEST_F(Selecting, VisitsOfThePictureAreTheSumOfItsRays) {
    viewer_.state.box_color = BoxColor::Visits;
    viewer_.state.visit_rays = VisitRays::Picture;
    viewer_.wait();
    ASSERT_TRUE(viewer_.cast().visits);
    const ViewRect view = make_layout(state()).side(Side::A).scene.rect;
    const int width = static_cast<int>(view.width), height = static_cast<int>(view.height);
    const std::vector<Ray> rays = picture_rays(viewer_.camera(), width, height);
    std::vector<Hit> hits(rays.size());
    std::vector<Count> counts(rays.size());
    viewer_.built()->structure.closest_hits_counted(viewer_.scene()->mesh, rays, hits, counts, Mode::Exact,
                                                    Task{});
    uint64_t expected = 0, sum = 0;
    for (const Count& count : counts) expected += count.nodes;
    for (const uint32_t count : viewer_.cast().visits->by_node) sum += count;
    EXPECT_EQ(sum, expected);
    EXPECT_EQ(viewer_.cast().visits->ray_count, rays.size());
}

TEST_F(Selecting, VerifyIsOfTheViewItWasAskedFor) {
    viewer_.state.side_panel = SidePanel::Verify;
    viewer_.state.traced = TracedView::Beside;
    viewer_.state.show_times = false;  // nothing to time
    viewer_.state.verify_rays = 200;
    viewer_.wait();
    ASSERT_TRUE(viewer_.check());
    EXPECT_EQ(viewer_.check()->checked, 200u);
    EXPECT_EQ(viewer_.check()->width, 320);
    EXPECT_EQ(viewer_.check()->modes[0].wrong(), 0u);
    const auto check = viewer_.check();
    viewer_.state.mode = Mode::Fast;
    viewer_.wait();
    EXPECT_EQ(viewer_.check(), check) << "it is of both modes";
    viewer_.state.camera = viewer_.camera();
    viewer_.state.camera->eye.x += 1.0f;
    viewer_.wait();
    EXPECT_EQ(state().verify_rays, 0) << "another view takes it back";
    EXPECT_FALSE(viewer_.check());
    viewer_.apply({UndoStep{}});
    viewer_.wait();
    EXPECT_EQ(viewer_.check(), check) << "and back it is there, without being made again";
    viewer_.apply({CancelCheck{}});
    EXPECT_EQ(state().verify_rays, 0);
}

}  // namespace
}  // namespace boxwood
