#include "core/bsp/convex_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace boxwood {

namespace {

/// Corners are off by a few roundings of their coordinates for each cut above them.
constexpr double kTolerance = 0x1p-42;

/// Twice the area of a planar polygon, as a vector.
DVec3 area_vector(const ConvexCell::Polygon& polygon) {
    DVec3 sum(0.0);
    for (size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return sum;
}

bool is_before(const DVec3& a, const DVec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Where an edge meets the plane; its ends are put in order, so that both faces at it get the same point.
DVec3 crossing(const PlaneValue& plane, const DVec3& p, const DVec3& q) {
    const bool in_order = is_before(p, q);
    const DVec3 &from = in_order ? p : q, &to = in_order ? q : p;
    const double h_from = plane.at(from), h_to = plane.at(to);
    return from + (h_from / (h_from - h_to)) * (to - from);
}

/// Corners of a convex polygon in a plane, put in order round its normal; equal ones once.
ConvexCell::Polygon in_order(ConvexCell::Polygon corners, const DVec3& normal) {
    std::sort(corners.begin(), corners.end(), is_before);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() < 3) return {};
    DVec3 center(0.0);
    for (const DVec3& corner : corners) center += corner / static_cast<double>(corners.size());
    const DVec3 size = glm::abs(normal);
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double sign = normal[axis] < 0.0 ? -1.0 : 1.0;
    const auto angle = [&](const DVec3& p) {
        return std::atan2(sign * (p[v] - center[v]), p[u] - center[u]);
    };
    std::sort(corners.begin(), corners.end(),
              [&](const DVec3& a, const DVec3& b) { return angle(a) < angle(b); });
    return corners;
}

float rounded_down(double x) {
    const float f = static_cast<float>(x);
    return double(f) > x ? std::nextafter(f, -std::numeric_limits<float>::max()) : f;
}

}  // namespace

ConvexCell::ConvexCell(const Box& box) {
    const DVec3 ends[2] = {DVec3(box.lower), DVec3(box.upper)};
    const DVec3 size = glm::max(glm::abs(ends[0]), glm::abs(ends[1]));
    reach_ = std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const int upper : {0, 1}) {
            Polygon face;
            for (const auto& [at_u, at_v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                DVec3 corner;
                corner[axis] = ends[upper][axis];
                corner[u] = ends[at_u][u];
                corner[v] = ends[at_v][v];
                face.push_back(corner);
            }
            if (upper == 0) std::reverse(face.begin(), face.end());  // seen from outside, counterclockwise
            add_face(std::move(face));
        }
    }
}

double ConvexCell::tolerance(const PlaneValue& plane) const {
    return plane.error_within(reach_) + kTolerance * reach_ * plane.slope();
}

void ConvexCell::add_face(Polygon face) {
    areas_.push_back(area_vector(face));
    faces_.push_back(std::move(face));
}

ConvexCell::Polygon ConvexCell::part_of(const Polygon& face, const PlaneValue& plane, int side,
                                        Polygon& in_plane) const {
    const double limit = tolerance(plane);
    Polygon part;
    bool has_inside = false;
    for (size_t i = 0; i < face.size(); ++i) {
        const DVec3 &p = face[i], &q = face[(i + 1) % face.size()];
        const double h_p = double(side) * plane.at(p), h_q = double(side) * plane.at(q);
        if (h_p >= -limit) part.push_back(p);
        if (std::abs(h_p) <= limit) in_plane.push_back(p);
        has_inside = has_inside || h_p > limit;
        if ((h_p > limit && h_q < -limit) || (h_p < -limit && h_q > limit)) {
            part.push_back(crossing(plane, p, q));
            in_plane.push_back(part.back());
        }
    }
    if (!has_inside) part.clear();
    return part;
}

ConvexCell ConvexCell::part_of(const PlaneValue& plane, int side) const {
    ConvexCell result;
    result.reach_ = reach_;
    Polygon cap;
    for (const Polygon& face : faces_) {
        Polygon part = part_of(face, plane, side, cap);
        if (part.size() >= 3) result.add_face(std::move(part));
    }
    cap = in_order(std::move(cap), -double(side) * plane.normal());
    if (!cap.empty()) result.add_face(std::move(cap));
    return result;
}

std::pair<ConvexCell, ConvexCell> ConvexCell::cut(const PlaneValue& plane) const {
    return {part_of(plane, -1), part_of(plane, 1)};
}

ConvexCell::Areas ConvexCell::cut_areas(const PlaneValue& plane) const {
    // The area vectors of a closed surface sum to zero: what is missing of one part is the cut's area.
    const double limit = tolerance(plane);
    double left = 0.0, right = 0.0;
    DVec3 missing(0.0);
    Polygon ignored;
    for (size_t i = 0; i < faces_.size(); ++i) {
        bool is_left = false, is_right = false;
        for (const DVec3& corner : faces_[i]) {
            const double h = plane.at(corner);
            is_left = is_left || h < -limit;
            is_right = is_right || h > limit;
        }
        DVec3 left_area(0.0);
        if (is_left) left_area = is_right ? area_vector(part_of(faces_[i], plane, -1, ignored)) : areas_[i];
        left += glm::length(left_area);
        missing += left_area;
        if (is_right) right += glm::length(areas_[i] - left_area);
    }
    if (!(left > 0.0 && right > 0.0)) return {};
    const double cut = glm::length(missing);
    return {0.25 * (left + cut), 0.25 * (right + cut)};
}

double ConvexCell::half_area() const {
    double sum = 0.0;
    for (const DVec3& area : areas_) sum += glm::length(area);
    return 0.25 * sum;
}

double ConvexCell::volume() const {
    if (faces_.empty()) return 0.0;
    const DVec3 apex = faces_[0][0];
    double sum = 0.0;
    for (size_t i = 0; i < faces_.size(); ++i) sum += glm::dot(areas_[i], faces_[i][0] - apex);
    return sum / 6.0;
}

Box ConvexCell::bounds() const {
    Box box;
    for (const Polygon& face : faces_) {
        for (const DVec3& corner : face) {
            for (int axis = 0; axis < 3; ++axis) {
                const double slack = kTolerance * reach_;
                box.lower[axis] = std::min(box.lower[axis], rounded_down(corner[axis] - slack));
                box.upper[axis] = std::max(box.upper[axis], -rounded_down(-corner[axis] - slack));
            }
        }
    }
    return box;
}

}  // namespace boxwood
