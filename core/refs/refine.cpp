#include "core/refs/refine.h"

#include <cmath>

namespace boxwood {

namespace {

double longest_edge(const Triangle& triangle) {
    const DVec3 a(triangle.a), b(triangle.b), c(triangle.c);
    return std::max(glm::length(b - a), std::max(glm::length(c - b), glm::length(a - c)));
}

/// Corners of the pieces of a triangle after n rounds: (i a + j b + k c) / 2^n, i + j + k = 2^n, and boxes
/// around three of them that contain the exact ones.
///
/// u = 2^-53, M the largest |coordinate| of the triangle in an axis. A product i a is exact (15 and 24 bits),
/// the division too (nothing is below 2^-149 / 2^15); the two sums round by u of at most 2^n M each: 2u M.
/// Moving a face by the bound rounds once more: 3u M. A sum is exact where it needs no more than 53 bits:
/// with m the smallest nonzero |coordinate|, 2^e <= m < 2^(e + 1), all products are multiples of 2^(e - 23),
/// so sums up to 2^n M are exact where 2^n M <= 2^(e + 30), which M <= m 2^(29 - n) implies.
class PieceGrid {
public:
    PieceGrid(const Triangle& triangle, int rounds)
        : a_(triangle.a), b_(triangle.b), c_(triangle.c), bounds_(triangle.bounds()), count_(1 << rounds) {
        for (int axis = 0; axis < 3; ++axis) {
            double largest = 0.0, smallest = std::numeric_limits<double>::max();
            for (const DVec3& corner : {a_, b_, c_}) {
                const double x = std::abs(corner[axis]);
                largest = std::max(largest, x);
                if (x > 0.0) smallest = std::min(smallest, x);
            }
            const bool is_exact = largest <= std::ldexp(smallest, 29 - rounds);
            error_[axis] = is_exact ? 0.0 : 3.0 * 0x1.01p-53 * largest;
        }
    }

    int count() const { return count_; }

    DVec3 corner(int i, int j) const {
        const double k = count_ - i - j;
        return (static_cast<double>(i) * a_ + static_cast<double>(j) * b_ + k * c_) /
               static_cast<double>(count_);
    }
    Box box_of(const DVec3& p, const DVec3& q, const DVec3& r) const {
        const DVec3 least = glm::min(p, glm::min(q, r)) - error_, most = glm::max(p, glm::max(q, r)) + error_;
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            box.lower[axis] = round_down(least[axis]);
            box.upper[axis] = -round_down(-most[axis]);
        }
        // The exact pieces lie inside the triangle, and so inside its box.
        return {glm::max(box.lower, bounds_.lower), glm::min(box.upper, bounds_.upper)};
    }

private:
    /// The largest float that is at most x.
    static float round_down(double x) {
        const float f = static_cast<float>(x);
        return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
    }

    DVec3 a_, b_, c_;
    Box bounds_;
    int count_;
    DVec3 error_{0.0};
};

/// All pieces row by row: those that stand as the triangle does, and those turned by half a turn.
void cut(const Triangle& triangle, int rounds, const EmitBox& emit) {
    const PieceGrid grid(triangle, rounds);
    for (int i = 0; i < grid.count(); ++i)
        for (int j = 0; i + j < grid.count(); ++j) {
            const DVec3 corner = grid.corner(i, j), next_i = grid.corner(i + 1, j),
                        next_j = grid.corner(i, j + 1);
            if (!emit(grid.box_of(corner, next_i, next_j))) return;
            if (i + j + 1 == grid.count()) continue;
            if (!emit(grid.box_of(next_i, next_j, grid.corner(i + 1, j + 1)))) return;
        }
}

/// Rounds that halve a measure to the limit or below it.
int rounds_for(double measure, double limit) {
    int rounds = 0;
    while (rounds < Refinement::kMostRounds && std::ldexp(measure, -rounds) > limit) ++rounds;
    return rounds;
}

}  // namespace

References Refinement::make(const Mesh& mesh, Task& task) const {
    // By rounds: a measure that all triangles have, and that each round halves.
    const bool by_edge = edge > 0.0f;
    const auto measure = [by_edge](const Triangle& triangle) {
        return by_edge ? longest_edge(triangle) : 1.0;
    };
    const double largest = by_edge ? glm::length(mesh.bounds().extent()) : 1.0;
    const SubdivisionRule rule = {
        .limit = largest * std::exp2(by_edge ? -static_cast<double>(edge) : -static_cast<double>(rounds)),
        .largest = largest,
        .growth = 2.0,  // half the edge, four pieces
        .measure = measure,
        .cut = [&](const Triangle& triangle, double limit, const EmitBox& emit) {
            cut(triangle, rounds_for(measure(triangle), limit), emit);
        }};
    return subdivide(mesh, rule, budget, task);
}

}  // namespace boxwood
