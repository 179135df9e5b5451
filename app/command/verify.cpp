#include <algorithm>
#include <cstdio>

#include "app/cli/progress.h"
#include "app/command/commands.h"
#include "app/command/shared.h"
#include "bench/ray_sets.h"
#include "core/measure/ray_file.h"
#include "core/measure/verify.h"

namespace boxwood {
namespace {

/// A recipe that is brute force itself is as slow as the reference: it casts every 20th ray.
constexpr size_t kBruteForceShare = 20;

bool is_brute_force(const Recipe& recipe) { return std::string(recipe.builder.entry().id) == "none"; }

/// Every exact row of the catalog but transforms that need an animated scene.
std::vector<Recipe> all_recipes() {
    std::vector<Recipe> recipes = exact_recipes();
    std::erase_if(recipes, [](const Recipe& recipe) {
        return std::ranges::any_of(
            recipe.transforms, [](const Stage& stage) { return stage.method().input_frame().has_value(); });
    });
    return recipes;
}

constexpr const char* kKindNames[] = {"mixed", "primary", "diffuse"};
enum class Kind : uint8_t { Mixed, Primary, Diffuse };

std::vector<Ray> rays_of(const std::shared_ptr<const Scene>& scene, Kind kind, size_t count) {
    if (kind == Kind::Mixed) return verification_rays(*scene, count);
    const Camera camera = scene->camera.value_or(fit_camera(scene->mesh.bounds()));
    const std::vector<Ray> primary = bench::primary_rays(camera, count);
    if (kind == Kind::Primary) return primary;
    StageCache cache;
    Task task;
    const Built built = *run_recipe(parse_recipe("bvh-binned-sah"), scene, cache, task);
    return bench::diffuse_rays(built.structure, scene->mesh, primary, count, task);
}

std::string hit_text(const Hit& hit, const Mesh& mesh) {
    if (!hit.is_hit()) return "a miss";
    char t[48];
    std::snprintf(t, sizeof(t), "%a", static_cast<double>(hit.t));
    return "primitive " + std::to_string(mesh.source_prim[hit.prim]) + " at t " + t;
}

void print_first_wrong(const Built& built, const Ray& ray, const Hit& expected, const Disagreement& found) {
    const Mesh& mesh = built.scene->mesh;
    std::fprintf(stderr, "%s, %s: expected %s, found %s%s, for the ray\n%s\n", built.scene->spec.c_str(),
                 print(built.recipe).c_str(), hit_text(expected, mesh).c_str(),
                 hit_text(found.found, mesh).c_str(),
                 found.occluded == expected.is_hit() ? "" : " (any hit says otherwise)",
                 ray_line(std::to_string(*found.first), ray).c_str());
}

/// Verifies all recipes on one scene; what brute force says about the rays is found out once.
class SceneVerifier {
public:
    SceneVerifier(const std::string& spec, Kind kind, size_t ray_count, Mode mode)
        : scene_(open_surface(spec)), kind_(kind), mode_(mode), rays_(rays_of(scene_, kind, ray_count)) {
        const Built reference = build_shown(parse_recipe("none"), scene_, cache_, /*with_levels=*/false);
        Task task;
        const Progress progress(scene_->title + ": casting rays by brute force", task);
        expected_ = closest_hits(reference.structure, scene_->mesh, rays_, mode_, task);
    }

    ReportRow verify(const Recipe& recipe) {
        const Built built = build_shown(recipe, scene_, cache_, /*with_levels=*/false);
        size_t count = rays_.size();
        if (is_brute_force(recipe)) count = std::min(count, std::max(count / kBruteForceShare, size_t{1000}));
        const std::span<const Ray> rays = std::span(rays_).first(count);
        Task task;
        Disagreement found;
        {
            const Progress progress(scene_->title + ": verifying " + print(recipe), task);
            found = compare_hits(built.structure, scene_->mesh, rays, std::span(expected_).first(count),
                                 mode_, task);
        }
        ReportRow row = row_of(*scene_, recipe);
        row.set("triangles", uint64_t{scene_->mesh.triangle_count()})
            .set("references", uint64_t{built.references->refs.size()})
            .set("rays_kind", kKindNames[static_cast<size_t>(kind_)])
            .set("rays", uint64_t{rays.size()})
            .set("wrong", found.wrong);
        if (found.first) {
            print_first_wrong(built, rays[*found.first], expected_[*found.first], found);
            row.set("first_wrong", ray_line(std::to_string(*found.first), rays[*found.first]));
        }
        return row;
    }

private:
    std::shared_ptr<const Scene> scene_;
    Kind kind_;
    Mode mode_;
    StageCache cache_;
    std::vector<Ray> rays_;
    std::vector<Hit> expected_;
};

}  // namespace

ExitCode run_verify(Arguments arguments) {
    std::vector<std::string> scenes;
    std::vector<std::string> texts;
    std::string json;
    int ray_count = 100000;
    size_t mode = 0, kind = 0;
    int threads = 0;
    Options options("verify",
                    "Casts rays through structures and by brute force, and counts those whose answers differ "
                    "in the primitive, in a bit of t, or in whether anything is hit at all.");
    options.arguments("SCENE", scenes, "files or built-in names");
    options.texts("-r,--recipe", "RECIPE", texts,
                  "what to verify; may be given several times (default: every exact row of the catalog)");
    options.integer("-n,--rays", ray_count, 1, 100000000, "rays for each scene (default: 100000)");
    options.choice(
        "--kind", kind, kKindNames,
        "which rays: all kinds below, through the pixels of the scene's view, or one cosine bounce "
        "from there (default: mixed)");
    options.choice("--mode", mode, kModeNames, "how rays decide, brute force alike (default: exact)");
    options.text("--json", "FILE", json, "write the rows as JSON (- for standard output)");
    options.integer("--threads", threads, 1, 1024, "threads (default: all)");
    options.footer(
        "Mixed rays go through pixels, between random points, at vertices, edges and inner points of\n"
        "triangles, and along the axes. A ray that differs is printed as `boxwood cast` takes it. Recipes\n"
        "that are brute force themselves cast every 20th ray. Exits 1 if any ray differs.\n\n" +
        recipe_help());
    if (!options.parse(arguments)) return ExitCode::Done;
    const std::vector<Recipe> recipes = texts.empty() ? all_recipes() : parse_recipes(texts);
    check_json_file(json);
    const std::unique_ptr<ThreadLimit> limit = limit_threads(threads);

    Report report{"verify", scenes, {}, {}};
    ExitCode result = for_each_scene(scenes, [&](const std::string& spec) {
        SceneVerifier verifier(spec, static_cast<Kind>(kind), static_cast<size_t>(ray_count),
                               static_cast<Mode>(mode));
        for (const Recipe& recipe : recipes) report.rows.push_back(verifier.verify(recipe));
    });
    if (!report.rows.empty()) print_report(report, json);
    const bool any_wrong = std::ranges::any_of(
        report.rows, [](const ReportRow& row) { return std::get<uint64_t>(*row.find("wrong")) > 0; });
    return any_wrong ? ExitCode::CheckFailed : result;
}

}  // namespace boxwood
