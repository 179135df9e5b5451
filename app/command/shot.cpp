#include <iostream>

#include "app/cli/options.h"
#include "app/command/commands.h"
#include "app/command/shown_recipes.h"
#include "app/viewer/headless.h"
#include "core/base/file.h"
#include "core/render/png.h"

namespace boxwood {

ExitCode run_shot(Arguments arguments) {
    std::string source, output;
    std::vector<std::string> recipes;
    PixelSize size;
    bool no_ui = false;
    Options options("shot",
                    "Draws the frame of the window without one, and writes it as a picture that carries "
                    "its session.");
    options.argument("SCENE|SESSION", source, /*required=*/true,
                     "scene, session file, or picture with a session");
    options.required_text("-o,--output", "FILE", output, "the PNG to write");
    options.size("--size", size, "of the picture in pixels");
    options.flag("--no-ui", no_ui, "the 3D view alone, without panels");
    options.texts("--recipe", "RECIPE", recipes, kShownRecipesHelp);
    if (!options.parse(arguments)) return ExitCode::Done;

    check_writable(output);
    Session session;
    if (std::optional<Session> loaded = load_session(source)) {
        session = *std::move(loaded);
    } else {
        session.state.scene = source;
    }
    for (const std::string& note : session.notes) std::cerr << source << ": " << note << '\n';
    show_recipes(recipes, session.state);
    if (options.given("--size")) {
        session.state.width = size.width;
        session.state.height = size.height;
    }
    if (no_ui) session.state.show_panels = false;

    Headless headless;
    const Image image = headless.capture(session);
    write_png(output, image, print_session(session, session_folder(output)));
    std::cout << output << ": " << image.width << " x " << image.height << '\n';
    return ExitCode::Done;
}

}  // namespace boxwood
