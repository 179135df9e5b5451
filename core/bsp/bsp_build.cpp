#include "core/bsp/bsp_build.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/bsp/bsp_output.h"
#include "core/bsp/bsp_piece.h"
#include "core/bsp/convex_cell.h"
#include "core/structure/ref_budget.h"

namespace boxwood {

namespace {

constexpr size_t kSerialCount = 512;  ///< smaller nodes are built by one thread
constexpr size_t kWeighed = 64;       ///< triangles of a node that a candidate is weighed by

struct BspSplit {
    BspPlane plane;
    bool planar_left = true;
};

/// A node before its plane is chosen.
struct Work {
    BspPieces pieces;
    ConvexCell cell;
    uint32_t depth = 0;
    RefBudget budget;
    uint64_t seed = 0;
};

/// The pieces that candidates are weighed by, as polygons one after the other.
struct Sample {
    std::vector<DVec3> corners;
    std::vector<size_t> ends;  ///< of each polygon
    double scale;              ///< pieces of the node for each of the sample
};

struct Counts {
    double left = 0.0, right = 0.0, in_plane = 0.0;
};

class BspBuild {
public:
    BspBuild(const BspSah& params, const Mesh& mesh, uint32_t max_depth, const Task& task)
        : params_(params), mesh_(mesh), max_depth_(max_depth), task_(task) {}

    void build_node(Work work, BspOutput& output) const {
        const std::optional<BspSplit> split = choose(work);
        Work left, right;
        if (!split || !divide(work, *split, left, right)) return output.add_leaf(work.pieces.list);
        const bool is_large = work.pieces.list.size() > kSerialCount;
        work = {};  // so that pieces and cells of one node on each path are kept alone
        const uint32_t inner = output.add_inner(split->plane);
        if (is_large) {
            BspOutput left_output, right_output;
            parallel_invoke([&] { build_node(std::move(left), left_output); },
                            [&] { build_node(std::move(right), right_output); });
            output.append(left_output);
            output.begin_right(inner);
            output.append(right_output);
        } else {
            build_node(std::move(left), output);
            output.begin_right(inner);
            build_node(std::move(right), output);
        }
    }

private:
    std::vector<DVec3> polygon_of(const BspPieces& pieces, const BspPiece& piece) const {
        const std::span<const DVec3> corners = pieces.corners_of(piece);
        if (!corners.empty()) return {corners.begin(), corners.end()};
        const Triangle t = mesh_.triangle(piece.prim);
        return {DVec3(t.a), DVec3(t.b), DVec3(t.c)};
    }

    Sample draw_sample(const BspPieces& pieces, Rng& rng) const {
        Sample sample;
        const size_t count = std::min(kWeighed, pieces.list.size());
        sample.scale = static_cast<double>(pieces.list.size()) / static_cast<double>(count);
        for (size_t i = 0; i < count; ++i) {
            const size_t drawn = count == pieces.list.size() ? i : rng.next_index(pieces.list.size());
            const std::vector<DVec3> polygon = polygon_of(pieces, pieces.list[drawn]);
            sample.corners.insert(sample.corners.end(), polygon.begin(), polygon.end());
            sample.ends.push_back(sample.corners.size());
        }
        return sample;
    }

    /// Planes of some triangles of the node, and the axis planes through the middle of its cell.
    std::vector<BspPlane> draw_candidates(const Work& work, Rng& rng) const {
        const bool has_axes = params_.planes != 1, has_triangles = params_.planes != 2;
        std::vector<BspPlane> planes;
        if (has_axes) {
            const Box box = work.cell.bounds();
            for (int axis = 0; axis < 3; ++axis)
                planes.push_back(BspPlane::across(axis, 0.5f * box.lower[axis] + 0.5f * box.upper[axis]));
        }
        const std::vector<BspPiece>& list = work.pieces.list;
        const size_t count = std::min(static_cast<size_t>(params_.candidates), list.size());
        for (size_t i = 0; i < count; ++i) {
            const BspPiece& piece = list[count == list.size() ? i : rng.next_index(list.size())];
            const Triangle t = mesh_.triangle(piece.prim);
            if (has_axes) add_box_planes(polygon_of(work.pieces, piece), planes);
            if (!has_triangles) continue;
            planes.push_back(BspPlane::through(t));
            const Vec3 corners[3] = {t.a, t.b, t.c};
            const size_t edge = rng.next_index(3);
            const auto on_edge =
                plane_on_edge(corners[edge], corners[(edge + 1) % 3], corners[(edge + 2) % 3]);
            if (on_edge) planes.push_back(*on_edge);
        }
        return planes;
    }

    static void add_box_planes(const std::vector<DVec3>& polygon, std::vector<BspPlane>& planes) {
        DVec3 lower = polygon[0], upper = polygon[0];
        for (const DVec3& corner : polygon) {
            lower = glm::min(lower, corner);
            upper = glm::max(upper, corner);
        }
        for (int axis = 0; axis < 3; ++axis) {
            planes.push_back(BspPlane::across(axis, static_cast<float>(lower[axis])));
            if (lower[axis] < upper[axis])
                planes.push_back(BspPlane::across(axis, static_cast<float>(upper[axis])));
        }
    }

    static Counts count_sides(const Sample& sample, const PlaneValue& value, double tolerance) {
        Counts counts;
        size_t i = 0;
        for (const size_t end : sample.ends) {
            double least = std::numeric_limits<double>::infinity(), largest = -least;
            for (; i < end; ++i) {
                const double h = value.at(sample.corners[i]);
                least = std::min(least, h);
                largest = std::max(largest, h);
            }
            const bool is_left = least<-tolerance, is_right = largest> tolerance;
            counts.left += is_left ? sample.scale : 0.0;
            counts.right += is_right ? sample.scale : 0.0;
            counts.in_plane += is_left || is_right ? 0.0 : sample.scale;
        }
        return counts;
    }

    bool must_be_leaf(const Work& work) const {
        return work.pieces.list.size() <= static_cast<size_t>(params_.leaf_size) ||
               work.depth >= max_depth_ || task_.stopped();
    }

    /// The cheapest candidate; nothing where a leaf is cheaper.
    std::optional<BspSplit> choose(const Work& work) const {
        if (must_be_leaf(work)) return std::nullopt;
        Rng rng(work.seed);
        const Sample sample = draw_sample(work.pieces, rng);
        const double area = work.cell.half_area();
        double best_cost = leaf_cost(work.pieces.list.size()) * area;
        std::optional<BspSplit> best;
        for (const BspPlane& plane : draw_candidates(work, rng)) {
            const PlaneValue value(plane);
            const Counts counts = count_sides(sample, value, work.cell.tolerance(value));
            // The parts' areas sum to more than the cell's, and neither is larger than that.
            const double least = double(params_.traversal_cost) + std::min(counts.left, counts.right);
            if (least * area >= best_cost) continue;
            const ConvexCell::Areas areas = work.cell.cut_areas(value);
            if (!(areas.left > 0.0 && areas.right > 0.0)) continue;
            const bool planar_left = areas.left <= areas.right;
            const double cost = double(params_.traversal_cost) * area +
                                kIntersectionCost * (areas.left * counts.left + areas.right * counts.right +
                                                     std::min(areas.left, areas.right) * counts.in_plane);
            if (cost < best_cost) {
                best_cost = cost;
                best = {plane, planar_left};
            }
        }
        return best;
    }

    /// False, where the budget does not allow the children or no triangle is in one alone.
    bool divide(const Work& work, const BspSplit& split, Work& left, Work& right) const {
        const PlaneValue value(split.plane);
        for (const BspPiece& piece : work.pieces.list) {
            const Triangle triangle = mesh_.triangle(piece.prim);
            const BspSides sides = sides_of(split.plane, value, triangle, work.pieces.corners_of(piece));
            const bool is_cut = sides.left && sides.right;
            const bool goes_left = sides.left || (sides.is_in_plane() && split.planar_left);
            const bool goes_right = sides.right || (sides.is_in_plane() && !split.planar_left);
            if (goes_left) add(work.pieces, piece, value, is_cut ? -1 : 0, left.pieces);
            if (goes_right) add(work.pieces, piece, value, is_cut ? 1 : 0, right.pieces);
        }
        const size_t count = work.pieces.list.size();
        const size_t left_count = left.pieces.list.size(), right_count = right.pieces.list.size();
        if (left_count == count && right_count == count) return false;
        if (!work.budget.allows(left_count, right_count)) return false;
        std::tie(left.cell, right.cell) = work.cell.cut(value);
        left.depth = right.depth = work.depth + 1;
        left.budget = work.budget.left_share(left_count, right_count);
        right.budget = {work.budget.refs - left.budget.refs};
        left.seed = mix_bits(work.seed + 1);
        right.seed = mix_bits(work.seed + 2);
        return true;
    }

    /// The part of a piece on one side; the piece as it is for side 0.
    void add(const BspPieces& from, const BspPiece& piece, const PlaneValue& value, int side,
             BspPieces& to) const {
        const size_t first = to.corners.size();
        if (side == 0) {
            const std::span<const DVec3> corners = from.corners_of(piece);
            to.corners.insert(to.corners.end(), corners.begin(), corners.end());
        } else {
            cut_piece(value, mesh_.triangle(piece.prim), polygon_of(from, piece), side, to.corners);
        }
        to.list.push_back(
            {piece.prim, static_cast<uint32_t>(first), static_cast<uint32_t>(to.corners.size() - first)});
    }

    const BspSah& params_;
    const Mesh& mesh_;
    uint32_t max_depth_;
    const Task& task_;
};

}  // namespace

BspTree BspSah::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    if (refs.empty()) return {};
    Work root;
    Box bounds;
    for (const PrimRef& ref : refs) {
        bounds.extend(ref.bounds);
        // The references of one primitive are adjacent, primitives ascend.
        if (root.pieces.list.empty() || root.pieces.list.back().prim != ref.prim)
            root.pieces.list.push_back({ref.prim, 0, 0});
    }
    const size_t count = root.pieces.list.size();
    const uint32_t depth = max_depth > 0 ? static_cast<uint32_t>(max_depth) : default_depth(count);
    root.cell = ConvexCell(bounds);
    root.budget = {static_cast<uint64_t>(budget) * count};
    root.seed = static_cast<uint64_t>(seed);
    BspOutput output;
    BspBuild(*this, mesh, depth, task).build_node(std::move(root), output);
    if (task.stopped()) return {};
    return output.finish(bounds);
}

}  // namespace boxwood
