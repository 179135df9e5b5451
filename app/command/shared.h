#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/ray.h"
#include "core/catalog/pipeline.h"
#include "core/measure/report.h"
#include "core/scene/scene.h"

namespace boxwood {

inline constexpr const char* kModeNames[] = {"exact", "fast"};  ///< by value of Mode
inline constexpr const char* kDefaultRecipe = "evh(t=14) > bvh-binned-sah";

/// The head of every command's help on recipes: the stages with their parameters.
std::string recipe_help();

/// Opens a scene and shows its progress; what was odd in the file goes to standard error.
std::shared_ptr<const Scene> open_scene_shown(const std::string& spec);

/// The same for commands that need triangles: throws Error (BadInput) for a scene of points alone, or of
/// nothing.
std::shared_ptr<const Scene> open_surface(const std::string& spec);

/// run_recipe, with its progress shown.
Built build_shown(const Recipe& recipe, std::shared_ptr<const Scene> scene, StageCache& cache,
                  bool with_levels);

/// All recipes, each parsed before any of them is run.
std::vector<Recipe> parse_recipes(const std::vector<std::string>& texts);

/// Every exact row of the catalog: the builders over whole boxes, each transform on the last of those that it
/// takes, and every other reference stage with one builder.
std::vector<Recipe> exact_recipes();

/// "boxwood: MESSAGE" on standard error.
void print_error(const Error& error);

/// Runs `body` for each scene. One that cannot be read does not keep the others from being done: its message
/// goes to standard error and the exit code of the first such one is returned.
template <class Body>
ExitCode for_each_scene(const std::vector<std::string>& specs, const Body& body) {
    ExitCode result = ExitCode::Done;
    for (const std::string& spec : specs) {
        try {
            body(spec);
        } catch (const Error& error) {
            if (error.exit_code() != ExitCode::BadInput) throw;
            print_error(error);
            if (result == ExitCode::Done) result = error.exit_code();
        }
    }
    return result;
}

/// The report as the user asked for it: without `json_file` as a table on standard output; with "-" as JSON
/// there instead; otherwise the table there and JSON into the file.
void print_report(const Report& report, const std::string& json_file);

/// The report as JSON into the file, or with "-" to standard output.
void write_json(const Report& report, const std::string& json_file);

/// Throws Error (WrongUsage) at once where `json_file` is given and cannot be written.
void check_json_file(const std::string& json_file);

/// A limit for `--threads`; none for 0.
std::unique_ptr<ThreadLimit> limit_threads(int count);

/// Beginning of a row: scene and recipe.
ReportRow row_of(const Scene& scene, const Recipe& recipe);

}  // namespace boxwood
