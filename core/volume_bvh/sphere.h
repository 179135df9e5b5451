#pragma once

#include <vector>

#include "core/structure/node_list.h"
#include "core/volume_bvh/volume_bvh.h"

namespace boxwood {

/// Closed ball. The radius is a double, so that it holds for every scene of floats.
struct Sphere {
    static constexpr const char* kFamily = "sphere BVH";

    Vec3 center;
    double radius;

    /// The smallest box of floats around it, but for roundings; as far as floats reach.
    Box bounds() const;
    double half_area() const;
    /// Three great circles; of more segments the larger it is in the root's sphere.
    void add_outline(uint32_t node, const Sphere& root, std::vector<OutlineSegment>& segments) const;

    /// A ray prepared for tests against spheres, which count as larger by a margin along each axis.
    template <class Bounds>
    class Test;
};

/// At least the length of a vector whose components are differences of floats, rounded once. With that one
/// the squares carry three roundings, the sum two more, the root, which halves these, one: 3.5u; the last
/// product rounds once more, and the next double above 1 + 4u is 1 + 6u.
template <class Bounds>
double length_above(const DVec3& difference) {
    return glm::length(difference) * Bounds::kDistancePad;
}

/// Where a ray's line is inside a ball of radius R around c. With L = c - o, the line is nearest to c at t* =
/// L.d / d.d, at a distance h, and inside for |t - t*| |d| <= sqrt(R^2 - h^2).
///
/// In double, u = 2^-53: L is off by u|L|. L.d carries three more roundings, d.d (a sum of exact squares)
/// two, the quotient one, and |t*| |d| <= |L|: t is off by 7u|L| / |d|. The vector m = L - t d is off by
/// u|L| of L, u|t d| of the product, and u|m|: |m| <= (sqrt(h^2 + 49u^2|L|^2) + e)(1 + u), e = 2u|L|; its
/// square carries three roundings. Where h <= R, (sqrt(h^2 + 49u^2|L|^2) + e)^2 <= h^2 - R^2 + (R + e)^2 +
/// 49u^2|L|^2 + 2e 7u|L|: so ((R + e)^2 + 81u^2|L|^2)(1 + 16u) - m.m, whose first term carries six roundings,
/// is not below R^2 - h^2. Half the chord then carries three roundings of root, difference and length. The
/// ends of the interval: 7u|L| of t, and a sum and a product of at most |L| / |d| and half the chord each.
/// No square overflows or underflows: floats are below 2^128 and multiples of 2^-149.
template <class Bounds>
class Sphere::Test {
public:
    Test(const Ray& ray, double margin)
        : origin_(ray.origin),
          direction_(ray.direction),
          length_squared_(glm::dot(direction_, direction_)),
          inverse_length_(1.0 / std::sqrt(length_squared_)),
          margin_(1.7321 * margin) {}  // a point within `margin` on each axis is within sqrt(3) of it

    /// Whether the ray's line may meet the sphere; then all parameters inside are in [near, far].
    bool meets(const Sphere& sphere, double& near, double& far) const {
        const DVec3 to_center = DVec3(sphere.center) - origin_;
        const double error = Bounds::kUnit * glm::length(to_center);
        const double t = glm::dot(to_center, direction_) / length_squared_;
        const DVec3 m = to_center - t * direction_;
        const double grown = sphere.radius + margin_ + 2.0 * error;
        constexpr double kPad = 1.0 + 16.0 * Bounds::kUnit;
        const double rest = (grown * grown + 81.0 * error * error) * kPad - glm::dot(m, m);
        if (!(rest >= 0.0)) return false;
        const double reach = (std::sqrt(rest) * kPad + 10.0 * error) * inverse_length_;
        near = t - reach;
        far = t + reach;
        return true;
    }

private:
    DVec3 origin_, direction_;
    double length_squared_, inverse_length_, margin_;
};

}  // namespace boxwood
