#pragma once

#include <utility>
#include <vector>

#include "core/base/box.h"
#include "core/bsp/bsp_plane.h"

namespace boxwood {

/// A convex cell of a BSP, as polygons of double corners. Each cut is off by roundings, so it is good for
/// areas and pictures, and not for deciding what lies inside. A corner within the tolerance of a plane counts
/// as lying in it, so that no sliver comes from a plane through a corner.
class ConvexCell {
public:
    using Polygon = std::vector<DVec3>;

    ConvexCell() = default;
    explicit ConvexCell(const Box& box);

    /// Half the surface areas of the two parts; without a part on both sides both are 0.
    struct Areas {
        double left = 0.0, right = 0.0;
    };
    Areas cut_areas(const PlaneValue& plane) const;
    /// The parts on both sides. Requires one on both.
    std::pair<ConvexCell, ConvexCell> cut(const PlaneValue& plane) const;

    /// |h| of a corner up to this counts as 0.
    double tolerance(const PlaneValue& plane) const;
    double half_area() const;
    double volume() const;
    /// Box of the corners, moved outwards by the tolerance and rounded outwards.
    Box bounds() const;
    /// Closed polygons, each with its corners in order.
    const std::vector<Polygon>& faces() const { return faces_; }

private:
    /// The part of a face on one side of a plane (-1 left, 1 right), adds the corners
    /// that lie in the plane. Empty if no corner is strictly on that side.
    Polygon part_of(const Polygon& face, const PlaneValue& plane, int side, Polygon& in_plane) const;
    ConvexCell part_of(const PlaneValue& plane, int side) const;
    void add_face(Polygon face);
    std::vector<Polygon> faces_;
    std::vector<DVec3> areas_;  ///< twice the faces' area vectors
    double reach_ = 0.0;        ///< largest |coordinate| of the root's box
};

}  // namespace boxwood
