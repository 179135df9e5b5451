#pragma once

#include <span>
#include <vector>

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood::bench {

/// How the answers of a stress case are judged.
enum class Judge {
    Oracle,    ///< rational arithmetic, every ray: hit or miss, primitive, bits of t
    MustHit,   ///< the rays start inside a closed mesh, or aim at the inside of a closed surface: a miss is a
               ///< leak
    MustMiss,  ///< input that cannot hit anything: non-finite, without direction
};

/// A mesh and rays that are hard for it.
struct StressCase {
    Mesh mesh;
    std::vector<Ray> rays;
};

/// One line of the accuracy page's pass marks. `make` gives the same case for the same seed on every
/// compiler.
struct StressKind {
    const char* name;
    const char* what;
    Judge judge;
    size_t ray_count;  ///< rays of one case, at most
    StressCase (*make)(uint64_t seed, size_t ray_count);
    double aimed_share = 0.0;  ///< of the rays that are to be aimed at closed meshes: the cheap kind has most
};

std::span<const StressKind> stress_kinds();

}  // namespace boxwood::bench
