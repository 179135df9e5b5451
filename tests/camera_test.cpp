#include "core/scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace boxwood {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Camera looking_down_z() {
    return {.eye = {1.0f, 2.0f, 3.0f}, .target = {1.0f, 2.0f, -7.0f}, .up = {0.0f, 1.0f, 0.0f}, .fov = 90.0f};
}

void expect_near(const Vec3& a, const Vec3& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6f);
    EXPECT_NEAR(a.y, b.y, 1e-6f);
    EXPECT_NEAR(a.z, b.z, 1e-6f);
}

void expect_orthonormal(const CameraFrame& frame) {
    EXPECT_NEAR(glm::length(frame.forward), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(frame.right), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(frame.up), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.forward, frame.right), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.forward, frame.up), 0.0, 1e-12);
    EXPECT_NEAR(glm::dot(glm::cross(frame.right, frame.up), -frame.forward), 1.0, 1e-12);
    EXPECT_TRUE(frame.half_width > 0.0 && std::isfinite(frame.half_width));
    EXPECT_TRUE(frame.half_height > 0.0 && std::isfinite(frame.half_height));
}

TEST(Camera, RaysGoThroughTheImagePlaneAtDistanceOne) {
    // 90 degrees: the plane spans [-2, 2] x [-1, 1] for aspect 2; (0, 0) is its top left corner.
    const CameraFrame frame = camera_frame(looking_down_z(), 2.0);
    expect_near(camera_ray(frame, 0.0, 0.0, 8, 4).direction, {-2.0f, 1.0f, -1.0f});
    expect_near(camera_ray(frame, 8.0, 4.0, 8, 4).direction, {2.0f, -1.0f, -1.0f});
    expect_near(camera_ray(frame, 4.0, 2.0, 8, 4).direction, {0.0f, 0.0f, -1.0f});
    expect_near(camera_ray(frame, 4.0, 2.0, 8, 4).origin, {1.0f, 2.0f, 3.0f});
}

TEST(Camera, PixelCentresLieAtPlusOneHalf) {
    // A picture of 2 x 2 pixels: the centre of the upper left one is a quarter of the picture in.
    const CameraFrame frame = camera_frame(looking_down_z(), 1.0);
    expect_near(camera_ray(frame, 0.5, 0.5, 2, 2).direction, {-0.5f, 0.5f, -1.0f});
    expect_near(camera_ray(frame, 1.5, 0.5, 2, 2).direction, {0.5f, 0.5f, -1.0f});
    expect_near(camera_ray(frame, 0.5, 1.5, 2, 2).direction, {-0.5f, -0.5f, -1.0f});
}

TEST(Camera, OrthographicRaysAreParallelAndAsHighAsThePerspectiveAtTheTarget) {
    Camera camera = looking_down_z();
    camera.orthographic = true;  // the target is 10 away, so the picture is 20 high
    const CameraFrame frame = camera_frame(camera, 2.0);
    const Ray corner = camera_ray(frame, 0.0, 0.0, 8, 4);
    expect_near(corner.direction, {0.0f, 0.0f, -1.0f});
    EXPECT_NEAR(corner.origin.x, 1.0f - 20.0f, 1e-5f);
    EXPECT_NEAR(corner.origin.y, 2.0f + 10.0f, 1e-5f);
    EXPECT_NEAR(corner.origin.z, 3.0f, 1e-5f);
}

TEST(Camera, DegenerateCamerasGetAValidFrame) {
    Camera at_target = looking_down_z();
    at_target.target = at_target.eye;
    Camera up_along_view = looking_down_z();
    up_along_view.up = {0.0f, 0.0f, 5.0f};
    Camera no_up = looking_down_z();
    no_up.up = Vec3(0.0f);
    Camera not_numbers = looking_down_z();
    not_numbers.eye.x = not_numbers.up.y = not_numbers.fov = kNan;
    Camera far_away = looking_down_z();
    far_away.eye = Vec3(3e38f);
    far_away.target = Vec3(-3e38f);
    for (Camera camera : {at_target, up_along_view, no_up, not_numbers, far_away}) {
        for (const bool orthographic : {false, true}) {
            camera.orthographic = orthographic;
            expect_orthonormal(camera_frame(camera, 1.5));
            expect_orthonormal(camera_frame(camera, 0.0));
        }
    }
}

/// The largest of |x| and |y| of the box's corners in a square picture, in half heights; above 1 is outside.
double reach(const Box& box, const Camera& camera) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x,
                      (corner & 2) != 0 ? box.upper.y : box.lower.y,
                      (corner & 4) != 0 ? box.upper.z : box.lower.z);
        const double depth = glm::dot(p - frame.eye, frame.forward);
        EXPECT_GT(depth, 0.0);
        const double x = std::abs(glm::dot(p - frame.eye, frame.right)) / (depth * frame.half_width);
        const double y = std::abs(glm::dot(p - frame.eye, frame.up)) / (depth * frame.half_height);
        largest = std::max({largest, x, y});
    }
    return largest;
}

TEST(CameraRaster, GivesTheBitsOfCameraRay) {
    constexpr int kWidth = 37, kHeight = 23;
    for (const bool orthographic : {false, true}) {
        Camera camera;
        camera.eye = {0.3f, -7.1f, 2.7f};
        camera.orthographic = orthographic;
        const CameraFrame frame = camera_frame(camera, double(kWidth) / kHeight);
        std::vector<uint32_t> pixels;
        for (uint32_t pixel = 0; pixel < kWidth * kHeight; pixel += 3) pixels.push_back(pixel);
        std::vector<Ray> rays(pixels.size());
        CameraRaster(frame, kWidth, kHeight).rays_through(pixels, rays);
        for (size_t i = 0; i < pixels.size(); ++i) {
            const Ray ray =
                camera_ray(frame, pixels[i] % kWidth + 0.5, pixels[i] / kWidth + 0.5, kWidth, kHeight);
            EXPECT_EQ(rays[i].origin, ray.origin);
            EXPECT_EQ(rays[i].direction, ray.direction);
        }
    }
}

TEST(FitCamera, FramesAllCornersWithoutWaste) {
    const Box boxes[] = {
        {Vec3(-1.0f), Vec3(1.0f)},
        {Vec3(100.0f, 0.0f, 0.0f), Vec3(101.0f, 40.0f, 3.0f)},
        {Vec3(-1e-20f, 0.0f, 0.0f), Vec3(1e-20f, 0.0f, 1e-22f)},
        {Vec3(0.0f), Vec3(1e30f, 1e20f, 1e25f)},
    };
    for (const Box& box : boxes) {
        for (const float fov : {5.0f, 45.0f, 120.0f}) {
            for (const Vec3& up : {Vec3(0.0f, 1.0f, 0.0f), Vec3(0.0f, 0.0f, 1.0f)}) {
                const double r = reach(box, fit_camera(box, fov, up));
                EXPECT_LE(r, 1.0);
                EXPECT_GE(r, 0.9);
            }
        }
    }
}

TEST(FitCamera, LooksFromTheDirectionItPromises) {
    const Box box{Vec3(-1.0f), Vec3(1.0f)};
    const Camera y_up = fit_camera(box);
    expect_near(glm::normalize(y_up.eye), glm::normalize(Vec3(0.55f, 0.45f, 0.7f)));
    const Camera z_up = fit_camera(box, 45.0f, {0.0f, 0.0f, 1.0f});
    EXPECT_GT(z_up.eye.z, 0.0f);
    EXPECT_LT(z_up.eye.y, 0.0f);
}

TEST(FitCamera, EmptyPointLikeAndHugeBoxesGiveAnEyeThatIsNotTheTarget) {
    const Box boxes[] = {
        Box{}, {Vec3(0.0f), Vec3(0.0f)}, {Vec3(1e9f), Vec3(1e9f)}, {Vec3(-3e38f), Vec3(3e38f)}};
    for (const Box& box : boxes) {
        const Camera camera = fit_camera(box);
        EXPECT_NE(camera.eye, camera.target);
        expect_orthonormal(camera_frame(camera, 1.0));
    }
}

}  // namespace
}  // namespace boxwood
