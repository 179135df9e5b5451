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

/// On each axis of the scene the largest |coordinate| of the pieces' triangles.
DVec3 largest_coordinates(const Mesh& mesh, std::span<const Piece> pieces, const Task& task) {
    Vec3 largest(0.0f);
    for (const Piece& piece : pieces) {
        if (task.stopped()) break;
        const Triangle t = mesh.triangle(piece.prim);
        largest = glm::max(glm::max(largest, glm::abs(t.a)), glm::max(glm::abs(t.b), glm::abs(t.c)));
    }
    return DVec3(largest);
}

/// Places on an axis, as scalar products.
struct Slab {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    void extend(double place) {
        lower = std::min(lower, place);
        upper = std::max(upper, place);
    }
};

/// Of one piece on an axis; not wider than either its triangle's or its box's.
Slab slab_of(const Piece& piece, const Triangle& t, const DVec3& axis) {
    Slab slab;
    for (const Vec3& corner : {t.a, t.b, t.c}) slab.extend(glm::dot(axis, DVec3(corner)));
    if (piece.is_whole) return slab;
    // The corners of the box that come first and last on the axis.
    const auto is_up = glm::greaterThan(axis, DVec3(0.0));
    const DVec3 lower(piece.box.lower), upper(piece.box.upper);
    slab.lower = std::max(slab.lower, glm::dot(axis, glm::mix(upper, lower, is_up)));
    slab.upper = std::min(slab.upper, glm::dot(axis, glm::mix(lower, upper, is_up)));
    return slab;
}

/// The slabs of the pieces on given axes, widened by what scalar products with such coordinates may be off.
OrientedBox box_along(const std::array<Vec3, 3>& axes, const DVec3& largest, const Mesh& mesh,
                      std::span<const Piece> pieces, const Task& task) {
    const DVec3 exact_axes[3] = {DVec3(axes[0]), DVec3(axes[1]), DVec3(axes[2])};
    Slab slabs[3];
    for (const Piece& piece : pieces) {
        if (task.stopped()) break;
        const Triangle t = mesh.triangle(piece.prim);
        for (int k = 0; k < 3; ++k) {
            const Slab slab = slab_of(piece, t, exact_axes[k]);
            slabs[k].extend(slab.lower);
            slabs[k].extend(slab.upper);
        }
    }
    OrientedBox box{axes, {}, {}};
    for (size_t k = 0; k < 3; ++k) {
        // Moving a face by the error of two roundings is a third one.
        const double error = 1.5 * bounded_dot<VolumeBounds>(exact_axes[k], largest).error;
        box.lower[k] = slabs[k].lower - error;
        box.upper[k] = slabs[k].upper + error;
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
        const DVec3 coordinates = largest_coordinates(mesh, pieces, task);
        const auto attempt = [&](const std::optional<std::array<Vec3, 3>>& axes) {
            if (!axes) return;
            const OrientedBox candidate = box_along(*axes, coordinates, mesh, pieces, task);
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
