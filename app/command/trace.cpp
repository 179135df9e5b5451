#include "app/cli/camera_options.h"
#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "app/viewer/session.h"
#include "core/base/file.h"
#include "core/render/png.h"
#include "core/render/trace_image.h"

namespace boxwood {
namespace {

/// What opens the same view again, as every picture carries it.
std::string session_text(const Built& built, const TraceSettings& settings, const std::string& folder) {
    Session session;
    session.state.scene = built.scene->spec;
    session.state.side().recipe = print(built.recipe);
    session.state.mode = settings.mode;
    session.state.camera = settings.camera;
    session.state.traced = TracedView::Over;
    session.state.show_boxes = false;
    session.state.width = settings.width;
    session.state.height = settings.height;
    return print_session(session, folder);
}

ReportRow trace_row(const Built& built, const TraceSettings& settings, const TraceResult& traced) {
    const double rays = static_cast<double>(traced.ray_count);
    ReportRow row = row_of(*built.scene, built.recipe);
    row.set("triangles", uint64_t{built.scene->mesh.triangle_count()})
        .set("shade", std::string(kShadingNames[static_cast<size_t>(settings.shading)]))
        .set("rays", traced.ray_count)
        .set("build_ms", built.references_ms + built.build_ms)
        .set("trace_ms", traced.ms);
    if (traced.ms > 0.0) row.set("mrays_per_s", rays / traced.ms * 1e-3);
    if (traced.counted_rays > 0) {
        const double counted = static_cast<double>(traced.counted_rays);
        row.set("nodes_per_ray", static_cast<double>(traced.counters.nodes) / counted)
            .set("tests_per_ray", static_cast<double>(traced.counters.tests) / counted);
    }
    return row;
}

}  // namespace

ExitCode run_trace(Arguments arguments) {
    std::string scene_spec;
    std::vector<std::string> recipe_texts;
    std::string output;
    std::string json;
    size_t shading = 0;
    size_t mode = 0;
    int threads = 0;
    PixelSize size;
    TraceSettings settings;
    CameraOptions camera;
    Options options("trace", "Renders a picture with the CPU ray tracer and prints what its rays cost.");
    options.argument("SCENE", scene_spec, /*required=*/true, "file or built-in name");
    options.text("-o,--output", "FILE", output, "the picture, PNG (default: none, only the row)");
    options.choice("--shade", shading, kShadingNames, "what a pixel shows (default: primary)");
    options.integer("--spp", settings.spp, 1, 65536, "samples per pixel (default: 4; ao 16, heat 1)");
    options.size("--size", size, "of the picture (default: 1280x720)");
    camera.add_to(options);
    options.texts("-r,--recipe", "RECIPE", recipe_texts,
                  "structure to trace; may be given several times, the picture is the first one's "
                  "(default: evh(t=14) > bvh-binned-sah)");
    options.choice("--mode", mode, kModeNames, "how rays decide (default: exact)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads (default: all)");
    options.footer(
        "mrays_per_s: millions of rays a second, all of the picture's; nodes_per_ray, tests_per_ray: of the\n"
        "rays through the pixels' centres, counted in a pass of its own.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    if (output.empty() && json.empty() && !options.given("--recipe"))
        throw Error(ExitCode::WrongUsage, "nothing to do: give -o FILE.png, --json FILE or --recipe RECIPE");
    if (recipe_texts.empty()) recipe_texts.push_back(kDefaultRecipe);
    const std::vector<Recipe> recipes = parse_recipes(recipe_texts);
    if (!output.empty()) check_writable(output);
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    const std::shared_ptr<const Scene> scene = open_surface(scene_spec);
    settings.camera = camera.camera(*scene);
    settings.width = size.width;
    settings.height = size.height;
    settings.shading = static_cast<Shading>(shading);
    settings.mode = static_cast<Mode>(mode);
    settings.measure = true;
    StageCache cache;
    Report report{"trace", {scene_spec}, {}, {}};
    for (size_t i = 0; i < recipes.size(); ++i) {
        const Built built = build_shown(recipes[i], scene, cache, /*with_levels=*/false);
        Task task;
        const Progress progress(scene->title + ": tracing " + print(recipes[i]), task);
        const TraceResult traced = trace_image(*scene, built.structure, settings, task);
        if (i == 0 && !output.empty())
            write_png(output, traced.image, session_text(built, settings, session_folder(output)));
        report.rows.push_back(trace_row(built, settings, traced));
    }
    print_report(report, json);
    return ExitCode::Done;
}

}  // namespace boxwood
