#pragma once

#include <array>
#include <optional>

#include "app/viewer/camera_control.h"
#include "app/viewer/state.h"

namespace boxwood {

/// Where a picture stands, and the part of it that is seen: a wipe shows the left or right part of one.
struct PicturePlace {
    ViewRect rect;  ///< of the whole picture, which the camera fills
    ViewRect part;

    bool is_seen() const { return part.width > 0.0f && part.height > 0.0f; }
};

/// Where the pictures of one side stand.
struct SideLayout {
    PicturePlace scene;   ///< the OpenGL picture
    PicturePlace traced;  ///< the traced one: none, beside, or the same as `scene`
};

/// A wipe bar: drawn from top to bottom of `rect`.
struct WipeBar {
    float x = 0.0f;
    ViewRect rect;  ///< of the picture that it divides
};

/// Where the parts of a frame stand, in whole pixels.
struct FrameLayout {
    ViewRect left, right, status;  ///< panels and status line; of width 0 where panels are hidden
    ViewRect view;                 ///< what is left for the 3D view
    std::array<SideLayout, 2> sides;
    std::array<std::optional<WipeBar>, 2> bars;  ///< of the OpenGL pictures and of the traced ones

    const SideLayout& side(Side which) const { return sides[index_of(which)]; }
};

/// A function of the state alone. A frame too narrow for panels and view has no panels. The pictures of both
/// sides have the same size. The signed difference belongs to both sides: its picture is whole.
FrameLayout make_layout(const ViewerState& state);

/// A place in a picture.
struct PictureHit {
    Side side = Side::A;
    bool is_traced = false;  ///< in the traced picture and not in the OpenGL one
    ViewRect rect;           ///< of the whole picture
};

/// The picture under a position in the window; nothing beside them. Where both sides show one picture: A's.
std::optional<PictureHit> picture_at(const FrameLayout& layout, const Vec2& position);

/// The bar within reach of a position in the window. `scale`: of the interface.
std::optional<WipeBar> bar_at(const FrameLayout& layout, const Vec2& position, float scale);

/// The state's wipe for a bar at x: 0 to 1.
float wipe_at(const WipeBar& bar, float x);

}  // namespace boxwood
