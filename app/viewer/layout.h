#pragma once

#include "app/viewer/camera_control.h"
#include "app/viewer/state.h"

namespace boxwood {

/// Where the parts of a frame stand, in whole pixels.
struct FrameLayout {
    ViewRect left, right, status;  ///< panels and status line; of width 0 where panels are hidden
    ViewRect view;                 ///< what is left for the 3D view
    ViewRect scene;                ///< the OpenGL picture: the view or its left half
    ViewRect traced;               ///< the traced picture: none, the right half, or the same as `scene`
};

/// A function of the state alone. A frame too narrow for panels and view has no panels.
FrameLayout make_layout(const ViewerState& state);

}  // namespace boxwood
