#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/rates.h"
#include "core/catalog/pipeline.h"
#include "core/measure/report.h"
#include "core/scene/camera.h"

namespace boxwood::bench {

struct RefitSettings {
    std::vector<Recipe> recipes;  ///< builders whose structures `refit` takes, over whole triangles
    int from = 0;                 ///< the frame that the refitted trees are built on
    std::vector<int> frames;
    Camera camera;
    size_t ray_count = 40000;  ///< of each kind at most
    int builds = 3;            ///< times that each build and each refit is timed
    RateSettings rates;
};

/// A tree on one frame.
struct FrameTree {
    double ms = 0.0;  ///< of the build, or of the refit alone; references not included
    double sah_cost = 0.0;
    Rate primary, diffuse;
};

/// One recipe on one frame: built anew, and built on frame `from` and refitted.
struct RefitRow {
    std::string scene, recipe;
    int frame = 0, from = 0;
    uint64_t triangles = 0;
    FrameTree built, refitted;
};

/// Rebuild against refit: rows by frame, then by recipe. `spec` names an animated scene. One thread,
/// processor time. After a stop not to be used. Throws Error (WrongUsage) for a scene without such a frame.
std::vector<RefitRow> run_refit_frames(const std::string& spec, const RefitSettings& settings, Task& task);

ReportRow report_row(const RefitRow& row);

}  // namespace boxwood::bench
