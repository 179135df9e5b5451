#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/embree_peer.h"
#include "bench/peer_judge.h"
#include "core/base/task.h"
#include "core/catalog/recipe.h"
#include "core/scene/camera.h"
#include "core/structure/structure.h"

namespace boxwood::bench {

/// One who casts rays: a structure of Boxwood in one mode, or a peer. Of the functions those are empty that
/// it has no part in.
struct Contestant {
    std::string name;          ///< "boxwood:RECIPE", "embree:high"
    std::string recipe, mode;  ///< of Boxwood alone
    std::function<void(std::span<const Ray>, std::span<Hit>)> closest_hits{};
    std::function<void(std::span<const Ray>, std::span<uint8_t>)> any_hits{};
    /// Neighbours together, by the rays or by the pixels that they go through.
    std::function<void(std::span<const Ray>, std::span<const uint32_t> pixels, std::span<Hit>)> packets{};
    Demand demand = Demand::Nearest;
    double build_ms = 0.0;  ///< median
    uint64_t bytes = 0;     ///< of the structure, without the mesh

    bool takes(Casting casting) const;
};

/// How contestants are built, and what the renderer among them looks at.
struct ContestantSettings {
    int threads = 1;
    int builds = 1;              ///< of each, the median of their times counts; several: after one more
    bool with_fast_mode = true;  ///< beside exact mode
    Camera camera;
    int size = 1024;  ///< pixels of the square picture along a side
};

/// Builds the recipe and adds it: in exact mode, and with `with_fast_mode` in fast mode too; each casts the
/// rays that it is given, and beside it stands the renderer over it ("boxwood:RECIPE renderer"), which makes
/// the rays of its pixels itself. Mesh and task must outlive the contestants. The structure, or nothing after
/// a stop.
std::optional<Structure> add_recipe(std::vector<Contestant>& contestants, const Recipe& recipe,
                                    const Mesh& mesh, const ContestantSettings& settings, Task& task);

/// The same for a peer.
void add_embree(std::vector<Contestant>& contestants, const EmbreeVariant& variant, const Mesh& mesh,
                const ContestantSettings& settings);

/// Casts the whole set on so many threads. The milliseconds it took, by clock_ms. `answers` has the set's
/// size.
double cast(const Contestant& contestant, const RaySet& set, int threads, Answers& answers);

}  // namespace boxwood::bench
