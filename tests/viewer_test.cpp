#include <gtest/gtest.h>
#include <imgui.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/command/commands.h"
#include "app/gl/read_pixels.h"
#include "app/viewer/headless.h"
#include "core/base/file.h"
#include "core/render/image_compare.h"
#include "core/render/png.h"
#include "support/temporary_folder.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

Session small_session() {
    Session session;
    session.state.scene = "two-triangles@subdivide=4";
    session.state.side().recipe = "evh(t=10) > bvh-binned-sah";
    session.state.width = 820;
    session.state.height = 420;
    return session;
}

uint64_t different_pixels(const Image& a, const Image& b) {
    const Comparison comparison = compare_images(a, b);
    EXPECT_TRUE(comparison.same_size);
    return comparison.different_pixels;
}

TEST(ViewerFrame, ADragOfTheSliderOfTRebuildsAndDrawsAnotherPicture) {
    Headless headless;
    Viewer viewer(small_session());
    const Image before = headless.frame().capture(viewer);
    const auto built = viewer.built();

    ImGuiIO& io = ImGui::GetIO();
    const auto frame = [&](float x, bool down) {
        io.MousePos = {x, 151.0f};
        io.MouseDown[0] = down;
        headless.frame().draw(viewer);
    };
    frame(170.0f, false);
    frame(170.0f, true);
    for (float x = 172.0f; x <= 230.0f; x += 4.0f) frame(x, true);
    EXPECT_TRUE(headless.frame().editing());
    frame(230.0f, false);
    viewer.wait();
    EXPECT_NE(viewer.built(), built);
    EXPECT_EQ(print(viewer.built()->recipe), viewer.state.side().recipe);
    EXPECT_GT(viewer.built()->references->refs.size(), built->references->refs.size());

    const Image after = headless.frame().capture(viewer);
    EXPECT_GT(different_pixels(before, after), 1000u);
    viewer.apply({UndoStep{}});
    EXPECT_EQ(viewer.state.side().recipe, small_session().state.side().recipe) << "the drag is one step";
    EXPECT_EQ(headless.messages().first_error, "");
}

TEST(Viewer, TheBetterTreeReplacesItsStandInAndAllElseStays) {
    Session session;
    session.state.scene = "spaceship";
    session.state.side().recipe = "evh(t=6) > best";
    session.state.levels = {.first = 2, .last = 3};
    session.state.camera = Camera{};
    Viewer viewer(session);
    const auto shown = [&] { return viewer.built() ? print(viewer.built()->recipe) : std::string(); };
    const auto update_until = [&](const std::string& recipe) {
        for (viewer.update(true); shown() != recipe; viewer.update(true)) {
            EXPECT_TRUE(viewer.busy());
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    };
    update_until("evh(t=6) > preview");
    const NodeList& before = viewer.built()->levels->list;
    const uint32_t node = 5;
    const Box picked = before.nodes[node].bounds;
    viewer.state.side().node = node;
    viewer.state.prim = 7;
    ViewerState expected = viewer.state;
    update_until("evh(t=6) > best");
    const uint32_t found = viewer.state.side().node;
    ASSERT_NE(found, kNoIndex);
    EXPECT_TRUE(viewer.built()->levels->list.nodes[found].bounds.contains(picked));
    expected.side().node = found;
    EXPECT_EQ(viewer.state, expected);

    // From one position of the slider to the next there is always a structure to be drawn.
    viewer.state.side().recipe = "evh(t=12) > best";
    viewer.update(true);
    EXPECT_EQ(shown(), "evh(t=6) > best");
    update_until("evh(t=12) > preview");
    update_until("evh(t=12) > best");
    viewer.wait();
    EXPECT_EQ(viewer.state.levels, session.state.levels);
    EXPECT_EQ(viewer.state.camera, session.state.camera);
}

TEST(Viewer, NodesOfASessionAreNotThoseOfAStandIn) {
    Session session;
    session.state.scene = "spaceship";
    session.state.side().recipe = "best";
    session.state.side().node = 9;
    Viewer viewer(session);
    while (!viewer.built()) {
        viewer.update(false);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(print(viewer.built()->recipe), "best");
    EXPECT_EQ(viewer.state.side().node, 9u);
}

TEST(ViewerFrame, TheLookDependsOnTheSessionAlone) {
    Session session = small_session();
    session.state.show_times = false;
    session.state.traced = TracedView::Beside;
    session.state.shading = Shading::Heat;
    Headless headless;
    const Image first = headless.capture(session);
    Session other = session;
    other.state.scene = "cornell";
    other.state.theme = Theme::Light;
    other.state.interface_scale = 0.75f;
    EXPECT_GT(different_pixels(first, headless.capture(other)), 1000u);
    EXPECT_EQ(headless.capture(session), first);
}

TEST(ViewerFrame, ATracedPictureIsNeverThatOfTheSessionBefore) {
    Session session = small_session();
    session.state.show_panels = false;
    for (const TracedView view : {TracedView::Beside, TracedView::Over}) {
        session.state.traced = view;
        const auto capture = [&](const std::vector<Shading>& shadings) {
            Headless headless;
            Image last;
            for (const Shading shading : shadings) {
                session.state.shading = shading;
                last = headless.capture(session);
            }
            return last;
        };
        const Image normals = capture({Shading::Normals});
        EXPECT_EQ(capture({Shading::Primary, Shading::Normals}), normals);
        EXPECT_GT(different_pixels(capture({Shading::Primary}), normals), 1000u);
    }
}

TEST(ViewerFrame, MovingTheLevelRangeUploadsNothing) {
    Headless headless;
    Viewer viewer(small_session());
    headless.frame().capture(viewer);
    const uint64_t uploads = headless.frame().scene_renderer().upload_count();
    for (int level = 0; level < 6; ++level) {
        viewer.state.levels = {level, level};
        headless.frame().draw(viewer);
    }
    EXPECT_EQ(headless.frame().scene_renderer().upload_count(), uploads);
}

TEST(ViewerFrame, TheMouseOrbitsAndZooms) {
    Headless headless;
    Viewer viewer(small_session());
    headless.frame().capture(viewer);
    const Camera before = viewer.camera();
    ImGuiIO& io = ImGui::GetIO();
    const auto frame = [&](float x, bool down) {
        io.MousePos = {x, 300.0f};
        io.MouseDown[0] = down;
        headless.frame().draw(viewer);
    };
    frame(380.0f, false);
    frame(380.0f, true);
    frame(430.0f, true);
    frame(430.0f, false);
    const Camera turned = viewer.camera();
    EXPECT_EQ(turned.target, before.target);
    EXPECT_GT(glm::distance(turned.eye, before.eye), 0.01f * glm::distance(before.eye, before.target));
    io.MouseWheel = 2.0f;
    headless.frame().draw(viewer);
    EXPECT_LT(glm::distance(viewer.camera().eye, viewer.camera().target),
              glm::distance(turned.eye, turned.target));
}

/// A folder with one session and its picture.
class CheckFolder : public testing::Test {
protected:
    CheckFolder() {
        write_session("\"leaves_above\": false, \"levels\": [1, 1]");
        EXPECT_EQ(check({"--update"}), ExitCode::Done);
        EXPECT_TRUE(fs::exists(folder_ + "/one.png"));
    }

    void write_session(const std::string& rest) const {
        write_file_atomically(folder_ + "/one.json",
                              "{\"version\": 1, \"scene\": \"two-triangles\", \"recipe\": \"esc(s=6) > "
                              "bvh-sweep-sah(max-leaf-size=1)\", \"size\": [200, 160], \"panels\": false, " +
                                  rest + "}");
    }
    ExitCode check(std::vector<std::string> options = {}) const {
        std::vector<std::string> arguments{folder_, "--report", folder_ + "/report.html"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return run_check(arguments);
    }
    TemporaryFolder temporary_;
    std::string folder_ = temporary_.path();
};

TEST_F(CheckFolder, ASessionIsTheSameAsItsPicture) {
    EXPECT_EQ(check(), ExitCode::Done);
    const auto time = fs::last_write_time(folder_ + "/one.png");
    EXPECT_EQ(check({"--update"}), ExitCode::Done);
    EXPECT_EQ(fs::last_write_time(folder_ + "/one.png"), time)
        << "a picture that is right is not written again";
}

TEST_F(CheckFolder, OneMovedBoxIsFound) {
    // The picture is drawn again with the corner of one box moved, as a wrong builder would do.
    const std::optional<Session> session = load_session(folder_ + "/one.json");
    ASSERT_TRUE(session);
    Viewer viewer(*session);
    viewer.wait();
    LevelTable levels = *viewer.built()->levels;
    Box& box = levels.list.nodes[levels.level(1)[0]].bounds;
    box.upper.x += 0.2f * static_cast<float>(box.extent().x);
    Headless headless;
    const Image right = headless.capture(*session);
    EXPECT_EQ(different_pixels(right, read_png(folder_ + "/one.png").image), 0u);

    RenderTarget target(right.width, right.height);
    SceneRenderer renderer;
    const auto draw = [&](const LevelTable& table) {
        const BoxValues values = make_box_values(table.list);
        renderer.set_mesh(viewer.scene()->mesh);
        renderer.set_boxes(table, values);
        renderer.set_references(viewer.built()->references->refs, viewer.scene()->mesh.triangle_count());
        target.clear(0.12f);
        renderer.draw(make_draw_list(viewer.state, table, values), viewer.camera(), target,
                      {0, 0, right.width, right.height});
        return read_pixels(target);
    };
    EXPECT_EQ(different_pixels(draw(*viewer.built()->levels), right), 0u);
    write_png(folder_ + "/one.png", draw(levels), print_session(*session, folder_));
    EXPECT_EQ(check(), ExitCode::CheckFailed);
    EXPECT_EQ(check({"--update"}), ExitCode::Done);
    EXPECT_EQ(check(), ExitCode::Done);
}

TEST_F(CheckFolder, AnotherLevelIsFoundAndTheLimitsAreTheSessions) {
    write_session("\"levels\": [0, 2]");
    EXPECT_EQ(check(), ExitCode::CheckFailed);
    write_session("\"levels\": [0, 2], \"check\": {\"pixels\": 32000, \"tile_mean\": 255}");
    EXPECT_EQ(check(), ExitCode::Done);
}

TEST_F(CheckFolder, AMissingPictureAndABadSessionFail) {
    fs::remove(folder_ + "/one.png");
    EXPECT_EQ(check(), ExitCode::CheckFailed);
    EXPECT_EQ(check({"--update"}), ExitCode::Done);
    write_file_atomically(folder_ + "/two.json", "{\"version\": 1, \"theme\": \"pink\"}");
    EXPECT_EQ(check(), ExitCode::CheckFailed);
}

}  // namespace
}  // namespace boxwood
