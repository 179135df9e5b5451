#pragma once

#include "core/base/box.h"
#include "core/scene/camera.h"

namespace boxwood {

/// The scene's box moved to the origin and scaled to size 1 along its longest side, so that float on the GPU
/// serves scenes of any place and size.
struct UnitSpace {
    DVec3 origin{0.0};
    double scale = 1.0;  ///< unit lengths of one world length

    /// Of a box that is empty or a point: no change of scale.
    static UnitSpace of(const Box& scene);
    Vec3 from_world(const Vec3& point) const { return Vec3((DVec3(point) - origin) * scale); }
    DVec3 from_world(const DVec3& point) const { return (point - origin) * scale; }
};

/// The uniform block Frame of shaders/frame.glsl.
struct FrameUniforms {
    glm::mat4 view;
    Vec4 projection;
    Vec4 viewport;
};

/// Perspective: depth = near / distance, without a far end. Orthographic: depth falls linearly to 0 behind
/// the scene.
FrameUniforms frame_uniforms(const CameraFrame& camera, const UnitSpace& space, int width, int height);

}  // namespace boxwood
