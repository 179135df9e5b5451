#pragma once

#include <vector>

#include "app/viewer/action.h"
#include "app/viewer/layout.h"
#include "core/scene/scene.h"

namespace boxwood {

/// What the mouse is doing in the view, between frames.
struct ViewInput {
    enum class Drag : uint8_t { None, Orbit, Pan, Look, Wipe };
    Drag drag = Drag::None;
    Vec2 pressed{0.0f};        ///< where the left button went down
    bool may_click = false;    ///< it has not moved since, so that letting it go is a click
    float wheel_pause = 1.0f;  ///< seconds since the wheel turned
    WipeBar bar;               ///< that is dragged, as it was when it was taken hold of
};

/// Moves the state's camera or wipe bar, or picks a node or a ray, as mouse and flying keys of this ImGui
/// frame ask. True while something is being moved, so that the whole move is one step to undo.
bool move_camera(ViewerState& state, ViewInput& input, const FrameLayout& layout, const Camera& camera,
                 const Box& scene, std::vector<Action>& actions);

}  // namespace boxwood
