#include "core/volume_bvh/oriented_box.h"

#include "core/volume_bvh/float_bounds.h"

namespace boxwood {

DVec3 OrientedBox::corner(int x, int y, int z) const {
    // axis[k].p = s[k] has the solution p = (s_0 a_1 x a_2 + s_1 a_2 x a_0 + s_2 a_0 x a_1) / (a_0.(a_1 x
    // a_2)).
    const DVec3 a(axis[0]), b(axis[1]), c(axis[2]);
    const DVec3 s((x != 0 ? upper : lower)[0], (y != 0 ? upper : lower)[1], (z != 0 ? upper : lower)[2]);
    const DVec3 bc = glm::cross(b, c);
    return (s.x * bc + s.y * glm::cross(c, a) + s.z * glm::cross(a, b)) / glm::dot(a, bc);
}

Box OrientedBox::bounds() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    DVec3 least(kInfinity), most(-kInfinity);
    double largest = 0.0;
    for (int i = 0; i < 8; ++i) {
        const DVec3 p = corner(i & 1, (i >> 1) & 1, i >> 2);
        least = glm::min(least, p);
        most = glm::max(most, p);
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    const double roundings = 0x1p-48 * largest;  // a sum of terms of other coordinates
    return outward_box(least - roundings, most + roundings);
}

double OrientedBox::half_area() const {
    const double x = upper[0] - lower[0], y = upper[1] - lower[1], z = upper[2] - lower[2];
    return x * y + y * z + z * x;
}

void OrientedBox::add_outline(uint32_t node, const OrientedBox&,
                              std::vector<OutlineSegment>& segments) const {
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) {
            const auto add = [&](const DVec3& from, const DVec3& to) {
                segments.push_back({node, finite_point(from), finite_point(to)});
            };
            add(corner(0, i, j), corner(1, i, j));
            add(corner(i, 0, j), corner(i, 1, j));
            add(corner(i, j, 0), corner(i, j, 1));
        }
}

}  // namespace boxwood
