#pragma once

#include <vector>

#include "core/wide_bvh/collapse.h"

namespace boxwood {

/// Rays of `viewers` who stand anywhere in the scene's box and look anywhere, uniformly, and after them a
/// bounce, by the cosine of its angle, of each that hits something: what is seen and lit from within. The
/// same for every hierarchy over the mesh. Not all of them after a stop.
std::vector<Ray> viewer_rays(const Mesh& mesh, const WideBvh<16>& bvh, size_t viewers, const Task& task);

/// What nearest hits of such rays cost, for each ray on average, in the unit of `costs`: a sixteenth of a
/// node for each box of a child that is tested, an eighth of a pack for each triangle.
///
/// The SAH cost (see wide_cost) is that of rays which come from outside and hit nothing, and is wrong about
/// closed rooms, where rays begin and end. Bittner, Havran, "RDH: Ray Distribution Heuristics for
/// Construction of Spatial Data Structures", SCCG 2009, counts rays for every split; here they judge whole
/// hierarchies.
double sampled_cost(const WideBvh<16>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                    const WideCosts& costs, const Task& task);

}  // namespace boxwood
