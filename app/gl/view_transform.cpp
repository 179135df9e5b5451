#include "app/gl/view_transform.h"

#include <algorithm>

namespace boxwood {
namespace {

constexpr double kNear = 1e-5;          // of the scene's size
constexpr double kHalfDiagonal = 0.75;  // of most scenes: half the diagonal of a cube is 0.87

}  // namespace

UnitSpace UnitSpace::of(const Box& scene) {
    UnitSpace space;
    if (scene.is_empty()) return space;
    const DVec3 extent = scene.extent();
    const double size = std::max({extent.x, extent.y, extent.z});
    space.origin = scene.center();
    if (size > 0.0) space.scale = 1.0 / size;
    return space;
}

FrameUniforms frame_uniforms(const CameraFrame& camera, const UnitSpace& space, int width, int height) {
    const DVec3 eye = space.from_world(camera.eye);
    const DVec3 axes[] = {camera.right, camera.up, -camera.forward};
    glm::dmat4 view(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) view[column][row] = axes[row][column];
        view[3][row] = -glm::dot(axes[row], eye);
    }
    const double size = camera.orthographic ? space.scale : 1.0;
    const double far = glm::length(eye) + 2.0;
    FrameUniforms uniforms;
    uniforms.view = glm::mat4(view);
    uniforms.projection =
        Vec4(glm::dvec4(camera.half_width * size, camera.half_height * size,
                        camera.orthographic ? far : kNear, camera.orthographic ? 1.0 : 0.0));
    const double center_depth = glm::dot(-eye, camera.forward);
    uniforms.viewport = Vec4(static_cast<float>(width), static_cast<float>(height),
                             static_cast<float>(std::max(center_depth - kHalfDiagonal, 0.0)),
                             static_cast<float>(std::max(center_depth + kHalfDiagonal, kHalfDiagonal)));
    return uniforms;
}

}  // namespace boxwood
