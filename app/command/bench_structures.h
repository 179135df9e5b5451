#pragma once

#include <string>
#include <vector>

#include "app/cli/camera_options.h"
#include "app/cli/options.h"
#include "bench/structures.h"

namespace boxwood {

/// The options that the suites over structures share.
class StructureOptions {
public:
    /// `default_scenes`, `default_recipes`: sentences for the help; `initial`: what is not given.
    void add_to(Options& options, const char* default_scenes, const bench::StructureSettings& initial = {},
                const char* default_recipes = "every builder, and every transform on what suits it best");
    /// After parse.
    const std::vector<std::string>& scenes(std::vector<std::string> if_none);
    /// Recipes checked, the camera that of the scene or what was given.
    bench::StructureSettings settings(const Scene& scene) const;
    std::vector<Recipe> recipes() const;
    bench::RateSettings rates() const;

    const std::string& json() const { return json_; }

private:
    std::vector<std::string> scenes_, texts_;
    std::string json_;
    int ray_count_ = 0, rounds_ = 0, builds_ = 0;
    double round_ms_ = 0.0, patience_ = 0.0;
    size_t mode_ = 0;
    CameraOptions camera_;
};

}  // namespace boxwood
