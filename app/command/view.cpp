#include "app/cli/options.h"
#include "app/command/commands.h"
#include "app/command/shown_recipes.h"
#include "app/viewer/window.h"

namespace boxwood {

ExitCode run_view(Arguments arguments) {
    std::string source, session_file;
    std::vector<std::string> recipes;
    PixelSize size;
    bool watch = false;
    Options options("view", "Opens the window. Without SCENE it shows the built-in atrium.");
    options.argument("SCENE", source, /*required=*/false, "scene, session file, or picture with a session");
    options.texts("--recipe", "RECIPE", recipes, kShownRecipesHelp);
    options.text("--session", "FILE", session_file, "session to start with; SCENE replaces its scene");
    options.size("--size", size, "of the window");
    options.flag("--watch", watch, "open the scene's file again whenever it changes");
    if (!options.parse(arguments)) return ExitCode::Done;

    Session session;
    const bool has_session = !session_file.empty();
    if (has_session) {
        std::optional<Session> loaded = load_session(session_file);
        if (!loaded) throw Error(ExitCode::BadInput, session_file + ": expected a session");
        session = *std::move(loaded);
    }
    Settings settings = load_settings(settings_path());
    std::optional<Session> from_source = source.empty() ? std::nullopt : load_session(source);
    if (from_source) {
        session = *std::move(from_source);
    } else if (!source.empty()) {
        session.state.scene = source;
        if (has_session) session.state.camera.reset();
    }
    show_recipes(recipes, session.state);
    if (options.given("--size")) {
        session.state.width = size.width;
        session.state.height = size.height;
    }
    const Settings before = settings;
    Viewer viewer(std::move(session), settings);
    Window window(viewer);
    if (!has_session) window.use_display_scale();
    const float scale = viewer.state.interface_scale;
    window.watch(watch);
    window.run();
    if (viewer.state.interface_scale != scale) viewer.remember_scale();
    if (!(viewer.settings() == before)) save_settings(viewer.settings(), settings_path());
    return ExitCode::Done;
}

}  // namespace boxwood
