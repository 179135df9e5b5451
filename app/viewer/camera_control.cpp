#include "app/viewer/camera_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace boxwood {
namespace {

/// Two unit vectors that make a right-handed frame with `up`: longitudes are measured between them.
struct Equator {
    DVec3 first, second;
};

Equator equator(const DVec3& up) {
    const DVec3 side = std::abs(up.z) < 0.9 ? DVec3(0.0, 0.0, 1.0) : DVec3(1.0, 0.0, 0.0);
    const DVec3 second = glm::normalize(glm::cross(up, side));
    return {glm::cross(second, up), second};
}

/// `direction`, turned about `up` by yaw and towards it by pitch, kept one degree away from the poles.
DVec3 turned(const DVec3& direction, const DVec3& up, double yaw, double pitch) {
    constexpr double kHighest = 89.0 / 180.0 * std::numbers::pi;
    const auto [first, second] = equator(up);
    const double height = glm::dot(direction, up);
    const double x = glm::dot(direction, first), y = glm::dot(direction, second);
    const double longitude = std::atan2(y, x) + yaw;
    const double latitude = std::clamp(std::atan2(height, std::hypot(x, y)) + pitch, -kHighest, kHighest);
    const DVec3 flat = std::cos(longitude) * first + std::sin(longitude) * second;
    return std::cos(latitude) * flat + std::sin(latitude) * up;
}

double distance_of(const Camera& camera) { return glm::distance(DVec3(camera.eye), DVec3(camera.target)); }

/// World units of a pixel at the target's distance.
double pixel_size(const Camera& camera, const ViewRect& view) {
    const double slope = std::tan(0.5 * static_cast<double>(camera.fov) / 180.0 * std::numbers::pi);
    return 2.0 * slope * distance_of(camera) / static_cast<double>(view.height);
}

/// From the target to the eye, of length 1.
DVec3 backward(const Camera& camera) { return -camera_frame(camera, 1.0).forward; }

/// The distance from which a ball around the box fills the picture's height.
double whole_distance(const Camera& camera, const Box& scene) {
    const double slope = std::sin(0.5 * static_cast<double>(camera.fov) / 180.0 * std::numbers::pi);
    return 0.5 * static_cast<double>(scene_size(scene)) / slope;
}

Camera placed(const Camera& camera, const DVec3& target, const DVec3& back, double distance, const Vec3& up) {
    Camera result = camera;
    result.target = Vec3(target);
    result.eye = Vec3(target + distance * back);
    result.up = up;
    return result;
}

DVec3 middle(const Box& scene) { return scene.is_empty() ? DVec3(0.0) : scene.center(); }

}  // namespace

float scene_size(const Box& scene) {
    const double size = glm::length(scene.extent());
    return size > 0.0 && size < 1e30 ? static_cast<float>(size) : 1.0f;
}

Camera orbit(const Camera& camera, const Vec3& up, float yaw, float pitch) {
    const DVec3 back =
        turned(backward(camera), DVec3(up), static_cast<double>(yaw), static_cast<double>(pitch));
    return placed(camera, DVec3(camera.target), back, distance_of(camera), up);
}

Camera look_around(const Camera& camera, const Vec3& up, float yaw, float pitch) {
    const DVec3 ahead =
        turned(-backward(camera), DVec3(up), static_cast<double>(yaw), static_cast<double>(pitch));
    Camera result = camera;
    result.target = Vec3(DVec3(camera.eye) + distance_of(camera) * ahead);
    result.up = up;
    return result;
}

Camera pan(const Camera& camera, const Vec2& delta, const ViewRect& view) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    const double size = pixel_size(camera, view);
    const DVec3 motion =
        size * (-static_cast<double>(delta.x) * frame.right + static_cast<double>(delta.y) * frame.up);
    Camera result = camera;
    result.eye = Vec3(DVec3(camera.eye) + motion);
    result.target = Vec3(DVec3(camera.target) + motion);
    return result;
}

Camera zoom_to(const Camera& camera, const Vec2& pointer, float factor, const ViewRect& view) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    const double size = pixel_size(camera, view);
    const double x = static_cast<double>(pointer.x - view.x - 0.5f * view.width);
    const double y = static_cast<double>(pointer.y - view.y - 0.5f * view.height);
    const DVec3 fixed = DVec3(camera.target) + size * (x * frame.right - y * frame.up);
    const double f = static_cast<double>(factor);
    Camera result = camera;
    result.eye = Vec3(fixed + f * (DVec3(camera.eye) - fixed));
    result.target = Vec3(fixed + f * (DVec3(camera.target) - fixed));
    return result;
}

Camera fly(const Camera& camera, const Vec3& up, const Vec3& motion) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    const DVec3 m(motion);
    const DVec3 moved = m.x * frame.right + m.y * DVec3(up) + m.z * frame.forward;
    Camera result = camera;
    result.eye = Vec3(DVec3(camera.eye) + moved);
    result.target = Vec3(DVec3(camera.target) + moved);
    return result;
}

Camera focus_on(const Camera& camera, const Vec3& point, const Box& scene) {
    const double distance = glm::distance(DVec3(camera.eye), DVec3(point)) / 3.0;
    const double closest = 1e-3 * static_cast<double>(scene_size(scene));
    return placed(camera, DVec3(point), backward(camera), std::max(distance, closest), camera.up);
}

Camera axis_view(const Camera& camera, const Box& scene, int axis, bool negative, const Vec3& up) {
    DVec3 back(0.0);
    back[axis] = negative ? -1.0 : 1.0;
    Vec3 picture_up = up;
    if (std::abs(glm::dot(back, DVec3(up))) > 0.5) {
        picture_up = Vec3(0.0f);
        picture_up[axis == 2 ? 1 : 2] = axis == 1 && !negative ? -1.0f : 1.0f;
    }
    return placed(camera, middle(scene), back, whole_distance(camera, scene), picture_up);
}

Camera whole_view(const Camera& camera, const Box& scene, const Vec3& up) {
    return placed(camera, middle(scene), backward(camera), whole_distance(camera, scene), up);
}

Ray pointer_ray(const Camera& camera, const Vec2& pointer, const ViewRect& view) {
    const double width = static_cast<double>(view.width), height = static_cast<double>(view.height);
    return camera_ray(camera_frame(camera, width / height), static_cast<double>(pointer.x - view.x),
                      static_cast<double>(pointer.y - view.y), static_cast<int>(view.width),
                      static_cast<int>(view.height));
}

}  // namespace boxwood
