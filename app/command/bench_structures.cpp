#include "app/command/bench_structures.h"

#include "app/command/shared.h"

namespace boxwood {

void StructureOptions::add_to(Options& options, const char* default_scenes) {
    options.texts("-s,--scene", "SCENE", scenes_, default_scenes);
    options.texts(
        "-r,--recipe", "RECIPE", texts_,
        "structure; may be given several times (default: every builder, and every transform on what "
        "suits it best)");
    options.integer("-n,--rays", ray_count_, 1, 100000000,
                    "rays of each kind at most: primary, and one diffuse bounce (default: 40000)");
    options.integer("--rounds", rounds_, 1, 1000000, "rounds (default: 5)");
    options.real("--round-ms", round_ms_, 0.1, 1e6,
                 "about, of one structure in one round: a slow one casts fewer rays (default: 50)");
    options.integer("--builds", builds_, 1, 1000, "builds of each structure (default: 3)");
    options.real("--patience", patience_, 0.01, 1e6, "seconds after which a build is given up (default: 60)");
    options.choice("--mode", mode_, kModeNames, "exact or fast (default: exact)");
    camera_.add_to(options);
    options.text("--json", "FILE", json_, "write the rows as JSON (- for standard output)");
}

const std::vector<std::string>& StructureOptions::scenes(std::vector<std::string> if_none) {
    if (scenes_.empty()) scenes_ = std::move(if_none);
    return scenes_;
}

std::vector<Recipe> StructureOptions::recipes() const { return parse_recipes(texts_); }

bench::RateSettings StructureOptions::rates() const {
    return {.mode = static_cast<Mode>(mode_), .rounds = rounds_, .round_ms = round_ms_};
}

bench::StructureSettings StructureOptions::settings(const Scene& scene) const {
    bench::StructureSettings settings;
    settings.recipes = recipes();
    settings.camera = camera_.camera(scene);
    settings.ray_count = static_cast<size_t>(ray_count_);
    settings.builds = builds_;
    settings.patience = patience_;
    settings.rates = rates();
    return settings;
}

}  // namespace boxwood
