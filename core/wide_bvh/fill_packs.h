#pragma once

#include <array>
#include <span>

#include "core/bvh/box4.h"
#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// The packs of sixteen-wide hierarchies.
using Pack8 = WideBvh<16>::Pack;

/// The primitives of a pack: those after the last one repeat it.
using PackPrims = std::array<uint32_t, Pack8::kSize>;

/// Gathers triangles of a mesh, neighbours on a curve or in a tree, into packs.
class PackFiller {
public:
    explicit PackFiller(const Mesh& mesh)
        : triangles_(mesh.triangles.data()),
          positions_(mesh.positions.data()),
          last_(static_cast<uint32_t>(mesh.positions.size()) - 1) {}

    /// Makes ready what fill() will read of the triangle: first its indices, then, nearer to the time, its
    /// corners.
    void prefetch(uint32_t prim) const { __builtin_prefetch(triangles_ + prim); }
    void prefetch_corners(uint32_t prim) const {
        const UVec3 triangle = triangles_[prim];
        for (int corner = 0; corner < 3; ++corner) __builtin_prefetch(positions_ + triangle[corner]);
    }
    /// Writes a pack; returns its box.
    Box4 fill(const PackPrims& prims, Pack8& pack) const;

private:
    Float4 load(uint32_t vertex) const;

    const UVec3* triangles_;
    const Vec3* positions_;
    uint32_t last_;  ///< vertex
};

/// Writes packs with the corners of their triangles. packs.size() == prims.size().
void fill_packs(const Mesh& mesh, std::span<const PackPrims> prims, std::span<Pack8> packs);

}  // namespace boxwood
