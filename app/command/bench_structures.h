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
    /// `default_scenes`: sentence for the help.
    void add_to(Options& options, const char* default_scenes);
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
    int ray_count_ = 40000, rounds_ = 5, builds_ = 3;
    double round_ms_ = 50.0, patience_ = 60.0;
    size_t mode_ = 0;
    CameraOptions camera_;
};

}  // namespace boxwood
