#include "app/gl/axis_cross.h"

#include <algorithm>
#include <array>
#include <vector>

namespace boxwood {
namespace {

constexpr size_t kMostSegments = 16;                               // see segments.vert
constexpr float kArm = 30.0f, kLetterAt = 38.0f, kCenter = 50.0f;  // pixels at scale 1

const std::array<Vec3, 3> kAxisColors = {Vec3(0.93f, 0.38f, 0.33f), Vec3(0.45f, 0.74f, 0.34f),
                                         Vec3(0.40f, 0.60f, 0.98f)};
constexpr Vec3 kCasingColor(0.09f, 0.10f, 0.12f);

/// Strokes of X, Y and Z in a square from -1 to 1.
const std::array<std::vector<Vec4>, 3> kLetters = {{
    {Vec4(-0.8f, -1.0f, 0.8f, 1.0f), Vec4(-0.8f, 1.0f, 0.8f, -1.0f)},
    {Vec4(-0.8f, 1.0f, 0.0f, 0.0f), Vec4(0.8f, 1.0f, 0.0f, 0.0f), Vec4(0.0f, 0.0f, 0.0f, -1.0f)},
    {Vec4(-0.8f, 1.0f, 0.8f, 1.0f), Vec4(0.8f, 1.0f, -0.8f, -1.0f), Vec4(-0.8f, -1.0f, 0.8f, -1.0f)},
}};
constexpr float kLetterSize = 3.6f;  // half of it, in pixels at scale 1

}  // namespace

void AxisCross::draw(const CameraFrame& camera, int width, int height, float scale) const {
    const float room = std::min(static_cast<float>(std::min(width, height)) / 2.0f, kCenter * scale);
    const float unit = room / kCenter;
    std::array<int, 3> order = {0, 1, 2};  // the farthest axis first
    const auto depth = [&](int axis) { return camera.forward[axis]; };
    std::ranges::sort(order, std::ranges::greater{}, depth);

    std::vector<Vec4> segments;
    std::vector<Vec3> colors;
    for (const int axis : order) {
        const Vec2 direction(static_cast<float>(camera.right[axis]), static_cast<float>(camera.up[axis]));
        const Vec2 center(room);
        const auto add = [&](Vec2 from, Vec2 to) {
            segments.push_back(Vec4(from, to));
            colors.push_back(kAxisColors[static_cast<size_t>(axis)]);
        };
        add(center, center + kArm * unit * direction);
        const Vec2 at = center + kLetterAt * unit * direction;
        for (const Vec4& stroke : kLetters[static_cast<size_t>(axis)]) {
            const float size = kLetterSize * unit;
            add(at + size * Vec2(stroke.x, stroke.y), at + size * Vec2(stroke.z, stroke.w));
        }
    }
    static_assert(kMostSegments >= 3 + 2 + 3 + 3);
    program_.set("segments", std::span<const Vec4>(segments));
    program_.set("viewport_size", Vec2(static_cast<float>(width), static_cast<float>(height)));
    program_.use();
    glDisable(GL_BLEND);
    glBindVertexArray(no_vertices_.name());
    const auto stroke = [&](const std::vector<Vec3>& stroke_colors, float stroke_width) {
        program_.set("colors", std::span<const Vec3>(stroke_colors));
        program_.set("width", stroke_width * unit);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(6 * segments.size()));
    };
    stroke(std::vector<Vec3>(segments.size(), kCasingColor), 3.6f);
    stroke(colors, 1.6f);
}

}  // namespace boxwood
