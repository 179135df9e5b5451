#include "core/wide_bvh/fill_packs.h"

#include <algorithm>
#include <cstring>

namespace boxwood {

namespace {

/// Four points as parts of rows that begin at `first`: all x, all y, all z.
void store_rows(const Float4 (&p)[4], float (&rows)[3][Pack8::kSize], uint32_t first) {
    const Float4 xy01 = __builtin_shufflevector(p[0], p[1], 0, 4, 1, 5);
    const Float4 xy23 = __builtin_shufflevector(p[2], p[3], 0, 4, 1, 5);
    const Float4 z01 = __builtin_shufflevector(p[0], p[1], 2, 6, 3, 7);
    const Float4 z23 = __builtin_shufflevector(p[2], p[3], 2, 6, 3, 7);
    const Float4 x = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
    const Float4 y = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
    const Float4 z = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
    std::memcpy(rows[0] + first, &x, sizeof x);
    std::memcpy(rows[1] + first, &y, sizeof y);
    std::memcpy(rows[2] + first, &z, sizeof z);
}

}  // namespace

/// The fourth lane means nothing: it is what comes after the position, where that is not the last.
Float4 PackFiller::load(uint32_t vertex) const {
    const Vec3& p = positions_[vertex];
    if (vertex == last_) return Float4{p.x, p.y, p.z, 0.0f};
    Float4 result;
    std::memcpy(&result, positions_ + vertex, sizeof result);
    return result;
}

Box4 PackFiller::fill(const PackPrims& prims, Pack8& pack) const {
    Box4 box = empty_box4();
    for (uint32_t first = 0; first < Pack8::kSize; first += 4) {
        for (int corner = 0; corner < 3; ++corner) {
            Float4 points[4];
            for (uint32_t lane = 0; lane < 4; ++lane) {
                points[lane] = load(triangles_[prims[first + lane]][corner]);
                box.extend(points[lane], points[lane]);
            }
            store_rows(points, pack.corners[corner], first);
        }
    }
    std::ranges::copy(prims, pack.prims);
    return box;
}

void fill_packs(const Mesh& mesh, std::span<const PackPrims> prims, std::span<Pack8> packs) {
    constexpr size_t kAhead = 12, kCornersAhead = 6;
    const PackFiller filler(mesh);
    for (size_t i = 0; i < prims.size(); ++i) {
        if (i + kAhead < prims.size())
            for (const uint32_t prim : prims[i + kAhead]) filler.prefetch(prim);
        if (i + kCornersAhead < prims.size())
            for (const uint32_t prim : prims[i + kCornersAhead]) filler.prefetch_corners(prim);
        filler.fill(prims[i], packs[i]);
    }
}

}  // namespace boxwood
