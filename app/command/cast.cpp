#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "core/base/file.h"
#include "core/measure/ray_file.h"
#include "core/measure/verify.h"

namespace boxwood {
namespace {

/// The whole file; "-" for standard input.
std::string read_all(const std::string& path) {
    std::FILE* file = path == "-" ? stdin : std::fopen(path.c_str(), "rb");
    if (!file) throw Error(ExitCode::BadInput, path + ": cannot be read: " + std::strerror(errno));
    std::string content;
    char block[1 << 16];
    while (const size_t count = std::fread(block, 1, sizeof(block), file)) content.append(block, count);
    const bool failed = std::ferror(file) != 0;
    const std::string reason = std::strerror(errno);
    if (file != stdin) std::fclose(file);
    if (failed) throw Error(ExitCode::BadInput, path + ": cannot be read: " + reason);
    return content;
}

RayFile read_rays(const std::string& path) {
    const std::string content = read_all(path);
    if (path.ends_with(".bin")) return parse_binary_rays(content, path);
    return parse_rays(content, path == "-" ? "standard input" : path);
}

}  // namespace

ExitCode run_cast(Arguments arguments) {
    std::string scene_spec;
    std::string recipe_text = kDefaultRecipe;
    std::string rays_file;
    std::string output;
    size_t mode = 0;
    int threads = 0;
    Options options("cast", "Casts the rays of a file and writes the nearest hit of each.");
    options.argument("SCENE", scene_spec, /*required=*/true, "file or built-in name");
    options.text("-r,--recipe", "RECIPE", recipe_text,
                 "structure to cast through (default: evh(t=14) > bvh-binned-sah)");
    options.required_text("--rays", "FILE", rays_file, "the rays (- for standard input)");
    options.required_text("-o,--output", "FILE", output, "where the hits go (- for standard output)");
    options.choice("--mode", mode, kModeNames, "how rays decide (default: exact)");
    options.integer("--threads", threads, 1, 1024, "threads (default: all)");
    options.footer(
        "A ray is a line `id ox oy oz dx dy dz tmin tmax`, decimal or C99 hex floats; in a file whose name\n"
        "ends in .bin it is 8 little-endian float32 without the id. A hit is a line `id prim t`: prim as\n"
        "counted in the scene's file, -1 for a miss.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    const Recipe recipe = parse_recipe(recipe_text);
    if (output != "-") check_writable(output);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    const RayFile file = read_rays(rays_file);
    StageCache cache;
    const Built built = build_shown(recipe, open_surface(scene_spec), cache, /*with_levels=*/false);
    const Mesh& mesh = built.scene->mesh;
    std::vector<Hit> hits;
    {
        Task task;
        const Progress progress("casting rays", task);
        hits = closest_hits(built.structure, mesh, file.rays, static_cast<Mode>(mode), task);
    }
    const std::string lines = hit_lines(file, hits, mesh);
    if (output == "-") {
        std::fwrite(lines.data(), 1, lines.size(), stdout);
    } else {
        write_file_atomically(output, lines);
    }
    return ExitCode::Done;
}

}  // namespace boxwood
