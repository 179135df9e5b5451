#pragma once

#include <array>

#include "core/bvh/split_ref.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// A plane that divides a node's references, with what is expected of its two sides.
struct SpatialSplit {
    double cost = std::numeric_limits<double>::infinity();  ///< sum of count * half area of both sides
    int axis = -1;                                          ///< -1: there is none
    int bin = 0;                                            ///< first bin of the right side
    float position = 0.0f;
    uint32_t left_count = 0, right_count = 0;  ///< a reference that is cut counts on both sides
    Box4 left_box, right_box;
};

/// Where a reference lies with respect to a plane.
enum class Side : uint8_t { Left, Right, Both };

/// Chopped binning: the box of a node is divided into slabs of equal width on each axis, and each reference
/// is cut at the planes between them. Stich, Friedrich, Dietrich 2009, section 4.1, after Popov et al. 2006.
///
/// The boxes of the parts are estimates in float: they decide which plane is taken, not what a reference
/// becomes. Which side a reference lies on is decided by side() alone, so that counts are what they say.
class SpatialBins {
public:
    static constexpr int kMostBins = 64;

    SpatialBins(const Box4& bounds, int bin_count);
    void add(const SplitRef& ref, const Mesh& mesh);
    /// Adds what other ones over the same box hold.
    void add(const SpatialBins& other);
    SpatialSplit cheapest_split() const;
    Side side(const SplitRef& ref, const SpatialSplit& split) const {
        const Range range = range_of(ref, split.axis);
        if (range.last < split.bin) return Side::Left;
        return range.first >= split.bin ? Side::Right : Side::Both;
    }

private:
    /// Bins that a reference lies in. One that ends on a plane does not lie in the bin behind it.
    struct Range {
        int first, last;
    };
    Int4 bins_of(Float4 point) const;
    Range without_touched(Range range, const SplitRef& ref, int axis) const;
    Range range_of(const SplitRef& ref, int axis) const;
    void add_parts(const SplitRef& ref, const Mesh& mesh, int axis, Range range);
    void sweep(int axis, SpatialSplit& best) const;

    int bin_count_;
    Float4 half_lower_, scale_;
    std::array<std::array<float, kMostBins + 1>, 3> planes_;  ///< of an axis: first face to last face
    std::array<std::array<Box4, kMostBins>, 3> boxes_;  ///< only bin_count_ of each axis are initialised
    std::array<std::array<uint32_t, kMostBins>, 3> begins_, ends_;  ///< references that begin or end in a bin
};

/// Puts references on the two sides of a plane. Stich, Friedrich, Dietrich 2009, section 4.2: a reference
/// that lies on both is cut, unless it is cheaper to put all of it on one side (reference unsplitting).
class SpatialCutter {
public:
    SpatialCutter(const Mesh& mesh, const SpatialSplit& split);
    /// Of a reference on both sides: puts a part, or all of it, to a side that has a count other than 0.
    struct Parts {
        bool has_left = false, has_right = false;
        SplitRef left, right;
    };
    Parts cut(const SplitRef& ref);

private:
    const Mesh& mesh_;
    SpatialSplit split_;  ///< counts and boxes as they are with the references put so far
    double left_area_, right_area_;
};

}  // namespace boxwood
