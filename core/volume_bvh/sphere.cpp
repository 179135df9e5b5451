#include "core/volume_bvh/sphere.h"

#include <numbers>

#include "core/volume_bvh/float_bounds.h"

namespace boxwood {

namespace {

/// Segments of a great circle: as many as can be told apart where the root fills the picture, few where a
/// large scene has very many spheres.
int segment_count(double radius, double root_radius) {
    if (radius * 8.0 >= root_radius) return 48;
    return radius * 64.0 >= root_radius ? 24 : 12;
}

}  // namespace

Box Sphere::bounds() const { return outward_box(DVec3(center) - radius, DVec3(center) + radius); }

double Sphere::half_area() const { return 2.0 * std::numbers::pi * radius * radius; }

void Sphere::add_outline(uint32_t node, const Sphere& root, std::vector<OutlineSegment>& segments) const {
    const int count = segment_count(radius, root.radius);
    for (int axis = 0; axis < 3; ++axis) {
        const auto point = [&](int i) {
            const double angle = 2.0 * std::numbers::pi * (i % count) / count;
            DVec3 p(center);
            p[(axis + 1) % 3] += radius * std::cos(angle);
            p[(axis + 2) % 3] += radius * std::sin(angle);
            return finite_point(p);
        };
        for (int i = 0; i < count; ++i) segments.push_back({node, point(i), point(i + 1)});
    }
}

}  // namespace boxwood
