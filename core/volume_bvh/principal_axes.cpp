#include "core/volume_bvh/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace boxwood {

namespace {

/// One rotation in the plane of axes p and q that makes the element at (p, q) zero. Golub, Van Loan,
/// algorithm 8.5.1.
void rotate(SymmetricMatrix& a, DVec3 (&vectors)[3], int p, int q) {
    if (a.at[p][q] == 0.0) return;
    const double tau = (a.at[q][q] - a.at[p][p]) / (2.0 * a.at[p][q]);
    const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::sqrt(1.0 + tau * tau));
    const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double kp = a.at[k][p], kq = a.at[k][q];
        a.at[k][p] = c * kp - s * kq;
        a.at[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; ++k) {
        const double pk = a.at[p][k], qk = a.at[q][k];
        a.at[p][k] = c * pk - s * qk;
        a.at[q][k] = s * pk + c * qk;
    }
    const DVec3 vp = vectors[p], vq = vectors[q];
    vectors[p] = c * vp - s * vq;
    vectors[q] = s * vp + c * vq;
}

}  // namespace

std::optional<std::array<Vec3, 3>> principal_axes(SymmetricMatrix matrix) {
    constexpr int kSweeps = 8;  // convergence is quadratic: the sixth changes no bit
    const double trace = matrix.at[0][0] + matrix.at[1][1] + matrix.at[2][2];
    if (!(trace > 0.0)) return std::nullopt;
    for (auto& line : matrix.at)
        for (double& element : line) element /= trace;
    DVec3 vectors[3] = {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        rotate(matrix, vectors, 0, 1);
        rotate(matrix, vectors, 0, 2);
        rotate(matrix, vectors, 1, 2);
    }
    std::array<int, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(),
                     [&](int i, int j) { return matrix.at[i][i] > matrix.at[j][j]; });
    return std::array<Vec3, 3>{Vec3(glm::normalize(vectors[order[0]])),
                               Vec3(glm::normalize(vectors[order[1]])),
                               Vec3(glm::normalize(vectors[order[2]]))};
}

std::optional<std::array<Vec3, 3>> triangle_axes(const Triangle& triangle, size_t rank) {
    const DVec3 a(triangle.a), b(triangle.b), c(triangle.c);
    std::array<DVec3, 3> edges{b - a, c - b, a - c};
    std::stable_sort(edges.begin(), edges.end(),
                     [](const DVec3& e, const DVec3& f) { return glm::dot(e, e) > glm::dot(f, f); });
    const double length = glm::length(edges[rank]);
    if (!(length > 0.0)) return std::nullopt;
    const DVec3 along = edges[rank] / length, other = edges[1 - rank];
    DVec3 across = other - glm::dot(other, along) * along;
    const double height = glm::length(across);
    if (!(height > 1e-12 * length)) return std::nullopt;
    across /= height;
    across -= glm::dot(across, along) * along;  // what rounding left of a needle's height along its edge
    across = glm::normalize(across);
    return std::array<Vec3, 3>{Vec3(along), Vec3(across), Vec3(glm::cross(along, across))};
}

}  // namespace boxwood
