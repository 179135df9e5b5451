#include "core/refs/edge_volume.h"

#include <array>
#include <cmath>

#include "core/base/assert.h"

namespace boxwood {

namespace {

// Why it ends. A cut edge is longer than a fixed length in every axis, since its volume is above the
// threshold and no extent exceeds the scene's. The largest edge of a piece is halved, and the median, the
// only new edge, is never longer than the longer of the two edges beside it; so a piece that is cut for ever
// would shrink below that length. Among 3,000 random triangles and needles as large as the scene, t from 3 to
// 18, no piece was deeper than t; t is at most 40. What would be deeper than this bound stays whole, which is
// correct at any depth: it bounds the stack.
constexpr int kMostCuts = 96;

struct SubTriangle {
    DVec3 a, b, c;
    int depth;
};

/// The same for both orders of the ends: the sign of a difference is exact, the factors are in axis order.
double volume(const DVec3& a, const DVec3& b) {
    return std::abs(b.x - a.x) * std::abs(b.y - a.y) * std::abs(b.z - a.z);
}

/// Turns the piece so that ab is its largest edge; of equal ones the first in the order ab, bc, ca. Which of
/// them is cut first makes no crack: an edge's middle depends on its ends alone.
double turn_to_largest_edge(SubTriangle& piece) {
    const double ab = volume(piece.a, piece.b), bc = volume(piece.b, piece.c), ca = volume(piece.c, piece.a);
    if (ab >= bc && ab >= ca) return ab;
    if (bc >= ca) {
        piece = {piece.b, piece.c, piece.a, piece.depth};
        return bc;
    }
    piece = {piece.c, piece.a, piece.b, piece.depth};
    return ca;
}

/// Turns the corners of pieces into boxes that contain the exact pieces, those that exact middles would give;
/// they tile the triangle.
///
/// u = 2^-53, M the largest |coordinate| of the triangle in an axis. A middle is a rounded sum and an exact
/// half (a middle is a multiple of 2^(-149 - depth): nothing is lost to underflow), so a corner at depth d is
/// off by at most the mean error of its two parents and u M. A sum of two floats rounds only where one is
/// below 2^-28 of the other, by u M, which is u M / 2 of their middle: by (d - 1/2) u M in all. It is exact
/// where no sum needs more than 53 bits: with m the smallest nonzero |coordinate|, 2^e <= m < 2^(e + 1), all
/// coordinates are multiples of 2^(e - 23) and the corners above depth d multiples of 2^(e - 22 - d), so sums
/// up to 2M are exact where 2M <= 2^(e + 31 - d), which M <= m 2^(29 - d) implies. Moving a face by the bound
/// rounds once more: d + 1/2.
class OutwardBoxes {
public:
    explicit OutwardBoxes(const Triangle& triangle) : bounds_(triangle.bounds()) {
        for (const Vec3& corner : {triangle.a, triangle.b, triangle.c})
            for (int axis = 0; axis < 3; ++axis) {
                const double x = std::abs(double(corner[axis]));
                largest_[axis] = std::max(largest_[axis], x);
                if (x > 0.0) smallest_[axis] = std::min(smallest_[axis], x);
            }
    }

    Box box_of(const SubTriangle& piece) const {
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_exact = largest_[axis] <= std::ldexp(smallest_[axis], 29 - piece.depth);
            const double error = is_exact ? 0.0 : (piece.depth + 0.5) * 0x1.01p-53 * largest_[axis];
            const double a = piece.a[axis], b = piece.b[axis], c = piece.c[axis];
            box.lower[axis] = round_down(std::min(a, std::min(b, c)) - error);
            box.upper[axis] = -round_down(-std::max(a, std::max(b, c)) - error);
        }
        // The exact pieces lie inside the triangle, and so inside its box.
        return {glm::max(box.lower, bounds_.lower), glm::min(box.upper, bounds_.upper)};
    }

private:
    /// The largest float that is at most x.
    static float round_down(double x) {
        const float f = static_cast<float>(x);
        return double(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
    }

    Box bounds_;
    DVec3 largest_{0.0};
    DVec3 smallest_{std::numeric_limits<double>::max()};
};

/// Depth first, so that the stack holds at most one waiting piece for each depth.
void cut_edges(const Triangle& triangle, double threshold, const EmitBox& emit) {
    const OutwardBoxes boxes(triangle);
    std::array<SubTriangle, kMostCuts + 1> stack;
    size_t size = 0;
    stack[size++] = {DVec3(triangle.a), DVec3(triangle.b), DVec3(triangle.c), 0};
    while (size > 0) {
        SubTriangle piece = stack[--size];
        const double largest = turn_to_largest_edge(piece);
        const DVec3 middle = (piece.a + piece.b) * 0.5;
        // An edge that has no number between its ends cannot be cut.
        const bool is_cut =
            largest > threshold && piece.depth < kMostCuts && middle != piece.a && middle != piece.b;
        if (!is_cut) {
            if (!emit(boxes.box_of(piece))) return;
            continue;
        }
        BOXWOOD_ASSERT(size + 2 <= stack.size());
        stack[size++] = {middle, piece.b, piece.c, piece.depth + 1};
        stack[size++] = {piece.a, middle, piece.c, piece.depth + 1};
    }
}

}  // namespace

double edge_volume_threshold(const Box& scene_bounds, int t) { return std::ldexp(scene_bounds.volume(), -t); }

double edge_volume(const Triangle& triangle) {
    const DVec3 a(triangle.a), b(triangle.b), c(triangle.c);
    return std::max(volume(a, b), std::max(volume(b, c), volume(c, a)));
}

References EdgeVolume::make(const Mesh& mesh, Task& task) const {
    const Box bounds = mesh.bounds();
    // In a flat scene no edge has a volume, so that none is above the threshold of 0.
    const SubdivisionRule rule = {.limit = edge_volume_threshold(bounds, t),
                                  .largest = bounds.volume(),
                                  .growth = 2.0 / 3.0,  // a cut makes two pieces; two cuts halve every extent
                                  .measure = edge_volume,
                                  .cut = cut_edges};
    return subdivide(mesh, rule, budget, task);
}

}  // namespace boxwood
