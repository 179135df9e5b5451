#include "app/viewer/panels.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>

#include "app/viewer/keys.h"
#include "app/viewer/ui_context.h"
#include "app/viewer/viewer.h"
#include "core/base/file.h"
#include "core/base/timer.h"

namespace boxwood {
namespace {

/// The panels over a real viewer, without OpenGL: Dear ImGui lays out and draws into lists that nobody reads.
class Panels : public testing::Test {
protected:
    Panels() : viewer_(session()) { viewer_.wait(); }

    static Session session() {
        Session session;
        session.state.scene = "cornell";
        session.state.side().recipe = "evh(t=10) > bvh-binned-sah";
        return session;
    }

    std::vector<Action> frame() {
        ui_.prepare(viewer_.state);
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {1280.0f, 720.0f};
        ImGui::NewFrame();
        const PanelInput input = viewer_.panel_input(Vec2(io.MousePos.x, io.MousePos.y));
        std::vector<Action> actions =
            edit(viewer_.state, input, make_layout(viewer_.state), viewer_.panel_memory);
        handle_keys(viewer_.state, input, viewer_.panel_memory, viewer_.camera(), false, actions);
        active_ = ImGui::IsAnyItemActive();
        ImGui::Render();
        return actions;
    }
    void settle() {
        for (int i = 0; i < 3; ++i) frame();
    }
    /// Frames with the left button held from one place to the other.
    void drag(const Vec2& from, const Vec2& to) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = {from.x, from.y};
        frame();
        io.MouseDown[0] = true;
        frame();
        EXPECT_TRUE(active_) << "nothing to drag there";
        io.MousePos = {to.x, to.y};
        frame();
        io.MouseDown[0] = false;
        frame();
    }
    std::vector<Action> press(int key, bool ctrl = false, bool shift = false) {
        ImGuiIO& io = ImGui::GetIO();
        io.KeyCtrl = ctrl;
        io.KeyShift = shift;
        if (ctrl) io.KeyMods |= ImGuiKeyModFlags_Ctrl;
        io.KeysDown[key] = true;
        std::vector<Action> actions = frame();
        io.KeysDown[key] = false;
        io.KeyCtrl = io.KeyShift = false;
        frame();
        return actions;
    }
    void type(ImWchar character) {
        ImGui::GetIO().AddInputCharacter(character);
        frame();
    }

    UiContext ui_;
    Viewer viewer_;
    bool active_ = false;
};

/// Middle of the slider of t: below the scene, the recipe's text and the combo box of the references.
constexpr Vec2 kSliderOfT(170.0f, 151.0f);

TEST_F(Panels, ADragOfTheSliderChangesTheRecipe) {
    settle();
    drag(kSliderOfT, kSliderOfT + Vec2(60.0f, 0.0f));
    const Recipe recipe = parse_recipe(viewer_.state.side().recipe);
    EXPECT_STREQ(recipe.references.entry().id, "evh");
    EXPECT_NE(viewer_.state.side().recipe, session().state.side().recipe);
    EXPECT_NE(viewer_.state.side().recipe.find("evh(t="), std::string::npos) << viewer_.state.side().recipe;
}

TEST_F(Panels, DrawWithoutSceneOrStructure) {
    ui_.prepare(viewer_.state);
    ImGui::GetIO().DisplaySize = {1280.0f, 720.0f};
    ImGui::NewFrame();
    PanelMemory memory;
    EXPECT_TRUE(edit(viewer_.state, PanelInput{}, make_layout(viewer_.state), memory).empty());
    ImGui::Render();
    EXPECT_GT(ImGui::GetDrawData()->TotalVtxCount, 100);
}

TEST_F(Panels, EditNothingByThemselves) {
    const ViewerState before = viewer_.state;
    settle();
    EXPECT_EQ(viewer_.state, before);
}

TEST_F(Panels, KeysSwitchWhatIsShown) {
    settle();
    press('B');
    EXPECT_FALSE(viewer_.state.show_boxes);
    press('T');
    EXPECT_EQ(viewer_.state.traced, TracedView::Beside);
    press('H');
    EXPECT_EQ(viewer_.state.shading, Shading::Heat);
    press(key::kTab);
    EXPECT_FALSE(viewer_.state.show_panels);
    type('?');
    EXPECT_TRUE(viewer_.state.show_keys);
}

TEST_F(Panels, BracketsMoveTheLevelRange) {
    settle();
    viewer_.state.levels = {0, 2};
    type(']');
    EXPECT_EQ(viewer_.state.levels, (LevelRange{1, 3}));
    type('{');
    EXPECT_EQ(viewer_.state.levels, (LevelRange{1, 2}));
    type('[');
    type('[');
    EXPECT_EQ(viewer_.state.levels, (LevelRange{0, 1}));
    EXPECT_EQ(moved({0, 999}, 1, false, 7), (LevelRange{0, 7}));
    EXPECT_EQ(moved({7, 7}, 1, false, 7), (LevelRange{7, 7}));
}

TEST_F(Panels, CtrlWithALetterIsACommand) {
    settle();
    const std::vector<Action> undo = press('Z', /*ctrl=*/true), redo = press('Z', true, /*shift=*/true);
    ASSERT_EQ(undo.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<UndoStep>(undo[0]));
    ASSERT_EQ(redo.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<RedoStep>(redo[0]));
    const std::vector<Action> store = press('3', true);
    ASSERT_EQ(store.size(), 1u);
    EXPECT_EQ(std::get<StoreView>(store[0]).slot, 2);
    EXPECT_TRUE(viewer_.state.show_boxes);
}

TEST_F(Panels, KeysAreTextWhileAFieldHasTheFocus) {
    settle();
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {120.0f, 108.0f};  // the recipe's text
    frame();
    io.MouseDown[0] = true;
    frame();
    io.MouseDown[0] = false;
    frame();
    ASSERT_TRUE(io.WantTextInput);
    press('B');
    type('?');
    EXPECT_TRUE(viewer_.state.show_boxes);
    EXPECT_FALSE(viewer_.state.show_keys);
    EXPECT_FALSE(viewer_.panel_memory.recipe_error.empty()) << "a '?' makes it no recipe";
    EXPECT_EQ(viewer_.state.side().recipe, session().state.side().recipe)
        << "the recipe stays until the text is one";
}

TEST_F(Panels, TheViewersActionsRunWithoutAWindow) {
    settle();
    viewer_.state.show_wire = true;
    viewer_.update(false);
    viewer_.apply({UndoStep{}});
    EXPECT_FALSE(viewer_.state.show_wire);
    viewer_.apply({RedoStep{}, CopySession{}});
    EXPECT_TRUE(viewer_.state.show_wire);
    viewer_.state.show_wire = false;
    viewer_.apply({PasteSession{}});
    EXPECT_TRUE(viewer_.state.show_wire) << "from the clipboard";
    viewer_.apply({CopyText{"{\"version\": 1, \"wire\": 3}"}, PasteSession{}});
    EXPECT_NE(viewer_.message().find("wire"), std::string::npos) << viewer_.message();
}

TEST_F(Panels, AFileThatCannotBeReadLeavesTheOldScene) {
    const auto scene = viewer_.scene();
    const auto built = viewer_.built();
    viewer_.open("./there-is-no-such-file.ply");
    viewer_.wait();
    EXPECT_EQ(viewer_.scene(), scene);
    EXPECT_EQ(viewer_.built(), built);
    EXPECT_EQ(viewer_.state.scene, "cornell");
    EXPECT_NE(viewer_.message().find("there-is-no-such-file.ply"), std::string::npos);
    viewer_.open("two-triangles");
    viewer_.wait();
    EXPECT_EQ(viewer_.state.scene, "two-triangles");
    EXPECT_EQ(viewer_.built()->scene->mesh.triangle_count(), 2u);
    EXPECT_EQ(viewer_.message(), "");
}

TEST_F(Panels, AFileThatChangedIsReadAgain) {
    const std::string path = testing::TempDir() + "panels_test.obj";
    write_file_atomically(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    viewer_.open(path);
    viewer_.wait();
    ASSERT_EQ(viewer_.scene()->mesh.triangle_count(), 1u) << viewer_.message();
    EXPECT_FALSE(viewer_.settings().recent.empty());
    const auto mesh_of = [&](const std::string& text) {
        write_file_atomically(path, text);
        viewer_.reload();
        viewer_.wait();
        return viewer_.scene()->mesh.triangle_count();
    };
    EXPECT_EQ(mesh_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n"), 2u);
    EXPECT_EQ(viewer_.built()->scene->mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh_of("no scene at all"), 2u) << "what cannot be read leaves the old scene";
    EXPECT_FALSE(viewer_.message().empty());
    std::filesystem::remove(path);
}

/// The kitchen, in a recipe that is quickly built.
class AnimatedPanels : public Panels {
protected:
    AnimatedPanels() {
        viewer_.state.side().recipe = "bvh-spatial-median";
        viewer_.open("kitchen");
        viewer_.wait();
        settle();
    }
    /// Frames of the window until the scene's spec is shown.
    bool shows(const std::string& spec) {
        for (const Timer timer; timer.milliseconds() < 10000.0;) {
            viewer_.update(false);
            if (viewer_.built()->scene->spec == spec) return true;
            frame();
        }
        return false;
    }
};

/// Middle of the slider of the frame: below the scene.
constexpr Vec2 kSliderOfFrame(100.0f, 56.0f);

TEST_F(AnimatedPanels, ADragOfTheSliderShowsAnotherFrameFromTheSameView) {
    viewer_.state.camera = Camera{.eye = {3.0f, 1.0f, 4.0f}, .target = {3.0f, 1.0f, 0.0f}};
    drag(kSliderOfFrame, kSliderOfFrame + Vec2(20.0f, 0.0f));
    ASSERT_TRUE(viewer_.state.scene.starts_with("kitchen@frame=")) << viewer_.state.scene;
    ASSERT_TRUE(shows(viewer_.state.scene));
    EXPECT_EQ(viewer_.camera().eye, Vec3(3.0f, 1.0f, 4.0f));
    EXPECT_EQ(viewer_.state.side().recipe, "bvh-spatial-median");
    viewer_.apply({UndoStep{}});
    EXPECT_TRUE(shows("kitchen")) << "a drag is one step";
}

TEST_F(AnimatedPanels, PlayShowsOneFrameAfterAnotherAndIsOneStepOfUndo) {
    viewer_.state.scene = "kitchen@frame=118";
    ASSERT_TRUE(shows("kitchen@frame=118"));
    viewer_.update(false);
    viewer_.panel_memory.playing = true;
    EXPECT_TRUE(viewer_.busy());
    ImGui::GetIO().DeltaTime = 0.1f;
    for (const char* spec : {"kitchen@frame=119", "kitchen", "kitchen@frame=1"})
        ASSERT_TRUE(shows(spec)) << spec;
    viewer_.panel_memory.playing = false;
    viewer_.update(false);
    viewer_.apply({UndoStep{}});
    EXPECT_TRUE(shows("kitchen@frame=118"));
    viewer_.panel_memory.playing = true;
    viewer_.open("cornell");
    viewer_.wait();
    frame();
    EXPECT_FALSE(viewer_.panel_memory.playing) << "nothing to play";
}

TEST_F(Panels, ACancelledBuildKeepsWhatIsShown) {
    const auto built = viewer_.built();
    viewer_.state.side().recipe = "evh(t=30) > bvh-sweep-sah";
    viewer_.update(false);
    EXPECT_TRUE(viewer_.busy());
    viewer_.apply({CancelWork{}});
    for (const Timer timer; viewer_.busy() && timer.milliseconds() < 5000.0;) viewer_.update(false);
    EXPECT_FALSE(viewer_.busy()) << "nothing is under way after a cancel";
    EXPECT_EQ(viewer_.built(), built);
    EXPECT_TRUE(viewer_.panel_input(Vec2(-1.0f)).cancelled);
    viewer_.apply({BuildAgain{}});
    viewer_.wait();
    EXPECT_EQ(print(viewer_.built()->recipe), viewer_.state.side().recipe);
}

TEST_F(Panels, LayoutLeavesTheWholeFrameToTheViewWherePanelsAreHidden) {
    ViewerState state;
    state.show_panels = false;
    EXPECT_EQ(make_layout(state).sides[0].scene.part, (ViewRect{0.0f, 0.0f, 1280.0f, 720.0f}));
    state.traced = TracedView::Beside;
    const FrameLayout beside = make_layout(state);
    EXPECT_EQ(beside.sides[0].scene.part.width, beside.sides[0].traced.part.width);
    EXPECT_EQ(beside.sides[0].traced.part.x + beside.sides[0].traced.part.width, 1280.0f);
    state.show_panels = true;
    state.width = 300;
    EXPECT_EQ(make_layout(state).left.width, 0.0f) << "no room for panels";
}

}  // namespace
}  // namespace boxwood
