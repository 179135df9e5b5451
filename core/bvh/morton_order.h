#pragma once

#include "core/base/array.h"
#include "core/bvh/box4.h"
#include "core/bvh/top_down.h"

namespace boxwood {

/// Maps centres to places on the Morton curve. Morton, "A computer oriented geodetic data base and a new
/// technique in file sequencing", IBM 1966.
/// A cube with the longest extent of all centres as its edge is cut into 2^21 intervals along each axis.
/// Cubic cells make better trees than those that have the shape of the scene, of most scenes.
class MortonGrid {
public:
    explicit MortonGrid(const Box& half_centers);

    /// 63 bits: the first bit of the three axes, then the second, ...; longer axes first.
    uint64_t code(const PrimRef& ref) const;
    /// The 33 leading bits of code().
    uint64_t leading_code(const PrimRef& ref) const;

private:
    Int4 cell(const PrimRef& ref) const;

    Float4 lower_, scale_;
    int shift_[3];  ///< of an axis' bits within each triple
};

/// References along the Morton curve.
struct MortonOrder {
    static constexpr uint8_t kEqual = 63;
    static constexpr int kRefBits = 31;
    /// From here on leading codes are of 33 bits, not of 30, whose cells would hold too many.
    static constexpr size_t kMany = size_t{1} << 22;

    /// Leading code << kRefBits | reference. Of fewer than kMany the last three bits of the code are 0.
    Array<uint64_t> keys;
    /// Between entries i and i + 1: the leading bits that their codes have in common, kEqual for equal ones.
    Array<uint8_t> levels;

    uint32_t ref(size_t i) const { return static_cast<uint32_t>(keys[i] & ((uint64_t{1} << kRefBits) - 1)); }
    uint64_t leading_code(size_t i) const { return keys[i] >> kRefBits; }
};

/// Sorts by leading code; where more than `run_limit` references share one, these by their whole code; equal
/// ones by index. In runs up to `run_limit` the references keep their order, and their levels are kEqual.
/// At most 2^31 references.
MortonOrder morton_order(std::span<const PrimRef> refs, uint32_t run_limit, const Task& task);

}  // namespace boxwood
