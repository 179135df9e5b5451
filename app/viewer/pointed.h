#pragma once

#include <optional>

#include "app/viewer/box_values.h"
#include "app/viewer/state.h"
#include "core/catalog/pipeline.h"

namespace boxwood {

/// What lies under the pointer.
struct Pointed {
    Hit hit;
    Vec3 point{0.0f};          ///< of the hit
    uint32_t node = kNoIndex;  ///< smallest of the boxes shown that holds the point; kNoIndex: none
    uint32_t level = 0;        ///< of the node
    double references = 0.0;   ///< below it
    double sah_share = 0.0;    ///< its own, 0 to 1
    bool leaf = false;
    uint32_t hit_references = 0;  ///< references of the primitive that was hit
};

/// Casts the ray through the structure that is shown. Nothing where it misses.
std::optional<Pointed> point_at(const Built& built, const BoxValues& values, const ViewerState& state,
                                const Ray& ray);

}  // namespace boxwood
