#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.h"
#include "core/base/ray.h"
#include "core/base/vec.h"

namespace boxwood {

/// Pinhole or orthographic camera. Row 0 is the top row; rays go through pixel centres.
struct Camera {
    Vec3 eye{0.0f, 0.0f, 1.0f};
    Vec3 target{0.0f};
    Vec3 up{0.0f, 1.0f, 0.0f};
    float fov =
        45.0f;  ///< vertical field of view in degrees, 1 to 170; orthographic: sets the height at the target
    bool orthographic = false;

    bool operator==(const Camera&) const = default;
};

/// Orthonormal frame of a camera, in double; the image plane at distance 1 spans
/// [-half_width, half_width] x [-half_height, half_height] (orthographic: world units).
struct CameraFrame {
    DVec3 eye, forward, right, up;
    double half_width, half_height;
    bool orthographic;
};

/// A degenerate camera (eye at target, up along the view) gets a valid frame all the same. aspect = width /
/// height.
CameraFrame camera_frame(const Camera& camera, double aspect);

/// The ray through image position (x, y) in pixels, (0, 0) the top left corner, so pixel centres are at +
/// 0.5. direction = forward + (2x/w - 1) tan(fov/2) aspect right + (1 - 2y/h) tan(fov/2) up, in double,
/// rounded once to float, not normalised.
Ray camera_ray(const CameraFrame& frame, double x, double y, int width, int height);

/// camera_ray for the pixel centres of a picture, with what depends on the column or the row alone computed
/// once: the same bits.
class CameraRaster {
public:
    CameraRaster(const CameraFrame& frame, int width, int height);

    /// For pixels y * width + x. rays.size() == pixels.size().
    void rays_through(std::span<const uint32_t> pixels, std::span<Ray> rays) const;

private:
    using Double2 = double __attribute__((vector_size(16)));
    /// A point, and 0, in two registers.
    struct Offset {
        Double2 xy, z0;
    };
    static Offset split(const DVec3& v) { return {Double2{v.x, v.y}, Double2{v.z, 0.0}}; }

    CameraFrame frame_;
    std::vector<Offset> columns_, rows_;  ///< parts of the offset from the picture's middle
};

/// A camera that sees the whole box from direction (0.55, 0.45, 0.7), y up (or z up), with the given field of
/// view.
Camera fit_camera(const Box& box, float fov = 45.0f, const Vec3& up = Vec3(0.0f, 1.0f, 0.0f));

}  // namespace boxwood
