#pragma once

#include <cstdint>
#include <optional>

#include "core/base/task.h"
#include "core/catalog/recipe.h"
#include "core/scene/mesh.h"
#include "core/structure/structure.h"

namespace boxwood::bench {

/// A structure with what making it took.
struct TimedBuild {
    Structure structure;
    uint64_t references = 0;  ///< that the first stage made
    double references_ms = 0.0;
    double build_ms = 0.0;  ///< builder and transforms

    double ms() const { return references_ms + build_ms; }
};

/// Runs the stages one after the other, without the cache and its hashes, on so many threads, timed by
/// clock_ms(threads). Nothing after a stop. Throws Error (WrongUsage) for a transform of another frame.
std::optional<TimedBuild> build_timed(const Recipe& recipe, const Mesh& mesh, int threads, Task& task);

}  // namespace boxwood::bench
