#pragma once

#include <array>
#include <optional>

#include "core/scene/mesh.h"

namespace boxwood {

/// Symmetric 3 x 3 matrix in double, zero by default.
struct SymmetricMatrix {
    double at[3][3] = {};

    /// Adds the matrix v v^T.
    void add_square(const DVec3& v) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) at[i][j] += v[i] * v[j];
    }
};

/// Eigenvectors of a covariance matrix, unit vectors at right angles but for the rounding to float, by
/// descending eigenvalue. Nothing for a matrix that is zero. Jacobi's method: Golub, Van Loan, "Matrix
/// Computations", section 8.5, a fixed number of sweeps.
std::optional<std::array<Vec3, 3>> principal_axes(SymmetricMatrix matrix);

/// Longest (rank 0) or second longest (1) edge, what is at right angles to it in the triangle's plane, and
/// the normal, as unit vectors. Nothing for a triangle whose plane rounding hides.
std::optional<std::array<Vec3, 3>> triangle_axes(const Triangle& triangle, size_t rank);

}  // namespace boxwood
