#include "app/command/bench_structures.h"

#include "app/command/shared.h"

#include <cstdio>

namespace boxwood {

void StructureOptions::add_to(Options& options, const char* default_scenes,
                              const bench::StructureSettings& initial, const char* default_recipes) {
    ray_count_ = static_cast<int>(initial.ray_count);
    rounds_ = initial.rates.rounds;
    round_ms_ = initial.rates.round_ms;
    builds_ = initial.builds;
    patience_ = initial.patience;
    const auto with_default = [](const char* text, double value) {
        char number[32];
        std::snprintf(number, sizeof number, "%g", value);
        return std::string(text) + " (default: " + number + ")";
    };
    options.texts("-s,--scene", "SCENE", scenes_, default_scenes);
    options.texts(
        "-r,--recipe", "RECIPE", texts_,
        (std::string("structure; may be given several times (default: ") + default_recipes + ")").c_str());
    options.integer(
        "-n,--rays", ray_count_, 1, 100000000,
        with_default("rays of each kind at most: primary, and one diffuse bounce", ray_count_).c_str());
    options.integer("--rounds", rounds_, 1, 1000000, with_default("rounds", rounds_).c_str());
    options.real(
        "--round-ms", round_ms_, 0.1, 1e6,
        with_default("about, of one structure in one round: a slow one casts fewer rays", round_ms_).c_str());
    options.integer("--builds", builds_, 1, 1000, with_default("builds of each structure", builds_).c_str());
    options.real("--patience", patience_, 0.01, 1e6,
                 with_default("seconds after which a build is given up", patience_).c_str());
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
