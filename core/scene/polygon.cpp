#include "core/scene/polygon.h"

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

using DVec2 = glm::dvec2;

/// Twice the signed area of (a, b, c): positive for a left turn. The sign of nearly collinear points may be
/// wrong, which costs beauty, not safety.
double turn(const DVec2& a, const DVec2& b, const DVec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners in the plane of the two axes where the polygon's area is largest, counter-clockwise.
std::vector<DVec2> project(std::span<const Vec3> positions, std::span<const uint32_t> corners) {
    DVec3 normal(0.0);  // Newell
    const DVec3 origin(positions[corners[0]]);
    for (size_t i = 0; i < corners.size(); ++i) {
        const DVec3 a = DVec3(positions[corners[i]]) - origin;
        const DVec3 b = DVec3(positions[corners[(i + 1) % corners.size()]]) - origin;
        normal += glm::cross(a, b);
    }
    const DVec3 size = glm::abs(normal);
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<DVec2> points;
    points.reserve(corners.size());
    for (const uint32_t corner : corners) {
        const DVec3 p(positions[corner]);
        points.push_back(normal[axis] >= 0.0 ? DVec2(p[u], p[v]) : DVec2(p[v], p[u]));
    }
    return points;
}

/// Dents that rounding explains do not count, a circle's corners have them: two roundings of a float
/// coordinate, or 2^-20 of the polygon's size, as in text with six decimals.
bool is_convex(const std::vector<DVec2>& points) {
    double largest = 0.0, size = 0.0;
    for (const DVec2& p : points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
        size = std::max({size, std::abs(p.x - points[0].x), std::abs(p.y - points[0].y)});
    }
    const double depth = std::max(0x1p-23 * largest, 0x1p-20 * size);
    const size_t n = points.size();
    for (size_t i = 0; i < n; ++i) {
        const DVec2 a = points[i], b = points[(i + 1) % n], c = points[(i + 2) % n];
        if (turn(a, b, c) < -depth * glm::length(c - a)) return false;
    }
    return true;
}

/// The first corner whose fan has no triangle without area, as straight corners beside it make;
/// corner 0 if none is found among the first candidates.
size_t fan_center(const std::vector<DVec2>& points) {
    constexpr int kMaxCandidates = 64;  // keeps the time linear in the corners
    const size_t n = points.size();
    int candidates = 0;
    for (size_t center = 0; center < n && candidates < kMaxCandidates; ++center) {
        const auto is_good = [&points, n, center](size_t i) {
            return turn(points[center], points[(center + i) % n], points[(center + i + 1) % n]) != 0.0;
        };
        if (!is_good(1) || !is_good(n - 2)) continue;
        ++candidates;
        size_t i = 2;
        while (i + 2 < n && is_good(i)) ++i;
        if (i + 2 >= n) return center;
    }
    return 0;
}

/// Cuts ears off a ring of corners until a triangle is left.
class EarClipper {
public:
    EarClipper(const std::vector<DVec2>& points, std::span<const uint32_t> corners)
        : points_(points), corners_(corners), next_(points.size()), previous_(points.size()) {
        const uint32_t n = static_cast<uint32_t>(points.size());
        for (uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (uint32_t i = 0; i < n; ++i) {
            if (corner_turn(i) <= 0.0) dents_.push_back(i);
        }
    }

    void cut(Array<UVec3>& triangles) {
        size_t left = points_.size();
        uint32_t corner = 0;
        size_t refused = 0;  // corners in a row that are no ears
        while (left > 3 && refused < left && tests_left_ > 0) {
            if (!is_ear(corner)) {
                corner = next_[corner];
                ++refused;
                continue;
            }
            triangles.push_back(triangle(corner));
            corner = remove(corner);
            refused = 0;
            --left;
        }
        for (; left > 2; --left) {  // the last triangle, or a fan of what has no ear
            triangles.push_back(triangle(corner));
            const uint32_t fan_center = previous_[corner];
            remove(corner);
            corner = next_[fan_center];
        }
    }

private:
    static constexpr size_t kTestsPerCorner = 1024;  ///< keeps the time linear in the corners

    double corner_turn(uint32_t i) const {
        return turn(points_[previous_[i]], points_[i], points_[next_[i]]);
    }
    UVec3 triangle(uint32_t i) const { return {corners_[previous_[i]], corners_[i], corners_[next_[i]]}; }
    /// Takes the corner out of the ring; returns the one to look at next.
    uint32_t remove(uint32_t i) {
        next_[previous_[i]] = next_[i];
        previous_[next_[i]] = previous_[i];
        const uint32_t after = next_[i];
        next_[i] = i;  // marks it as gone
        return next_[after];
    }
    bool is_ear(uint32_t i) {
        if (!(corner_turn(i) > 0.0)) return false;
        const DVec2 a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
        for (size_t k = 0; k < dents_.size();) {
            const uint32_t dent = dents_[k];
            if (next_[dent] == dent || corner_turn(dent) > 0.0) {  // gone, or no dent any more
                dents_[k] = dents_.back();
                dents_.pop_back();
                continue;
            }
            ++k;
            if (tests_left_ > 0) --tests_left_;
            const DVec2 p = points_[dent];
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    const std::vector<DVec2>& points_;
    std::span<const uint32_t> corners_;
    std::vector<uint32_t> next_, previous_;
    std::vector<uint32_t> dents_;  ///< corners that turn right or not at all, and some that are gone
    size_t tests_left_ = kTestsPerCorner * points_.size();
};

}  // namespace

void cut_polygon(std::span<const Vec3> positions, std::span<const uint32_t> corners,
                 Array<UVec3>& triangles) {
    if (corners.size() < 3) return;
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const std::vector<DVec2> points = project(positions, corners);
    if (!is_convex(points)) {
        EarClipper(points, corners).cut(triangles);
        return;
    }
    const size_t n = corners.size(), center = fan_center(points);
    for (size_t i = 1; i + 1 < n; ++i)
        triangles.push_back({corners[center], corners[(center + i) % n], corners[(center + i + 1) % n]});
}

}  // namespace boxwood
