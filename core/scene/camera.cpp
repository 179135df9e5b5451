#include "core/scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>

namespace boxwood {
namespace {

double tan_half_fov(float fov) {
    const double degrees = std::isfinite(fov) ? std::clamp(static_cast<double>(fov), 1.0, 170.0) : 45.0;
    return std::tan(degrees * (std::numbers::pi / 360.0));
}

/// Of length 1; `fallback` where v has no direction.
DVec3 unit_or(const DVec3& v, const DVec3& fallback) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0.0 ? v / length : fallback;
}

/// Perpendicular to forward, horizontal as `up` means it. Where up is along the view, -z is up, then y.
DVec3 right_of(const DVec3& forward, const DVec3& up) {
    const DVec3 candidates[] = {unit_or(up, DVec3(0.0)), DVec3(0.0, 0.0, -1.0), DVec3(0.0, 1.0, 0.0)};
    for (const DVec3& candidate : candidates) {
        const DVec3 right = glm::cross(forward, candidate);
        if (glm::length(right) > 1e-6) return glm::normalize(right);
    }
    return {1.0, 0.0, 0.0};
}

float to_finite_float(double x) {
    constexpr double kMax = static_cast<double>(std::numeric_limits<float>::max());
    return static_cast<float>(std::clamp(x, -kMax, kMax));
}

Vec3 to_finite_float(const DVec3& v) {
    return {to_finite_float(v.x), to_finite_float(v.y), to_finite_float(v.z)};
}

DVec3 column_offset(const CameraFrame& frame, double x, int width) {
    return (2.0 * x / width - 1.0) * frame.half_width * frame.right;
}

DVec3 row_offset(const CameraFrame& frame, double y, int height) {
    return (1.0 - 2.0 * y / height) * frame.half_height * frame.up;
}

/// Through a point of the image plane, `offset` from its middle.
Ray ray_at(const CameraFrame& frame, const DVec3& offset) {
    Ray ray;
    ray.origin = Vec3(frame.orthographic ? frame.eye + offset : frame.eye);
    ray.direction = Vec3(frame.orthographic ? frame.forward : frame.forward + offset);
    return ray;
}

}  // namespace

CameraFrame camera_frame(const Camera& camera, double aspect) {
    const DVec3 eye = is_finite(DVec3(camera.eye)) ? DVec3(camera.eye) : DVec3(0.0);
    const DVec3 to_target = DVec3(camera.target) - eye;
    CameraFrame frame{};
    frame.eye = eye;
    frame.forward = unit_or(to_target, DVec3(0.0, 0.0, -1.0));
    frame.right = right_of(frame.forward, DVec3(camera.up));
    frame.up = glm::cross(frame.right, frame.forward);
    frame.orthographic = camera.orthographic;
    frame.half_height = tan_half_fov(camera.fov);
    const double distance = glm::length(to_target);
    if (camera.orthographic && std::isfinite(distance) && distance > 0.0) frame.half_height *= distance;
    frame.half_width = frame.half_height * (std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0);
    return frame;
}

Ray camera_ray(const CameraFrame& frame, double x, double y, int width, int height) {
    return ray_at(frame, column_offset(frame, x, width) + row_offset(frame, y, height));
}

CameraRaster::CameraRaster(const CameraFrame& frame, int width, int height) : frame_(frame) {
    for (int x = 0; x < width; ++x) columns_.push_back(split(column_offset(frame, x + 0.5, width)));
    for (int y = 0; y < height; ++y) rows_.push_back(split(row_offset(frame, y + 0.5, height)));
}

void CameraRaster::rays_through(std::span<const uint32_t> pixels, std::span<Ray> rays) const {
    using Float2 = float __attribute__((vector_size(8)));
    static_assert(sizeof(Ray) == 32 && offsetof(Ray, t_min) == 12 && offsetof(Ray, direction) == 16);
    const auto width = static_cast<uint32_t>(columns_.size());
    // One half of a ray moves with the pixel: its direction with t_max, or its origin with t_min.
    const Ray middle = ray_at(frame_, DVec3(0.0));
    const size_t moving_at = frame_.orthographic ? 0 : offsetof(Ray, direction), same_at = 16 - moving_at;
    Offset from = split(frame_.orthographic ? frame_.eye : frame_.forward);
    from.z0[1] = double(frame_.orthographic ? middle.t_min : middle.t_max);
    std::array<char, 16> same;
    std::memcpy(same.data(), reinterpret_cast<const char*>(&middle) + same_at, same.size());
    uint32_t y = 0;
    // Each ray is written in place: the parts of a copy would be read again before they are in the cache.
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] - y * width >= width)
            y = pixels[i] / width;  // seldom: those of a row follow each other
        const Offset& column = columns_[pixels[i] - y * width];
        const Offset& row = rows_[y];
        const Float2 halves[2] = {__builtin_convertvector(from.xy + (column.xy + row.xy), Float2),
                                  __builtin_convertvector(from.z0 + (column.z0 + row.z0), Float2)};
        char* const ray = reinterpret_cast<char*>(&rays[i]);
        std::memcpy(ray + same_at, same.data(), same.size());
        std::memcpy(ray + moving_at, halves, sizeof halves);
    }
}

Camera fit_camera(const Box& box, float fov, const Vec3& up) {
    constexpr double kMargin = 0.95;  // of the picture's half height that the box may fill
    Camera camera;
    camera.fov = fov;
    camera.up = up;
    const bool z_up = std::abs(up.z) > std::abs(up.y);
    const DVec3 backward = glm::normalize(z_up ? DVec3(0.55, -0.7, 0.45) : DVec3(0.55, 0.45, 0.7));
    const DVec3 center = box.is_empty() ? DVec3(0.0) : box.center();
    const DVec3 half = 0.5 * box.extent();
    const DVec3 right = right_of(-backward, DVec3(up));
    const DVec3 upward = glm::cross(right, -backward);

    // The distance at which the corner that sticks out most lies on the margin of a square picture.
    const double slope = kMargin * tan_half_fov(fov);
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const DVec3 p((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                      (corner & 4) != 0 ? half.z : -half.z);
        const double side = std::max(std::abs(glm::dot(p, right)), std::abs(glm::dot(p, upward)));
        distance = std::max(distance, side / slope + glm::dot(p, backward));
    }
    if (!(distance > 0.0)) distance = 1.0;
    // The eye must differ from the target also where float is coarse.
    const double largest = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    distance = std::max(distance, 1e-5 * largest);
    camera.target = to_finite_float(center);
    camera.eye = to_finite_float(center + distance * backward);
    return camera;
}

}  // namespace boxwood
