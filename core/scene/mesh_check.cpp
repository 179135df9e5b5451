#include "core/scene/mesh_check.h"

#include <array>
#include <cmath>

#include "core/base/assert.h"
#include "core/base/expansion.h"

namespace boxwood {
namespace {

/// The six products whose sum is one component of (b - a) x (c - a), over the plane of the axes u and v. Each
/// is exact: a product of two floats has 48 bits and an exponent between -298 and 256, which a double holds.
struct CrossTerms {
    std::array<double, 6> products;

    CrossTerms(const Triangle& t, int u, int v) {
        const DVec3 a(t.a), b(t.b), c(t.c);
        products = {a[u] * b[v], -a[v] * b[u], b[u] * c[v], -b[v] * c[u], c[u] * a[v], -c[v] * a[u]};
    }
    /// True only if the sum is not zero. Five roundings, each below 2^-53 of the sum of magnitudes, and those
    /// of the magnitudes' own sum: 16 * 2^-53 covers both.
    bool is_clearly_nonzero() const {
        double sum = 0.0, magnitude = 0.0;
        for (const double p : products) {
            sum += p;
            magnitude += std::abs(p);
        }
        return std::abs(sum) > 0x1p-49 * magnitude;
    }
    bool is_exactly_zero() const {
        Expansion sum;
        for (const double p : products) sum = sum + Expansion(p);
        return sum.sign() == 0;
    }
};

}  // namespace

bool has_zero_area(const Triangle& triangle) {
    const CrossTerms xy(triangle, 0, 1), yz(triangle, 1, 2), zx(triangle, 2, 0);
    if (xy.is_clearly_nonzero() || yz.is_clearly_nonzero() || zx.is_clearly_nonzero()) return false;
    return xy.is_exactly_zero() && yz.is_exactly_zero() && zx.is_exactly_zero();
}

void check_mesh(Mesh& mesh, Task& task) {
    const size_t count = mesh.triangles.size();
    if (mesh.source_prim.empty()) {
        mesh.source_prim.resize(count);
        for (size_t i = 0; i < count; ++i) mesh.source_prim[i] = static_cast<uint32_t>(i);
    }
    BOXWOOD_ASSERT(mesh.source_prim.size() == count && mesh.object.size() == count);
    uint64_t out_of_range = 0, non_finite = 0, zero_area = 0;
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        if (i % 4096 == 0 && task.stopped()) return;
        const UVec3 t = mesh.triangles[i];
        if (t.x >= mesh.positions.size() || t.y >= mesh.positions.size() || t.z >= mesh.positions.size()) {
            ++out_of_range;
            continue;
        }
        const Triangle triangle = mesh.triangle(static_cast<uint32_t>(i));
        if (!is_finite(triangle.a) || !is_finite(triangle.b) || !is_finite(triangle.c)) {
            ++non_finite;
            continue;
        }
        if (has_zero_area(triangle)) {
            ++zero_area;
            continue;
        }
        mesh.triangles[kept] = t;
        mesh.source_prim[kept] = mesh.source_prim[i];
        mesh.object[kept] = mesh.object[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    mesh.source_prim.resize(kept);
    mesh.object.resize(kept);
    for (Vec3& p : mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(p[axis])) p[axis] = 0.0f;
        }
    }
    task.skipped.add("index out of range", out_of_range);
    task.skipped.add("non-finite vertex", non_finite);
    task.skipped.add("zero area", zero_area);
}

}  // namespace boxwood
