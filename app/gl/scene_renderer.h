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

/// Draws the 3D view of a surface and of one or two structures over it, set 0 and set 1. What a scene or a
/// structure needs is uploaded once, by the set functions; draw() uploads nothing that grows with the scene.
/// Made and used with the same context current.
class SceneRenderer {
public:
    SceneRenderer();
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    /// The surface; forgets boxes and references.
    void set_mesh(const Mesh& mesh);
    /// The node boxes, or their outlines, one buffer in level order.
    void set_boxes(const LevelTable& levels, const BoxValues& values, size_t set = 0);
    /// Which primitives are split (red) and the boxes of their references.
    void set_references(std::span<const PrimRef> refs, size_t triangle_count, size_t set = 0);
    /// A BoxMark for each node of the levels that set_boxes had; none: nothing hidden, nothing visited.
    void set_box_marks(const LevelTable& levels, std::span<const uint32_t> marks, size_t set = 0);
    /// TriangleMark bits for each triangle, in place of what set_references found out.
    void set_triangle_marks(std::span<const uint8_t> marks, size_t set = 0);
    /// A picture that stands behind boxes and lines in place of the background; uploaded where `version`
    /// differs from the last one's; versions begin with 1. Nothing: clear_picture().
    void set_picture(const Image& image, uint64_t version, size_t set = 0);
    void clear_picture(size_t set = 0);
    /// Forgets boxes, references, marks and picture of a set.
    void clear(size_t set);

    /// Draws a set's picture, that fills `rect` of the target, and of it only `part`; an empty one draws
    /// nothing.
    void draw(const DrawList& list, const Camera& camera, RenderTarget& target, const PixelRect& rect,
              const PixelRect& part, size_t set);
    void draw(const DrawList& list, const Camera& camera, RenderTarget& target, const PixelRect& rect) {
        draw(list, camera, target, rect, rect, 0);
    }

    /// Of the set's last draw(), over the whole of `rect`. Waits for the GPU.
    BoxCounts box_counts(size_t set = 0) const;
    BoxCounts reference_box_counts(size_t set = 0) const;

    uint64_t upload_count() const;  ///< uploads so far, by the set functions
    size_t byte_count() const;      ///< of memory held on the GPU for the scene and its boxes

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood
