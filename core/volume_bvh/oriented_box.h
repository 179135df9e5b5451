#pragma once

#include <array>
#include <vector>

#include "core/structure/node_list.h"
#include "core/volume_bvh/volume_bvh.h"

namespace boxwood {

/// A scalar product of two vectors of floats with a bound on its error: the products are exact, each of the
/// two sums is off by u times itself, and neither exceeds the sum of the absolute products.
struct BoundedDot {
    double value, error;
};
template <class Bounds>
BoundedDot bounded_dot(const DVec3& a, const DVec3& b) {
    return {glm::dot(a, b), 2.0 * Bounds::kUnit * glm::dot(glm::abs(a), glm::abs(b))};
}

/// The points p with lower[k] <= axis[k].p <= upper[k] for k = 0, 1, 2, exactly; nothing depends on the axes
/// being unit vectors at right angles, which they are as well as floats can.
struct OrientedBox {
    static constexpr const char* kFamily = "oriented box BVH";

    std::array<Vec3, 3> axis;
    std::array<double, 3> lower, upper;

    /// The corner at the lower (0) or upper (1) end of each axis, but for roundings.
    DVec3 corner(int x, int y, int z) const;
    /// The smallest box of floats around it, but for roundings; as far as floats reach.
    Box bounds() const;
    double half_area() const;
    /// Its twelve edges.
    void add_outline(uint32_t node, const OrientedBox& root, std::vector<OutlineSegment>& segments) const;

    /// A ray prepared for tests against such boxes, which count as larger by a margin along each axis of the
    /// scene.
    template <class Bounds>
    class Test;
};

/// Where a ray's line is inside: a slab test on each of the box's axes a, with o' = a.o and d' = a.d instead
/// of the coordinates. A point moved by the margin m along each axis moves by m times the sum of |a_x|, |a_y|
/// and |a_z| along a.
///
/// d' and o' carry the errors of bounded_dot; the distance to a plane, lower - o', one rounding more, which
/// its error takes in. Of the quotients of distances and |d'| within their errors the extreme ones are
/// taken, which carry four roundings (distance, |d'|, quotient, the last product). Where the sign of d' is
/// not certain, the line may run inside the slab for ever, unless d' is exactly 0: then it does or does not.
template <class Bounds>
class OrientedBox::Test {
public:
    Test(const Ray& ray, double margin)
        : origin_(ray.origin), direction_(ray.direction), margin_(margin * (1.0 + 8.0 * Bounds::kUnit)) {}

    /// Whether the ray's line may meet the box; then all parameters inside are in [near, far].
    bool meets(const OrientedBox& box, double& near, double& far) const {
        near = -std::numeric_limits<double>::infinity();
        far = std::numeric_limits<double>::infinity();
        for (size_t k = 0; k < 3; ++k) {
            const DVec3 a(box.axis[k]);
            const BoundedDot o = bounded_dot<Bounds>(a, origin_), d = bounded_dot<Bounds>(a, direction_);
            const double grown = o.error + margin_ * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
            // Distances along the axis to the planes: to the one that is met first, and to the other.
            const double to_lower = box.lower[k] - o.value, to_upper = box.upper[k] - o.value;
            if (std::abs(d.value) <= d.error) {
                const bool is_parallel = d.error == 0.0;
                if (is_parallel && (outward(to_lower, grown) > 0.0 || outward(-to_upper, grown) > 0.0))
                    return false;
                continue;
            }
            const double to_near = d.value > 0.0 ? to_lower : -to_upper;
            const double to_far = d.value > 0.0 ? to_upper : -to_lower;
            near = std::max(near, first_parameter(outward(to_near, grown), d));
            far = std::min(far, -first_parameter(outward(-to_far, grown), d));
        }
        return near <= far;
    }

private:
    /// At most the exact distance less `grown`, but for one rounding of the result.
    static double outward(double distance, double grown) {
        return distance - (grown + Bounds::kUnit * std::abs(distance));
    }
    /// At most the parameter at which a distance is covered.
    static double first_parameter(double distance, const BoundedDot& d) {
        const double speed = std::abs(d.value);
        return distance >= 0.0 ? distance / (speed + d.error) * (1.0 - Bounds::kQuotientPad)
                               : distance / (speed - d.error) * (1.0 + Bounds::kQuotientPad);
    }

    DVec3 origin_, direction_;
    double margin_;
};

}  // namespace boxwood
