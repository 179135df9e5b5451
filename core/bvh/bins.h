#pragma once

#include <span>

#include "core/bvh/box4.h"

namespace boxwood {

/// A reference as binning reads it: two aligned registers. The fourth lanes hold the halves of the primitive,
/// as small whole numbers: no lane ever holds bits that are slow to compute with.
struct BinRef {
    Float4 lower, upper;

    static BinRef of(const PrimRef& ref) {
        const Box& box = ref.bounds;
        const auto low = static_cast<float>(ref.prim & 0xffff), high = static_cast<float>(ref.prim >> 16);
        // + 0 turns -0 into 0, so that no box depends on the order of its references.
        return {Float4{box.lower.x, box.lower.y, box.lower.z, low} + splat(0.0f),
                Float4{box.upper.x, box.upper.y, box.upper.z, high} + splat(0.0f)};
    }
    uint32_t prim() const { return static_cast<uint32_t>(lower[3]) | static_cast<uint32_t>(upper[3]) << 16; }
    Float4 half_center() const { return half_center4(lower, upper); }
};

/// Maps centres to bins: Wald 2007, section 3.1. Scale 0 on an axis without extent.
struct Binning {
    Float4 lower, scale;
    int bin_count;

    Binning(const Box4& half_centers, int bins);
    Float4 position(const BinRef& ref) const { return (ref.half_center() - lower) * scale; }
};

/// Where a node is split, and what that costs: the sum of count * half area of both sides.
struct BinSplit {
    float cost = std::numeric_limits<float>::infinity();  ///< lengths in units of area_scale
    int axis = -1;                                        ///< -1: there is no split
    int bin = 0;                                          ///< first bin of the right side
};

/// Boxes and counts of the bins of the three axes; only what is used is initialised.
struct Bins {
    static constexpr int kMaxBins = 256;

    Box4 boxes[kMaxBins][3];
    Int4 counts[kMaxBins];  ///< lane: axis

    void fill(std::span<const BinRef> refs, const Binning& binning);
    void add(const Bins& other, int bin_count);
    /// Cheapest plane between two bins; the more even one of equally cheap ones; then the first axis, the
    /// first plane. Lengths are multiplied by area_scale, a power of two. References count by blocks of
    /// 1 << log_block, 0 or 3, the last of a side as a whole one.
    BinSplit cheapest_split(int bin_count, uint32_t count, float area_scale, int log_block = 0) const;
    /// Box of the bins [begin, end) of an axis.
    Box4 box_of(int axis, int begin, int end) const;
    /// References in the bins [0, end) of an axis.
    uint32_t count_of(int axis, int end) const;

private:
    template <bool is_scaled, int log_block>
    BinSplit sweep(int bin_count, uint32_t count, float scale) const;
};

/// A power of two that brings the largest extent of the box near 1.
float unit_scale(const Box4& box);

/// A power of two that keeps areas of parts of the box, computed with lengths times it, from overflow, and
/// from vanishing against the box's own: 1 for all but extreme boxes.
float area_scale(const Box4& box);

/// Extents times scale, without overflow.
inline Float4 scaled_extent(const Box4& box, float scale) {
    return splat(scale) * box.upper - splat(scale) * box.lower;
}

inline float half_area(Float4 extent) {
    return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
}

}  // namespace boxwood
