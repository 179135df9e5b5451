#include "app/viewer/camera_control.h"

#include <gtest/gtest.h>

#include <numbers>

namespace boxwood {
namespace {

constexpr Vec3 kUp(0.0f, 1.0f, 0.0f);
constexpr ViewRect kView{100.0f, 50.0f, 800.0f, 600.0f};
constexpr float kQuarter = std::numbers::pi_v<float> / 2.0f;

Camera camera_at(const Vec3& eye, const Vec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    return camera;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-4f) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Where a point appears in the window: the inverse of pointer_ray, by search along both axes.
Vec2 on_screen(const Camera& camera, const Vec3& point) {
    const double aspect = static_cast<double>(kView.width / kView.height);
    const CameraFrame frame = camera_frame(camera, aspect);
    const DVec3 to = DVec3(point) - frame.eye;
    const double depth = frame.orthographic ? 1.0 : glm::dot(to, frame.forward);
    const double x = glm::dot(to, frame.right) / depth / frame.half_width;
    const double y = glm::dot(to, frame.up) / depth / frame.half_height;
    return {kView.x + kView.width * static_cast<float>(0.5 + 0.5 * x),
            kView.y + kView.height * static_cast<float>(0.5 - 0.5 * y)};
}

TEST(CameraControl, OrbitsAboutTheTarget) {
    const Camera camera = camera_at({1.0f, 2.0f, 8.0f}, {1.0f, 2.0f, 3.0f});
    const Camera turned = orbit(camera, kUp, kQuarter, 0.0f);
    expect_near(turned.target, camera.target);
    expect_near(turned.eye, {6.0f, 2.0f, 3.0f});
    const Camera risen = orbit(camera, kUp, 0.0f, kQuarter / 3.0f);
    expect_near(risen.eye, Vec3(1.0f, 2.0f + 2.5f, 3.0f + 5.0f * std::sqrt(0.75f)));
}

TEST(CameraControl, OrbitStopsBeforeThePoles) {
    Camera camera = camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f});
    for (int i = 0; i < 100; ++i) camera = orbit(camera, kUp, 0.0f, 0.3f);
    EXPECT_LT(camera.eye.y, 5.0f);
    EXPECT_GT(camera.eye.z, 0.0f);
    EXPECT_NEAR(glm::length(camera.eye), 5.0f, 1e-3f);
}

TEST(CameraControl, PanLetsTheTargetFollowThePointer) {
    for (const bool orthographic : {false, true}) {
        Camera camera = camera_at({3.0f, 4.0f, 5.0f}, {0.0f, 1.0f, 0.0f});
        camera.orthographic = orthographic;
        const Vec3 held = camera.target;
        const Vec2 before = on_screen(camera, held);
        const Vec2 after = on_screen(pan(camera, {37.0f, -20.0f}, kView), held);
        EXPECT_NEAR(after.x - before.x, 37.0f, 0.1f);
        EXPECT_NEAR(after.y - before.y, -20.0f, 0.1f);
    }
}

TEST(CameraControl, ZoomKeepsWhatIsUnderThePointer) {
    for (const bool orthographic : {false, true}) {
        Camera camera = camera_at({3.0f, 4.0f, 5.0f}, {0.0f, 1.0f, 0.0f});
        camera.orthographic = orthographic;
        const CameraFrame frame = camera_frame(camera, 1.0);
        const Vec3 point = camera.target + Vec3(0.7 * frame.right - 0.4 * frame.up);
        const Vec2 pointer = on_screen(camera, point);
        const Camera closer = zoom_to(camera, pointer, 0.5f, kView);
        EXPECT_NEAR(glm::distance(closer.eye, closer.target), 0.5f * glm::distance(camera.eye, camera.target),
                    1e-4f);
        EXPECT_LT(glm::distance(on_screen(closer, point), pointer), 0.1f);
    }
}

TEST(CameraControl, FliesAlongTheView) {
    const Camera camera = camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f});
    const Camera moved = fly(camera, kUp, {1.0f, 2.0f, 3.0f});
    expect_near(moved.eye, {1.0f, 2.0f, 2.0f});
    expect_near(moved.target, {1.0f, 2.0f, -3.0f});
}

TEST(CameraControl, LooksAroundFromTheSamePlace) {
    const Camera camera = camera_at({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f});
    const Camera turned = look_around(camera, kUp, kQuarter, 0.0f);
    expect_near(turned.eye, camera.eye);
    expect_near(turned.target, {-5.0f, 0.0f, 5.0f});
}

TEST(CameraControl, FocusLooksAtThePointFromTheSameDirection) {
    const Camera camera = camera_at({0.0f, 0.0f, 6.0f}, {0.0f, 0.0f, 0.0f});
    const Box scene{Vec3(-1.0f), Vec3(1.0f)};
    const Camera focused = focus_on(camera, {1.0f, 0.0f, 0.0f}, scene);
    expect_near(focused.target, {1.0f, 0.0f, 0.0f});
    expect_near(glm::normalize(focused.eye - focused.target), {0.0f, 0.0f, 1.0f});
    const Camera at_point = focus_on(camera, camera.eye, scene);
    EXPECT_GT(glm::distance(at_point.eye, at_point.target), 1e-3f);
}

TEST(CameraControl, AxisViewsShowTheWholeScene) {
    const Box scene{Vec3(-1.0f, -2.0f, -3.0f), Vec3(1.0f, 2.0f, 9.0f)};
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool negative : {false, true}) {
            const Camera camera = axis_view(Camera{}, scene, axis, negative, kUp);
            EXPECT_EQ(camera.eye[axis] > camera.target[axis], !negative);
            const CameraFrame frame = camera_frame(camera, 1.0);
            EXPECT_NEAR(std::abs(frame.forward[axis]), 1.0, 1e-6);
            EXPECT_NEAR(glm::dot(frame.up, DVec3(camera.up)), 1.0, 1e-6);
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 p(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 2.0f : -2.0f, corner & 4 ? 9.0f : -3.0f);
                const Vec2 place = on_screen(camera, p);
                EXPECT_TRUE(kView.contains(place));
            }
        }
    }
}

TEST(CameraControl, AcceptsScenesWithoutSize) {
    const Box point{Vec3(2.0f), Vec3(2.0f)};
    for (const Box& scene : {Box{}, point}) {
        EXPECT_EQ(scene_size(scene), 1.0f);
        const Camera camera = whole_view(Camera{}, scene, kUp);
        EXPECT_TRUE(std::isfinite(camera.eye.x));
        EXPECT_GT(glm::distance(camera.eye, camera.target), 0.1f);
    }
}

TEST(CameraControl, ThePointersRayMeetsWhatIsUnderIt) {
    const Camera camera = camera_at({3.0f, 4.0f, 5.0f}, {0.0f, 1.0f, 0.0f});
    const Vec3 point(0.5f, 0.2f, -0.3f);
    const Ray ray = pointer_ray(camera, on_screen(camera, point), kView);
    const Vec3 to = point - ray.origin;
    EXPECT_LT(glm::length(glm::cross(glm::normalize(to), glm::normalize(ray.direction))), 1e-3f);
}

}  // namespace
}  // namespace boxwood
