#include "core/volume_bvh/bounding_volumes.h"

#include "core/base/parallel.h"
#include "core/volume_bvh/node_content.h"
#include "core/volume_bvh/principal_axes.h"

namespace boxwood {

namespace {

/// The input's topology with a volume for each node: fit(box, pieces) contains all the pieces.
template <class Volume, class Fit>
VolumeBvh<Volume> with_volumes(const Mesh& mesh, const Bvh2& input, Task& task, const Fit& fit) {
    VolumeBvh<Volume> result;
    const NodeContent content(mesh, input, task);
    result.prims = input.prims;
    result.nodes.resize(input.nodes.size());
    task.total = input.nodes.size();
    parallel_for(input.nodes.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            const Bvh2::Node& node = input.nodes[i];
            const std::span<const Piece> pieces = content.of(static_cast<uint32_t>(i));
            result.nodes[i] = {fit(Box{node.lower, node.upper}, pieces), node.first, node.count};
        }
        task.done += end - begin;
    });
    if (!input.nodes.empty())
        for (const Piece& piece : content.of(0)) result.bounds.extend(piece.box);
    return result;
}

/// Calls visit(corner) for the three corners of each piece, moved into its box, until the task is stopped.
template <class Visit>
void for_each_corner(const Mesh& mesh, std::span<const Piece> pieces, const Task& task, const Visit& visit) {
    for (const Piece& piece : pieces) {
        if (task.stopped()) return;
        const Triangle t = mesh.triangle(piece.prim);
        for (const Vec3& corner : {t.a, t.b, t.c})
            visit(piece.is_whole ? corner : corner_inside(piece, corner));
    }
}

/// Zero for no corners.
DVec3 mean_corner(const Mesh& mesh, std::span<const Piece> pieces, const Task& task) {
    DVec3 sum(0.0);
    for_each_corner(mesh, pieces, task, [&](const Vec3& corner) { sum += DVec3(corner); });
    return pieces.empty() ? sum : sum / (3.0 * static_cast<double>(pieces.size()));
}

double farthest_corner(const Vec3& center, const Triangle& t) {
    const DVec3 c(center);
    return std::max({length_above<VolumeBounds>(DVec3(t.a) - c), length_above<VolumeBounds>(DVec3(t.b) - c),
                     length_above<VolumeBounds>(DVec3(t.c) - c)});
}
double farthest_corner(const Vec3& center, const Box& box) {
    const DVec3 c(center);
    return length_above<VolumeBounds>(
        glm::max(glm::abs(DVec3(box.lower) - c), glm::abs(DVec3(box.upper) - c)));
}

double radius_around(const Vec3& center, const Mesh& mesh, std::span<const Piece> pieces, const Task& task) {
    double radius = 0.0;
    for (const Piece& piece : pieces) {
        if (task.stopped()) break;
        double distance = farthest_corner(center, mesh.triangle(piece.prim));
        if (!piece.is_whole) distance = std::min(distance, farthest_corner(center, piece.box));
        radius = std::max(radius, distance);
    }
    return radius;
}

/// Extends a slab by a point's place on its axis, with the place's error.
void extend(double& lower, double& upper, const DVec3& axis, const Vec3& point) {
    const BoundedDot place = bounded_dot<VolumeBounds>(axis, DVec3(point));
    lower = std::min(lower, place.value - place.error);
    upper = std::max(upper, place.value + place.error);
}

/// The slabs of the pieces on given axes.
OrientedBox box_along(const std::array<Vec3, 3>& axes, const Mesh& mesh, std::span<const Piece> pieces,
                      const Task& task) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    OrientedBox box{axes, {kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
    for (const Piece& piece : pieces) {
        if (task.stopped()) break;
        const Triangle t = mesh.triangle(piece.prim);
        for (size_t k = 0; k < 3; ++k) {
            const DVec3 axis(axes[k]);
            double lower = kInfinity, upper = -kInfinity;
            for (const Vec3& corner : {t.a, t.b, t.c}) extend(lower, upper, axis, corner);
            if (!piece.is_whole) {
                // The corners of the piece's box that come first and last on the axis.
                const auto is_up = glm::greaterThan(axes[k], Vec3(0.0f));
                double box_lower = kInfinity, box_upper = -kInfinity;
                extend(box_lower, box_upper, axis, glm::mix(piece.box.upper, piece.box.lower, is_up));
                extend(box_lower, box_upper, axis, glm::mix(piece.box.lower, piece.box.upper, is_up));
                lower = std::max(lower, box_lower);
                upper = std::min(upper, box_upper);
            }
            box.lower[k] = std::min(box.lower[k], lower);
            box.upper[k] = std::max(box.upper[k], upper);
        }
    }
    return box;
}

OrientedBox axis_aligned(const Box& box) {
    OrientedBox result{{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {}, {}};
    for (size_t k = 0; k < 3; ++k) {
        result.lower[k] = static_cast<double>(box.lower[static_cast<int>(k)]);
        result.upper[k] = static_cast<double>(box.upper[static_cast<int>(k)]);
    }
    return result;
}

std::optional<std::array<Vec3, 3>> principal_axes_of(const Mesh& mesh, std::span<const Piece> pieces,
                                                     const Task& task) {
    const DVec3 mean = mean_corner(mesh, pieces, task);
    SymmetricMatrix covariance{};
    for_each_corner(mesh, pieces, task,
                    [&](const Vec3& corner) { covariance.add_square(DVec3(corner) - mean); });
    return principal_axes(covariance);
}

/// Nothing if there are no pieces.
std::optional<Triangle> largest_triangle(const Mesh& mesh, std::span<const Piece> pieces, const Task& task) {
    double largest = -1.0;
    std::optional<Triangle> result;
    for (const Piece& piece : pieces) {
        if (task.stopped()) break;
        const Triangle t = mesh.triangle(piece.prim);
        const DVec3 normal = glm::cross(DVec3(t.b) - DVec3(t.a), DVec3(t.c) - DVec3(t.a));
        const double area = glm::dot(normal, normal);
        if (area > largest) {
            largest = area;
            result = t;
        }
    }
    return result;
}

}  // namespace

VolumeBvh<Sphere> Spheres::apply(const Mesh& mesh, std::span<const PrimRef>, const Bvh2& input,
                                 Task& task) const {
    return with_volumes<Sphere>(mesh, input, task, [&](const Box& box, std::span<const Piece> pieces) {
        const Vec3 at(center == Mean ? mean_corner(mesh, pieces, task) : box.center());
        return Sphere{at, radius_around(at, mesh, pieces, task)};
    });
}

VolumeBvh<OrientedBox> OrientedBoxes::apply(const Mesh& mesh, std::span<const PrimRef>, const Bvh2& input,
                                            Task& task) const {
    return with_volumes<OrientedBox>(mesh, input, task, [&](const Box& box, std::span<const Piece> pieces) {
        OrientedBox best = axis_aligned(box);
        const auto attempt = [&](const std::optional<std::array<Vec3, 3>>& axes) {
            if (!axes) return;
            const OrientedBox candidate = box_along(*axes, mesh, pieces, task);
            if (candidate.half_area() < best.half_area()) best = candidate;
        };
        attempt(principal_axes_of(mesh, pieces, task));
        if (const std::optional<Triangle> largest = largest_triangle(mesh, pieces, task)) {
            attempt(triangle_axes(*largest, 0));
            attempt(triangle_axes(*largest, 1));
        }
        return best;
    });
}

}  // namespace boxwood
