#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/volume_bvh/oriented_box.h"
#include "core/volume_bvh/sphere.h"

namespace boxwood {

/// A binary BVH with a sphere for each node in place of its box. Lecture (Kerbl), "Bounding volumes": the
/// centre is the mean vertex or the centre of the box, the radius the distance of the farthest vertex.
/// A triangle that is not whole in a leaf (see Piece) counts with the nearer of its own farthest corner and
/// that of its piece's box.
struct Spheres {
    using Input = Bvh2;
    using Output = VolumeBvh<Sphere>;

    enum Center { Mean, OfBox };
    int center = OfBox;  ///< of the node's vertices, or of its box

    void describe(ParamVisitor& v) {
        static constexpr const char* kCenters[] = {"mean", "box"};
        v.on_enum("center", center, kCenters, "the mean of the vertices, or the centre of the box");
    }
    Output apply(const Mesh& mesh, std::span<const PrimRef> refs, const Input& input, Task& task) const;
};

/// A binary BVH with an oriented box for each node in place of its box. Lecture (Kerbl), "Bounding volumes".
/// Of four orientations the one with the least surface area: that of the node's own box, which costs
/// nothing to fit; the principal axes of the vertices; the largest triangle's normal with its longest edge,
/// and with its second longest, which lies along a rectangle that is cut into triangles. A slab of a piece of
/// a triangle (see Piece) is the common one of the triangle and its box. Gottschalk, Lin, Manocha, "OBBTree:
/// A Hierarchical Structure for Rapid Interference Detection", SIGGRAPH 1996, section 4, for the principal
/// axes. Differs: of the vertices, not of the convex hull's surface.
struct OrientedBoxes {
    using Input = Bvh2;
    using Output = VolumeBvh<OrientedBox>;

    void describe(ParamVisitor&) {}
    Output apply(const Mesh& mesh, std::span<const PrimRef> refs, const Input& input, Task& task) const;
};

}  // namespace boxwood
