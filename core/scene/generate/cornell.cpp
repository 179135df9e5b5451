#include <array>

#include "core/scene/generate/built_in.h"
#include "core/scene/generate/mesh_builder.h"

namespace boxwood {

/// Goral, Torrance, Greenberg, Battaile, "Modeling the Interaction of Light Between Diffuse Surfaces",
/// SIGGRAPH 1984, with the measured sizes that Cornell University published later; one unit is 100 mm.
void make_cornell(const SceneOptions&, Scene& scene, Task&) {
    constexpr double kWidth = 5.528, kHeight = 5.488, kDepth = 5.592;
    constexpr double kLight = kHeight - 0.002;  // just below the ceiling
    const Vec3 white(0.73f, 0.71f, 0.68f);
    MeshBuilder b(scene.mesh);
    b.use_object("floor", white);
    b.add_quad({0, 0, 0}, {0, 0, kDepth}, {kWidth, 0, kDepth}, {kWidth, 0, 0});
    b.use_object("ceiling", white);
    b.add_quad({0, kHeight, 0}, {kWidth, kHeight, 0}, {kWidth, kHeight, kDepth}, {0, kHeight, kDepth});
    b.use_object("back wall", white);
    b.add_quad({0, 0, kDepth}, {0, kHeight, kDepth}, {kWidth, kHeight, kDepth}, {kWidth, 0, kDepth});
    b.use_object("green wall", {0.12f, 0.45f, 0.15f});
    b.add_quad({0, 0, 0}, {0, kHeight, 0}, {0, kHeight, kDepth}, {0, 0, kDepth});
    b.use_object("red wall", {0.65f, 0.05f, 0.05f});
    b.add_quad({kWidth, 0, 0}, {kWidth, 0, kDepth}, {kWidth, kHeight, kDepth}, {kWidth, kHeight, 0});
    b.use_object("light", {1.0f, 0.95f, 0.8f});
    b.add_quad({2.13, kLight, 2.27}, {3.43, kLight, 2.27}, {3.43, kLight, 3.32}, {2.13, kLight, 3.32});

    const auto add_block = [&](const char* name, double height, const std::array<glm::dvec2, 4>& base) {
        b.use_object(name, white);
        std::array<DVec3, 4> low, high;
        for (size_t i = 0; i < 4; ++i) {
            low[i] = {base[i].x, 0.0, base[i].y};
            high[i] = {base[i].x, height, base[i].y};
        }
        b.add_quad(high[0], high[1], high[2], high[3]);
        for (size_t i = 0; i < 4; ++i) b.add_quad(low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]);
    };
    add_block("short block", 1.65, {{{1.30, 0.65}, {0.82, 2.25}, {2.40, 2.72}, {2.90, 1.14}}});
    add_block("tall block", 3.30, {{{4.23, 2.47}, {2.65, 2.96}, {3.14, 4.56}, {4.72, 4.06}}});
    scene.camera = Camera{.eye = {2.78f, 2.73f, -8.0f}, .target = {2.78f, 2.73f, 0.0f}, .fov = 39.3f};
}

}  // namespace boxwood
