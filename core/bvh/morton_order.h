#pragma once

#include <array>

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
    /// The 30 leading bits of code().
    uint32_t leading_code(const PrimRef& ref) const;

private:
    static constexpr int kLeadingAxisBits = 10;

    Int4 cell(const PrimRef& ref) const;

    Float4 lower_, scale_;
    int shift_[3];                                            ///< of an axis' bits within each triple
    std::array<uint32_t, 1 << kLeadingAxisBits> leading_[3];  ///< code of a cell along an axis
};

/// References along the Morton curve.
struct MortonOrder {
    static constexpr uint8_t kEqual = 63;

    /// Leading code << 32 | reference.
    Array<uint64_t> keys;
    /// Between entries i and i + 1: the leading bits that their codes have in common, kEqual for equal ones.
    Array<uint8_t> levels;

    uint32_t ref(size_t i) const { return static_cast<uint32_t>(keys[i]); }
    uint32_t leading_code(size_t i) const { return static_cast<uint32_t>(keys[i] >> 32); }
};

/// Sorts by leading code; where more than `run_limit` references share one, these by their whole code; equal
/// ones by index. In runs up to `run_limit` the references keep their order, and their levels are kEqual.
MortonOrder morton_order(std::span<const PrimRef> refs, uint32_t run_limit, const Task& task);

}  // namespace boxwood
