#pragma once

#include <vector>

#include "app/viewer/camera_control.h"
#include "app/viewer/marks.h"
#include "core/structure/node_list.h"

namespace boxwood {

/// A click into the 3D view.
struct PickPoint {
    Vec2 pointer;  ///< in the window, in pixels
    ViewRect view;
    Camera camera;
    float surface_t;  ///< of the pointer's ray where it meets the visible surface; infinity: it does not
};

/// Nodes under the pointer among those whose boxes the state shows, the best first; at most kMostPicked.
/// First those one of whose lines is near the pointer and not behind the surface, the nearest line first, of
/// about equally near ones the smallest box; then those that hold the surface's point, then those that the
/// ray passes before the surface, the smallest box first. With see-through boxes no surface hides anything.
std::vector<uint32_t> pick_nodes(const ViewerState& state, const LevelTable& levels,
                                 const Visibility& visibility, const Visits* visits, const PickPoint& point);

/// Puts in place of the nodes that the state names, which are those of one structure, nodes of another one
/// over the same scene: the smallest that contain their boxes, of equally small ones the lowest.
void find_nodes_again(SideState& state, const NodeList& from, const NodeList& to);

inline constexpr size_t kMostPicked = 256;

/// The candidate after `selected`; the first one if that is none of them, kNoIndex if there is none.
uint32_t next_candidate(const std::vector<uint32_t>& candidates, uint32_t selected);

}  // namespace boxwood
