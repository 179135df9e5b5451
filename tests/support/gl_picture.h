#pragma once

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "app/gl/context_osmesa.h"
#include "app/gl/read_pixels.h"
#include "app/gl/scene_renderer.h"

namespace boxwood {

inline constexpr int kSize = 200;

/// Looks along -z; one world unit is 50 pixels at the target (0, 0, 0), which is in the picture's middle.
inline Camera front_camera(bool orthographic) {
    Camera camera;
    camera.eye = {0.0f, 0.0f, 10.0f};
    camera.target = {0.0f, 0.0f, 0.0f};
    camera.fov = static_cast<float>(2.0 * std::atan(2.0 / 10.0) * 180.0 / 3.14159265358979323846);
    camera.orthographic = orthographic;
    return camera;
}

inline NodeView node(const Box& bounds, uint32_t parent, uint32_t level, NodeKind kind) {
    return {.bounds = bounds, .parent = parent, .level = level, .kind = kind, .first_ref = 0, .ref_count = 1};
}

/// A root with leaves below it.
inline NodeList root_with_leaves(const std::vector<Box>& leaves) {
    NodeList list;
    Box all;
    for (const Box& leaf : leaves) all.extend(leaf);
    list.nodes.push_back(node(all, kNoIndex, 0, NodeKind::Inner));
    for (const Box& leaf : leaves) list.nodes.push_back(node(leaf, 0, 1, NodeKind::Leaf));
    return list;
}

/// Two triangles that form a square of side 2 * half at this z.
inline Mesh square(float half, float z, uint32_t count = 2) {
    Mesh mesh;
    mesh.positions = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangles.resize(count);
    mesh.source_prim = {0, 1};
    mesh.object = {0, 0};
    mesh.objects = {{"square", Vec3(0.5f)}};
    return mesh;
}

struct Rgb {
    int red, green, blue;
};

inline Rgb at(const Image& image, int x, int y) {
    const uint8_t* pixel = image.pixel(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

inline int difference(const Rgb& a, const Rgb& b) {
    return std::abs(a.red - b.red) + std::abs(a.green - b.green) + std::abs(a.blue - b.blue);
}

class GlTest : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(context_.messages().first_error, ""); }

    /// A list with nothing but boxes of one colour on black.
    static DrawList plain_list(const LevelTable& levels, const LevelRange& range) {
        DrawList list;
        list.mesh = MeshLook::Hidden;
        list.boxes = select_boxes(levels, range, true);
        list.colors.palette.fill(Vec3(1.0f));
        list.line_width = 2.0f;
        list.axis_cross = false;
        return list;
    }
    void set_boxes(const LevelTable& levels) { renderer_.set_boxes(levels, make_box_values(levels.list)); }
    Image draw(const DrawList& list, const Camera& camera) {
        renderer_.draw(list, camera, target_, {0, 0, kSize, kSize});
        return read_pixels(target_);
    }

    OsmesaContext context_;
    RenderTarget target_{kSize, kSize};
    SceneRenderer renderer_;
};

}  // namespace boxwood
