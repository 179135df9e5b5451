#include "app/command/shared.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/cli/progress.h"
#include "core/base/file.h"
#include "core/catalog/param_text.h"

namespace boxwood {
namespace {

void append_stages(std::string& text, const char* title, std::span<const CatalogEntry> table) {
    if (table.empty()) return;
    text += std::string(title) + ":\n";
    for (const CatalogEntry& entry : table) {
        std::string params;
        for (const ParamInfo& info : param_infos(*entry.make()))
            params += (params.empty() ? "(" : ", ") + info.initial;
        if (!params.empty()) params += ")";
        text += "  " + std::string(entry.id) + params + "\n";
    }
}

}  // namespace

std::string recipe_help() {
    std::string text =
        "A recipe names the way from triangles to a structure: \"references > builder > transforms\", "
        "references\n"
        "being \"whole\" where they are left out; for example \"evh(t=14) > "
        "bvh-binned-sah(max-leaf-size=4)\".\n"
        "Each stage is shown with its defaults; `boxwood list` says what the parameters mean.\n";
    append_stages(text, "references", reference_catalog());
    append_stages(text, "builders", builder_catalog());
    append_stages(text, "transforms", transform_catalog());
    return text;
}

std::shared_ptr<const Scene> open_scene_shown(const std::string& spec) {
    Task task;
    const Progress progress("reading " + spec, task);
    std::shared_ptr<const Scene> scene = open_scene(spec, task);
    for (const std::string& warning : scene->warnings)
        std::fprintf(stderr, "boxwood: %s: %s\n", scene->title.c_str(), warning.c_str());
    return scene;
}

std::shared_ptr<const Scene> open_surface(const std::string& spec) {
    std::shared_ptr<const Scene> scene = open_scene_shown(spec);
    const size_t point_count = scene->mesh.points.positions.size();
    if (scene->mesh.triangle_count() > 0) return scene;
    if (point_count > 0)
        throw Error(ExitCode::BadInput, to_utf8(spec) + ": has " + std::to_string(point_count) +
                                            " points and no triangles; surfaces for points come in a later "
                                            "version");
    throw Error(ExitCode::BadInput, to_utf8(spec) + ": has no visible triangle");
}

Built build_shown(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                  bool with_levels) {
    const std::string warning = long_build_warning(recipe, scene->mesh.triangle_count());
    if (!warning.empty()) std::fprintf(stderr, "boxwood: %s %s\n", print(recipe).c_str(), warning.c_str());
    Task task;
    const Progress progress(scene->title + ": building " + print(recipe), task);
    return *run_recipe(recipe, std::move(scene), cache, task, with_levels);
}

std::vector<Recipe> parse_recipes(const std::vector<std::string>& texts) {
    std::vector<Recipe> recipes;
    for (const std::string& text : texts) recipes.push_back(parse_recipe(text));
    return recipes;
}

std::vector<Recipe> exact_recipes() {
    std::vector<Recipe> recipes;
    for (const CatalogEntry& builder : builder_catalog())
        if (builder.exact) recipes.push_back(parse_recipe(builder.id));
    for (const CatalogEntry& transform : transform_catalog()) {
        const CatalogEntry* input = nullptr;
        for (const CatalogEntry& builder : builder_catalog())
            if (builder.exact && std::string(builder.output) == transform.input) input = &builder;
        if (transform.exact && input != nullptr)
            recipes.push_back(parse_recipe(std::string(input->id) + " > " + transform.id));
    }
    for (const CatalogEntry& references : reference_catalog()) {
        const Recipe recipe = parse_recipe(std::string(references.id) + " > bvh-binned-sah");
        if (std::ranges::find(recipes, recipe) == recipes.end()) recipes.push_back(recipe);
    }
    return recipes;
}

void print_error(const Error& error) { std::fprintf(stderr, "boxwood: %s\n", to_utf8(error.what()).c_str()); }

void print_report(const Report& report, const std::string& json_file) {
    if (json_file != "-") std::fputs(to_table(report.rows).c_str(), stdout);
    if (!json_file.empty()) write_json(report, json_file);
}

void write_json(const Report& report, const std::string& json_file) {
    if (json_file == "-") {
        std::fputs(to_json(report).c_str(), stdout);
    } else {
        write_file_atomically(json_file, to_json(report));
    }
}

void check_json_file(const std::string& json_file) {
    if (!json_file.empty() && json_file != "-") check_writable(json_file);
}

std::unique_ptr<ThreadLimit> limit_threads(int count) {
    return count > 0 ? std::make_unique<ThreadLimit>(count) : nullptr;
}

ReportRow row_of(const Scene& scene, const Recipe& recipe) {
    return ReportRow().set("scene", scene.spec).set("recipe", print(recipe));
}

}  // namespace boxwood
