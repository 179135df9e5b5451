#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {

/// Ernst, Greiner, "Early Split Clipping for Bounding Volume Hierarchies", RT 2007, figure 2: with s = 3
/// early split clipping halves each triangle's box twice along x, into four boxes.
void make_two_triangles(const SceneOptions&, Scene& scene, Task&) {
    MeshBuilder b(scene.mesh);
    b.use_object("lower triangle", {0.85f, 0.33f, 0.08f});
    b.add_triangle({0.0, 0.0, 0.2}, {8.0, 4.0, 0.0}, {8.0, 5.0, 0.4});
    b.use_object("upper triangle", {0.08f, 0.33f, 0.75f});
    b.add_triangle({8.0, 6.0, 0.2}, {0.0, 2.0, 0.4}, {0.0, 1.0, 0.0});
    scene.camera = Camera{.eye = {6.2f, 5.2f, 12.5f}, .target = {4.0f, 3.0f, 0.2f}, .fov = 32.0f};
}

}  // namespace boxwood
