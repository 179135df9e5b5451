#pragma once

#include "app/gl/program.h"
#include "app/gl/render_target.h"
#include "core/scene/camera.h"

namespace boxwood {

/// The three axes as the camera sees them, with their letters, in the lower left corner.
class AxisCross {
public:
    /// Into the viewport that is bound, of this size; scale: of the interface.
    void draw(const CameraFrame& camera, int width, int height, float scale) const;

private:
    Program program_{"segments.vert", "segments.frag"};
    VertexArray no_vertices_ = make_vertex_array();
};

}  // namespace boxwood
