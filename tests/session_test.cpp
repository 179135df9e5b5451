#include "app/viewer/session.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/render/png.h"

namespace boxwood {
namespace {

Session parse(const std::string& text) { return parse_session(text, ".", "test"); }

/// The sentence with which a text is refused; empty if it is not.
std::string refusal(const std::string& text) {
    try {
        parse(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

Session unusual_session() {
    Session session;
    ViewerState& s = session.state;
    s.scene = "spaceship@scale=2";
    s.sides[0] = {
        .recipe = "esc(s=12) > bvh-sweep-sah", .node = 0, .hidden_nodes = {5, 3}, .isolated = 2147483647};
    s.sides[1] = {.recipe = "bvh-binned-sah", .node = 4, .hidden_nodes = {1}, .isolated = 2};
    s.active = Side::B;
    s.compare_view = CompareView::Beside;
    s.wipe = 0.125f;
    s.heat_difference = true;
    s.mode = Mode::Fast;
    s.camera = Camera{.eye = {0.1f, -2.5e-3f, 3e7f}, .target = {1.0f / 3.0f, 0.0f, 0.0f}};
    s.camera->up = {0.0f, 0.0f, 1.0f};
    s.camera->fov = 33.3f;
    s.camera->orthographic = true;
    s.stored_views[0] = Camera{};
    s.stored_views[8] = s.camera;
    s.up_axis = UpAxis::Z;
    s.levels = {2, LevelRange::kMaxLevel};
    s.leaves_above = s.show_boxes = s.show_mesh = s.show_red = false;
    s.show_wire = s.show_reference_boxes = s.see_through = true;
    s.show_shared = s.show_empty = s.show_unvisited = true;
    s.box_color = BoxColor::Visits;
    s.visit_rays = VisitRays::Picture;
    s.ray = PickedRay{{0.5f, 1e-7f, -3.0f}, {0.0f, -1.0f, 1.0f / 3.0f}};
    s.prim = 77;
    s.side_panel = SidePanel::Verify;
    s.verify_rays = 100000;
    s.traced = TracedView::Over;
    s.shading = Shading::HeatExact;
    s.spp = 7;
    s.color_map = ColorMap::Batlow;
    s.log_heat = true;
    s.heat_max = 120.5f;
    s.theme = Theme::Light;
    s.interface_scale = 1.7f;
    s.width = 640;
    s.height = 401;
    s.show_panels = s.show_times = false;
    s.show_keys = true;
    session.limits = {.difference = 9, .pixels = 12, .tile_mean = 0.5};
    return session;
}

TEST(Session, ComesBackAsItWasSaved) {
    const Session session = unusual_session();
    const Session back = parse(print_session(session, "."));
    EXPECT_EQ(back.state, session.state);
    EXPECT_EQ(back.limits, session.limits);
    EXPECT_TRUE(back.notes.empty());
}

TEST(Session, LeavesDefaultsOut) {
    EXPECT_EQ(print_session(Session{}, "."), "{\n    \"version\": 1\n}\n");
    EXPECT_EQ(parse("{\"version\": 1}").state, ViewerState{});
    Session session;
    session.state.show_wire = true;
    EXPECT_EQ(print_session(session, "."), "{\n    \"version\": 1,\n    \"wire\": true\n}\n");
}

TEST(Session, ASecondRecipeAloneComparesByAWipeInTheMiddle) {
    const ViewerState state = parse(R"({"version": 1, "recipe_b": "bvh-sweep-sah"})").state;
    EXPECT_TRUE(state.compares());
    EXPECT_EQ(state.compare_view, CompareView::Wipe);
    EXPECT_EQ(state.wipe, 0.5f);
    EXPECT_EQ(state.active_side(), Side::A);
    EXPECT_EQ(parse(R"({"version": 1, "active": "b"})").state.active_side(), Side::A) << "there is no B";
}

TEST(Session, KeepsUnknownKeysAndReportsThem) {
    const Session session = parse(R"({"version": 1, "future": {"a": [1, 2]}, "boxes": false})");
    ASSERT_EQ(session.notes.size(), 1u);
    EXPECT_NE(session.notes[0].find("future"), std::string::npos);
    EXPECT_FALSE(session.state.show_boxes);
    const std::string text = print_session(session, ".");
    EXPECT_EQ(parse(text).notes, session.notes);
    EXPECT_NE(text.find("\"future\""), std::string::npos);
}

TEST(Session, NamesASceneFileRelativeToItself) {
    Session session;
    session.state.scene = "models/house.glb@rot=45,0,1,0";
    const std::string text = print_session(session, "sessions");
    EXPECT_NE(text.find("\"../models/house.glb@rot=45,0,1,0\""), std::string::npos) << text;
    EXPECT_EQ(parse_session(text, "sessions", "test").state.scene, session.state.scene);

    session.state.scene = (std::filesystem::current_path() / "deep" / "house.glb").string();
    EXPECT_NE(print_session(session, "deep").find("\"scene\": \"house.glb\""), std::string::npos);
}

TEST(Session, AFileNamedLikeABuiltInSceneStaysAFile) {
    Session session;
    session.state.scene = "./atrium";
    EXPECT_NE(print_session(session, ".").find("./atrium"), std::string::npos);
}

TEST(Session, RefusesWhatIsNoSession) {
    EXPECT_NE(refusal("").find("test"), std::string::npos);
    EXPECT_NE(refusal("{\"version\": 1").find("line 1"), std::string::npos);
    EXPECT_NE(refusal("[1]").find("object"), std::string::npos);
    EXPECT_NE(refusal("{}").find("version"), std::string::npos);
    EXPECT_NE(refusal(R"({"version": 2})").find("expected 1"), std::string::npos);
    EXPECT_NE(refusal(R"({"version": "1"})").find("expected 1"), std::string::npos);
}

TEST(Session, RefusesWrongTypesAndValuesOutOfRange) {
    const auto with = [](const std::string& rest) { return refusal("{\"version\": 1, " + rest + "}"); };
    EXPECT_NE(with(R"("boxes": 1)").find("true or false"), std::string::npos);
    EXPECT_NE(with(R"("theme": "blue")").find("\"light\""), std::string::npos);
    EXPECT_NE(with(R"("levels": [3, 2])").find("from 3 to 999"), std::string::npos);
    EXPECT_NE(with(R"("levels": [0.5, 2])"), "");
    EXPECT_NE(with(R"("levels": [18446744073709551615, 2])"), "");
    EXPECT_NE(with(R"("levels": [-9223372036854775808, 2])"), "");
    EXPECT_NE(with(R"("levels": {"0": 1})"), "");
    EXPECT_NE(with(R"("size": [99999, 10])").find("8192"), std::string::npos);
    EXPECT_NE(with(R"("size": [640])"), "");
    EXPECT_NE(with(R"("scale": 1e999)"), "");
    EXPECT_NE(with(R"("scale": null)"), "");
    EXPECT_NE(with(R"("camera": {"eye": [0, 0, 1]})").find("target"), std::string::npos);
    EXPECT_NE(with(R"("camera": {"eye": [0, 0, 1e39], "target": [0, 0, 0]})"), "");
    EXPECT_NE(with(R"("camera": {"eye": [0, 0, 1], "target": [0, 0, 0], "fov": 0})"), "");
    EXPECT_NE(with(R"("views": {"10": {}})").find("\"9\""), std::string::npos);
    EXPECT_NE(with(R"("views": [])"), "");
    EXPECT_NE(with(R"("recipe": 3)").find("text"), std::string::npos);
    EXPECT_NE(with(R"("recipe_b": [])").find("text"), std::string::npos);
    EXPECT_NE(with(R"("compare": "flicker")").find("\"beside\""), std::string::npos);
    EXPECT_NE(with(R"("wipe": 1.5)"), "");
    EXPECT_NE(with(R"("active": "c")").find("\"b\""), std::string::npos);
    EXPECT_NE(with(R"("node": -1)"), "");
    EXPECT_NE(with(R"("node": 4294967295)"), "") << "that is no node";
    EXPECT_NE(with(R"("hidden": 3)"), "");
    EXPECT_NE(with(R"("hidden": [1, "2"])"), "");
    EXPECT_NE(with(R"("ray": {"origin": [0, 0, 0]})").find("direction"), std::string::npos);
    EXPECT_NE(with(R"("ray": {"origin": [0, 0, 0], "direction": [0, 0, 0]})").find("zero"),
              std::string::npos);
    EXPECT_NE(with(R"("verify_rays": -5)"), "");
    EXPECT_NE(with(R"("side": "right")").find("verify"), std::string::npos);
    EXPECT_NE(with(R"("check": {"pixels": -1})"), "");
}

TEST(Session, RefusesAnAbsoluteScene) {
    EXPECT_NE(refusal(R"({"version": 1, "scene": "/etc/passwd"})").find("absolute"), std::string::npos);
}

TEST(Session, RefusesDeepNestingAndHugeTexts) {
    const std::string deep =
        "{\"version\": 1, \"x\": " + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_NE(refusal(deep).find("32 levels"), std::string::npos);
    EXPECT_NE(refusal(std::string(size_t{17} << 20, ' ')).find("16 MiB"), std::string::npos);
    EXPECT_EQ(refusal(R"({"version": 1, "x": "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["})"), "");
}

TEST(Session, IsReadFromAPictureToo) {
    const std::string path = testing::TempDir() + "session_test.png";
    const Session session = unusual_session();
    write_png(path, Image(4, 4), print_session(session, session_folder(path)));
    const std::optional<Session> back = load_session(path);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->state, session.state);
    write_png(path, Image(4, 4));
    EXPECT_THROW(load_session(path), Error);
    std::filesystem::remove(path);
}

TEST(Session, IsToldApartFromAScene) {
    EXPECT_FALSE(load_session("atrium"));
    EXPECT_FALSE(is_session_text(R"({"asset": {"version": "2.0"}})"));
    EXPECT_FALSE(is_session_text("v 0 0 0"));
    EXPECT_TRUE(is_session_text(" \n{\"version\": 1}"));
    const std::string path = testing::TempDir() + "session_test.json";
    save_session(unusual_session(), path);
    EXPECT_EQ(load_session(path)->state, unusual_session().state);
    std::ofstream(path) << "{\"version\": ";
    EXPECT_THROW(load_session(path), Error);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace boxwood
