#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/viewer/state.h"
#include "core/base/task.h"

namespace boxwood {

struct Built;

/// How often rays visited the nodes of a structure.
struct Visits {
    std::vector<uint32_t> by_node;  ///< as long as NodeList::nodes
    uint32_t most = 0;
    uint64_t ray_count = 0;
    uint64_t visited_nodes = 0;  ///< nodes with a visit
};

/// What casting rays adds to a frame.
struct CastResults {
    std::shared_ptr<const Visits> visits;  ///< that the colours show; null: none
    Hit ray_hit;                           ///< of the picked ray
};

Ray ray_of(const PickedRay& picked);

/// Visits of the rays' closest hits, on all threads. After a stop not to be used. task.done counts rays.
Visits count_visits(const Built& built, std::span<const Ray> rays, Mode mode, Task& task);

/// The rays through the pixel centres, row by row, row 0 on top.
std::vector<Ray> picture_rays(const Camera& camera, int width, int height);

}  // namespace boxwood
