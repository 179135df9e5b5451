#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "bench/structures.h"
#include "core/measure/report.h"

namespace boxwood::bench {

/// What is said to tell how fast rays are.
enum class Measure : uint8_t {
    SahCost,
    Epo,
    SahAndEpo,  ///< (1 - alpha) SAH cost + alpha EPO
    LeafCounts,
    Overlap,
    EmptyVolume,
    LeafSizes,
    Steps,  ///< last; counted: nodes visited and primitives tested for the rays that were timed
};
inline constexpr size_t kMeasureCount = 8;
inline constexpr std::array<const char*, kMeasureCount> kMeasureNames{
    "sah_cost", "epo", "sah_epo", "lcv", "overlap", "empty_volume", "leaf_size_variation", "steps_per_ray"};

enum class TimedRays : uint8_t { Primary, Diffuse };
inline constexpr std::array<const char*, 2> kTimedRaysNames{"primary", "diffuse"};

/// Which structures are compared with each other.
enum class Group : uint8_t {
    BinaryBvh,  ///< one layout, one traversal: what differs is the tree
    FastBvh,    ///< of them those up to kFastTime times as slow as the scene's fastest
    Boxes,      ///< every structure whose nodes are boxes
};
inline constexpr std::array<const char*, 3> kGroupNames{"binary BVH", "fast binary BVH", "all boxes"};
inline constexpr double kFastTime = 1.5;

/// The structures of one scene. Only those count that are built, timed, and have all measures; of several
/// recipes that come to the same tree the first.
struct MeasuredScene {
    std::string scene;
    std::vector<MeasuredStructure> structures;
};

/// How well a measure tells the time of a ray: 1 is perfect, 0 says nothing, below 0 it says the opposite.
struct Prediction {
    Group group;
    TimedRays kind;
    Measure measure;
    /// Of the logarithms of measure and time, each minus its mean over the scene's structures, over all
    /// scenes. Values of 0, which have no logarithm, are left out: see points.
    double pearson;
    double spearman;          ///< mean over the scenes
    double spearman_worst;    ///< the least of a scene
    uint64_t scenes, points;  ///< that pearson is of
    /// SahAndEpo: the weight of EPO that gives the largest Pearson correlation over all scenes; the
    /// correlations are those of each scene with the weight that the other scenes give.
    double alpha;
};

/// One for each group, kind of rays and measure. Scenes with fewer than three structures are left out.
std::vector<Prediction> predictions(std::span<const MeasuredScene> scenes);

/// Value of a measure; NaN where it is not defined. `alpha` for SahAndEpo.
double value_of(const MeasuredStructure& structure, Measure measure, TimedRays kind, double alpha = 0.5);

/// What `bench measures` measures where no recipe is given: every builder over whole triangles but lists and
/// what takes more than some seconds; every other kind of references with the binned and the sweep builder;
/// every transform of the sweep builder's tree, and otherwise of the first builder that fits, but those that
/// need an animated scene.
std::vector<Recipe> recipes_to_measure(size_t triangle_count);

ReportRow measures_row(const MeasuredStructure& structure, const Scene& scene);
ReportRow prediction_row(const Prediction& prediction);

}  // namespace boxwood::bench
