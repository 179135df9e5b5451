#pragma once

#include <span>
#include <vector>

#include "core/bsp/bsp_plane.h"

namespace boxwood {

/// The part of a triangle in a cell: the whole triangle, or corners of a polygon.
struct BspPiece {
    uint32_t prim;
    uint32_t first, count;  ///< corners[first, first + count); count 0: the whole triangle
};

/// Pieces of the triangles that a cell's node refers to.
struct BspPieces {
    std::vector<BspPiece> list;
    std::vector<DVec3> corners;

    std::span<const DVec3> corners_of(const BspPiece& piece) const {
        return std::span(corners).subspan(piece.first, piece.count);
    }
};

/// Children that a piece belongs to.
struct BspSides {
    bool left = false, right = false;

    bool is_in_plane() const { return !left && !right; }
};

/// Sides of a plane that the triangle's part in a cell may reach; the part is the whole triangle or within
/// the polygon. Of the whole triangle it is decided without error: a side counts where a vertex is strictly
/// on it, so a triangle that only touches the plane is on one side, and one in the plane on none. A polygon
/// takes a side away where it is certain that no point of the part reaches the plane.
///
/// The exact part lies in the convex hull of the polygon's corners, widened by e = kPieceError M along each
/// axis, M the largest |coordinate| of the triangle: see cut_piece. So h of each of its points differs from
/// that of a point of the hull by at most slope e, and h of the hull lies between those of its corners.
BspSides sides_of(const BspPlane& plane, const PlaneValue& value, const Triangle& triangle,
                  std::span<const DVec3> polygon);

inline constexpr double kPieceError = 0x1p-42;

/// Adds to `part` the corners of the polygon's part on one side (-1 left, 1 right) of a plane, so that the
/// hull of the result, widened, contains the exact part on that side.
///
/// The cut is made not at h = 0 but beyond it, at a distance of twice what h may be off by at a corner and
/// what widening by e adds, so that it loses no point with h <= 0 of the widened hull, though the place on an
/// edge rounds by 3u (|h_p| + |h_q|), which is below either bound. A corner made there is off the edge by 5
/// roundings of at most 2M each: 10u M. A hull grows by that with each cut, and once more where a corner
/// lies inwards of it: after 64 cuts by less than 64 * 20u M < 2^-42 M.
void cut_piece(const PlaneValue& value, const Triangle& triangle, std::span<const DVec3> polygon, int side,
               std::vector<DVec3>& part);

}  // namespace boxwood
