#pragma once

#include <functional>
#include <numbers>
#include <span>
#include <string>

#include "core/scene/mesh.h"

namespace boxwood {

inline constexpr double kPi = std::numbers::pi;

/// Place and directions of a part: local (x, y, z) lies at origin + x * x_axis + y * y_axis + z * z_axis.
struct Placement {
    DVec3 origin{0.0};
    DVec3 x_axis{1.0, 0.0, 0.0};
    DVec3 y_axis{0.0, 1.0, 0.0};
    DVec3 z_axis{0.0, 0.0, 1.0};

    DVec3 operator()(const DVec3& p) const { return origin + p.x * x_axis + p.y * y_axis + p.z * z_axis; }
    /// The same directions, with the origin at local p.
    Placement moved(const DVec3& p) const { return {(*this)(p), x_axis, y_axis, z_axis}; }
};

/// A point of a profile that is turned about an axis.
struct ProfilePoint {
    double radius, height;
};

/// Builds the mesh of a generated scene part by part. Coordinates are local to the placement, in double,
/// rounded once. Each call shares the vertices of its own triangles; triangles without area are left out.
class MeshBuilder {
public:
    explicit MeshBuilder(Mesh& mesh) : mesh_(mesh) {}

    /// What follows belongs to the object of that name, which is added if there is none.
    void use_object(const std::string& name, const Vec3& base_color);
    void place(const Placement& placement) { placement_ = placement; }
    const Placement& placement() const { return placement_; }

    void add_triangle(const DVec3& a, const DVec3& b, const DVec3& c);
    /// a, b, c, d in turn about the quad.
    void add_quad(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d);
    void add_box(const DVec3& lower, const DVec3& upper);
    /// A beam of rectangular section from `from` to `to`; `up` is roughly the direction of its height.
    void add_beam(const DVec3& from, const DVec3& to, double width, double height,
                  const DVec3& up = DVec3(0.0, 1.0, 0.0));
    /// columns * rows quads over the unit square: point(u, v) with u, v in [0, 1].
    void add_surface(int columns, int rows, const std::function<DVec3(double u, double v)>& point);
    /// A surface of revolution about the axis through `base`; a radius of 0 closes it.
    void add_turned(const DVec3& base, const DVec3& axis, std::span<const ProfilePoint> profile,
                    int segments);
    /// Side of a cone from radius r0 to r1; caps close it.
    void add_tube(const DVec3& from, const DVec3& to, double r0, double r1, int segments, bool caps = false);
    void add_sphere(const DVec3& center, double radius, int segments, int rings);
    /// Extrudes the polygon (x, y), in turn and star-shaped about its first point, from z0 to z1, with both
    /// ends.
    void add_prism(std::span<const glm::dvec2> polygon, double z0, double z1);
    /// Sweeps the open line of the profile (y, z) along x from x0 to x1: mouldings.
    void add_moulding(std::span<const glm::dvec2> profile, double x0, double x1);

private:
    uint32_t add_vertex(const DVec3& local);
    void add_indexed(uint32_t a, uint32_t b, uint32_t c);

    Mesh& mesh_;
    Placement placement_;
    uint32_t object_ = 0;
};

}  // namespace boxwood
