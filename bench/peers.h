#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/embree_peer.h"
#include "bench/peer_judge.h"
#include "bench/ratios.h"
#include "core/base/task.h"
#include "core/catalog/recipe.h"
#include "core/measure/report.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace boxwood::bench {

/// The recipes that stand for Boxwood where none are given.
std::vector<Recipe> quality_recipes();

struct PeerSettings {
    std::vector<Recipe> recipes;
    std::vector<EmbreeVariant> variants;  ///< none: Boxwood alone
    Camera camera;
    int size = 1024;                 ///< pixels of the square picture along a side
    std::vector<int> threads = {1};  ///< each a table of its own; 1: pinned to a core
    std::vector<std::string> kinds;  ///< of kRayKinds; empty: all
    bool with_fast_mode = true;      ///< beside exact mode
    size_t sample_count = 2000;      ///< rays of each kind judged by rational arithmetic, and those disputed
    int builds = 1;                  ///< of each structure, the median of their times counts
    double seconds = 2.0;            ///< at least, for the rounds of each kind
    uint64_t least_rounds = 7;
    uint64_t seed = 1;  ///< of the order within rounds
};

inline constexpr const char* kRayKinds[] = {"primary", "diffuse", "shadow", "primary packets"};

/// One contestant on one kind of rays.
struct PeerRow {
    std::string scene, contestant, recipe, mode;  ///< recipe and mode: of Boxwood alone
    std::string rays_kind;
    int threads = 1;
    uint64_t triangles = 0, rays = 0;
    double build_ms = 0.0;   ///< on so many threads
    uint64_t bytes = 0;      ///< of the structure, without the mesh
    std::vector<double> ms;  ///< of each round
    uint64_t refused = 0;    ///< rounds whose answers were not those judged
    uint64_t hits_hash = 0;
    uint64_t disputed = 0;  ///< rays of the cell that contestants answer differently
    PeerErrors errors;
    std::string best_peer;  ///< of the cell
    RatioInterval ratio;    ///< rate over the best peer's; NaN where there is none
    std::vector<std::pair<std::string, double>> over_peers;  ///< rate over that of each peer of the cell
    double over_fast = 0.0;  ///< exact mode: its time over fast mode's; otherwise NaN

    bool is_peer() const { return recipe.empty(); }
    double mrays_per_s() const;
    bool holds() const;  ///< exact mode: no answer is wrong or changed
};

/// All rays of the scene, the same for every contestant: size^2 camera rays, one cosine-distributed bounce
/// from each of their hits, a shadow ray from each of their hits that faces the light (light_by_camera), and
/// the camera rays again in the renderer's tiles, in blocks of 4 x 4, for those who cast packets.
std::vector<RaySet> peer_rays(const Structure& structure, const Scene& scene, const PeerSettings& settings,
                              Task& task);

/// Rows in the order of threads, kinds, contestants. All cast all rays one after the other in the order given
/// and write the same answers; first a pass whose answers are judged and which warms up, then rounds over all
/// contestants in random order. After a stop not to be used.
std::vector<PeerRow> run_peers(std::shared_ptr<const Scene> scene, const PeerSettings& settings, Task& task);

/// Geometric mean, worst cell: for each contestant of Boxwood in each mode and number of threads; packets
/// apart.
std::vector<RatioSummary> summarize(std::span<const PeerRow> rows);

/// The ratios again, crosswise: a row for each scene, number of threads and contestant, a column for each
/// kind of rays.
std::vector<ReportRow> ratio_table(std::span<const PeerRow> rows);

/// With the keys of the design.
ReportRow report_row(const PeerRow& row);
/// What the table shows of it.
ReportRow short_row(const PeerRow& row);
ReportRow report_row(const RatioSummary& summary);

}  // namespace boxwood::bench
