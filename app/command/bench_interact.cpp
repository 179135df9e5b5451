#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "app/gl/context_osmesa.h"
#include "app/gl/scene_renderer.h"
#include "app/viewer/box_values.h"
#include "bench/interact.h"

namespace boxwood {
namespace {

/// The suite on one scene: the recipe's builder under the slider of t, and stops of the tracer.
class Interact {
public:
    Interact(const std::string& spec, size_t shading) : scene_(open_surface(spec)) {
        settings_.camera = scene_->camera.value_or(fit_camera(scene_->mesh.bounds()));
        settings_.shading = static_cast<Shading>(shading);
    }

    ReportRow slider(const Recipe& recipe, int first_t, int step_count, bench::Memory memory) const {
        OsmesaContext context;
        SceneRenderer renderer;
        renderer.set_mesh(scene_->mesh);
        Task task;
        const Progress progress(scene_->title + ": moving the slider of t", task);
        const bench::Times times = bench::time_slider_steps(
            scene_, recipe.builder.text(), first_t, step_count, memory,
            [&](const Built& built) {
                renderer.set_boxes(*built.levels, make_box_values(built.levels->list));
            },
            task);
        const char* what = memory == bench::Memory::Shared ? "slider of t to uploaded boxes"
                                                           : "slider of t, every stage run again";
        ReportRow row = row_of(what, recipe, times);
        return row.set("t", std::to_string(first_t) + " to " + std::to_string(first_t + step_count - 1));
    }

    ReportRow stops(const Recipe& recipe, int stop_count) {
        const Built built = build_shown(recipe, scene_, cache_, /*with_levels=*/false);
        Task task;
        const Progress progress(scene_->title + ": stopping the ray tracer", task);
        return row_of("stop of the ray tracer", recipe,
                      bench::time_tracer_stops(scene_, built.structure, settings_, stop_count, task));
    }

private:
    ReportRow row_of(const char* what, const Recipe& recipe, const bench::Times& times) const {
        return boxwood::row_of(*scene_, recipe)
            .set("triangles", uint64_t{scene_->mesh.triangle_count()})
            .set("what", std::string(what))
            .set("times", uint64_t{times.ms.size()})
            .set("median_ms", times.percentile(0.5))
            .set("p99_ms", times.percentile(0.99))
            .set("worst_ms", times.percentile(1.0));
    }

    std::shared_ptr<const Scene> scene_;
    TraceSettings settings_;
    StageCache cache_;
};

}  // namespace

ExitCode run_bench_interact(Arguments arguments) {
    std::vector<std::string> scenes;
    std::string recipe_text = kDefaultRecipe;
    std::string json;
    size_t shading = 0;
    int first_t = 5;
    int step_count = 20;
    int stop_count = 200;
    int threads = 0;
    Options options("bench interact", "Measures how quickly the program answers.");
    options.texts("-s,--scene", "SCENE", scenes,
                  "scene to measure with; may be given several times (default: atrium)");
    options.text("-r,--recipe", "RECIPE", recipe_text,
                 "the builder under the slider, and what is traced (default: evh(t=14) > bvh-binned-sah)");
    options.integer("--first-t", first_t, 0, 40, "first position of the slider (default: 5)");
    options.integer("--steps", step_count, 1, 41, "steps of the slider (default: 20)");
    options.integer("--stops", stop_count, 1, 100000, "stops of the ray tracer (default: 200)");
    options.choice("--shade", shading, kShadingNames, "what is traced, 1280x720 (default: primary)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads to build with (default: all)");
    options.footer(
        "For each step of t the time from the slider to the boxes in OpenGL's buffer, nothing "
        "known\n"
        "beforehand; and for each stop of the progressive ray tracer the time until its last worker is "
        "idle,\n"
        "with the recipe and by brute force. Where the window shows another builder's structure until the\n"
        "recipe's own is there (that of preview for best), the slider is measured for both.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    if (first_t + step_count - 1 > 40)
        throw Error(ExitCode::WrongUsage, "--first-t and --steps lead beyond t = 40");
    if (scenes.empty()) scenes.push_back("atrium");
    const Recipe recipe = parse_recipe(recipe_text);
    const std::optional<Recipe> first = stand_in(recipe);
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"bench interact", scenes, {}, {}};
    const ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        Interact interact(spec, shading);
        for (const bench::Memory memory : {bench::Memory::Shared, bench::Memory::None}) {
            if (first) report.rows.push_back(interact.slider(*first, first_t, step_count, memory));
            report.rows.push_back(interact.slider(recipe, first_t, step_count, memory));
        }
        report.rows.push_back(interact.stops(recipe, stop_count));
        report.rows.push_back(interact.stops(parse_recipe("none"), stop_count));
    });
    if (!report.rows.empty()) print_report(report, json);
    return result;
}

}  // namespace boxwood
