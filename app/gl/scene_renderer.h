#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "app/gl/picture_renderer.h"
#include "app/gl/render_target.h"
#include "app/viewer/draw_list.h"
#include "core/refs/prim_ref.h"
#include "core/scene/camera.h"
#include "core/scene/mesh.h"
#include "core/structure/node_list.h"

namespace boxwood {

/// Draws the 3D view. What a scene or a structure needs is uploaded once, by the set functions; draw()
/// uploads nothing that grows with the scene. Made and used with the same context current.
class SceneRenderer {
public:
    SceneRenderer();
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// The surface; forgets boxes and references.
    void set_mesh(const Mesh& mesh);
    /// The node boxes, or their outlines, one buffer in level order.
    void set_boxes(const LevelTable& levels, const BoxValues& values);
    /// Which primitives are split (red) and the boxes of their references.
    void set_references(std::span<const PrimRef> refs, size_t triangle_count);
    /// A BoxMark for each node of the levels that set_boxes had; none: nothing hidden, nothing visited.
    void set_box_marks(const LevelTable& levels, std::span<const uint32_t> marks);
    /// TriangleMark bits for each triangle, in place of what set_references found out.
    void set_triangle_marks(std::span<const uint8_t> marks);
    /// A picture that stands behind boxes and lines in place of the background; uploaded where `version`
    /// differs from the last one's; versions begin with 1. Nothing: clear_picture().
    void set_picture(const Image& image, uint64_t version);
    void clear_picture();

    /// Draws into `rect` of the target; an empty rect draws nothing.
    void draw(const DrawList& list, const Camera& camera, RenderTarget& target, const PixelRect& rect);

    /// Of the last draw(). Waits for the GPU.
    BoxCounts box_counts() const;
    BoxCounts reference_box_counts() const;

    uint64_t upload_count() const;  ///< uploads so far, by the set functions
    size_t byte_count() const;      ///< of memory held on the GPU for the scene and its boxes

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood
