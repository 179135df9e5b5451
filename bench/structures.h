#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/rates.h"
#include "core/catalog/pipeline.h"
#include "core/scene/camera.h"

namespace boxwood::bench {

struct StructureSettings {
    std::vector<Recipe> recipes;  ///< empty: every builder of the catalog, and every transform (see below)
    Camera camera;
    size_t ray_count = 40000;  ///< of each kind at most: primary, and one diffuse bounce
    int builds = 3;            ///< of each recipe
    double patience = 60.0;    ///< seconds after which a build is given up
    RateSettings rates;
    bool with_measures = false;  ///< measure the trees and count steps too
};

/// What a tree is measured by beside its SAH cost, all independent of the machine; NaN: not defined for such
/// nodes.
struct TreeMeasures {
    double epo = 0.0;                                                             ///< see EndPointOverlap
    double leaf_count_deviation = 0.0;                                            ///< see LeafCounts
    double sibling_overlap = 0.0, empty_volume = 0.0, leaf_size_variation = 0.0;  ///< see TreeStats
    /// Nodes visited and primitives tested for a ray, in the mean over the rays that were timed.
    double primary_steps = 0.0, diffuse_steps = 0.0;
};

/// What one recipe costs and gives on a scene.
struct MeasuredStructure {
    std::string recipe;
    std::string family;
    bool is_list = false;   ///< brute force
    bool is_built = false;  ///< false: given up, nothing below is known
    uint64_t bytes = 0;     ///< of the structure alone
    uint64_t references = 0;
    double sah_cost = 0.0;
    double build_ms = 0.0;  ///< references, builder and transforms; median, NaN where given up
    Rate primary, diffuse;
    TreeMeasures measures;  ///< zeros unless asked for
};

/// Measures structures on a scene: one thread, processor time. Where no recipes are given these are every
/// builder over whole triangles, and each transform of the catalog, but those that need an animated scene, on
/// the recipe of least SAH cost that it takes.
std::vector<MeasuredStructure> measure_structures(std::shared_ptr<const Scene> scene,
                                                  const StructureSettings& settings, Task& task);

}  // namespace boxwood::bench
