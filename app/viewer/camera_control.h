#pragma once

#include "app/viewer/state.h"
#include "core/base/box.h"
#include "core/scene/camera.h"

namespace boxwood {

/// Part of the window that shows a camera's picture, in pixels; (0, 0) is the window's top left corner.
struct ViewRect {
    float x = 0.0f;
    float y = 0.0f;
    float width = 0.0f;
    float height = 0.0f;

    bool contains(const Vec2& p) const { return p.x >= x && p.y >= y && p.x < x + width && p.y < y + height; }
    bool operator==(const ViewRect&) const = default;
};

/// Turns the eye about the target: `yaw` about the up axis, `pitch` towards it, in radians. Ends one degree
/// before the poles.
Camera orbit(const Camera& camera, const Vec3& up, float yaw, float pitch);

/// Turns the target about the eye.
Camera look_around(const Camera& camera, const Vec3& up, float yaw, float pitch);

/// Moves eye and target so that what lies at the target's distance follows the pointer by `delta` pixels.
Camera pan(const Camera& camera, const Vec2& delta, const ViewRect& view);

/// Moves the eye so that its distance from the target becomes `factor` times as long, and what lies under
/// `pointer` at the target's distance stays there. factor > 0.
Camera zoom_to(const Camera& camera, const Vec2& pointer, float factor, const ViewRect& view);

/// Moves eye and target along the view: x to the right, y along `up`, z forward, in world units.
Camera fly(const Camera& camera, const Vec3& up, const Vec3& motion);

/// Looks at `point` from the same direction, from a third of the distance, but not closer than a thousandth
/// of the scene's size.
Camera focus_on(const Camera& camera, const Vec3& point, const Box& scene);

/// The whole box along an axis, from its positive end or, `negative`, the other one. Keeps field of view and
/// projection.
Camera axis_view(const Camera& camera, const Box& scene, int axis, bool negative, const Vec3& up);

/// The whole box from where the camera looks now.
Camera whole_view(const Camera& camera, const Box& scene, const Vec3& up);

/// The ray under a position in the window.
Ray pointer_ray(const Camera& camera, const Vec2& pointer, const ViewRect& view);

/// Length of a box's diagonal, 1 where it is empty: the measure of speeds and distances.
float scene_size(const Box& scene);

}  // namespace boxwood
