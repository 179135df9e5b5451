#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/embree_peer.h"
#include "bench/ratios.h"
#include "core/base/task.h"
#include "core/catalog/recipe.h"
#include "core/measure/report.h"
#include "core/scene/scene.h"

namespace boxwood::bench {

struct BuildSettings {
    std::vector<Recipe> recipes;
    std::vector<EmbreeVariant> variants;  ///< none: Boxwood alone
    std::vector<int> threads = {1};
    int rounds = 5;
    uint64_t seed = 1;  ///< of the order within rounds
};

/// Builds of one recipe, or of one peer, on one number of threads.
struct BuildRow {
    std::string scene, contestant, recipe;  ///< recipe: of Boxwood alone
    int threads = 1;
    uint64_t triangles = 0, references = 0, bytes = 0;
    double sah_cost = 0.0;              ///< NaN for a peer, whose nodes are not known
    std::vector<double> ms;             ///< of each round: references, builder, transforms
    std::vector<double> references_ms;  ///< their part of it
    /// Own time over that of a peer on as many threads in the same rounds, beside the peer's name.
    std::vector<std::pair<std::string, RatioInterval>> over_peers;
    std::map<std::string, uint64_t> skipped;  ///< by the last build
};

/// Rounds over all recipes and peers on all numbers of threads in random order, timed by clock_ms. Of a peer
/// the commit of its scene is timed. Rows in the order of threads, then contestants. After a stop not to be
/// used.
std::vector<BuildRow> run_builds(const Scene& scene, const BuildSettings& settings, Task& task);

/// Every builder of the catalog that makes a binary BVH, over whole triangles.
std::vector<Recipe> bvh_recipes();

/// With the keys of the design; over_low, over_medium, over_high where there are peers.
ReportRow report_row(const BuildRow& row);

}  // namespace boxwood::bench
