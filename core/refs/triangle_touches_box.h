#pragma once

#include <array>

#include "core/base/box.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// Tells for any number of boxes whether one triangle has a point in common with them; triangle and boxes are
/// closed. The answer is that of exact arithmetic for all finite floats, for triangles and boxes without area
/// too.
///
/// Separating axes: those of the box by comparing floats; the plane of the triangle; each edge of the
/// triangle seen along each axis. Akenine-Moeller, "Fast 3D Triangle-Box Overlap Testing", journal of
/// graphics tools 6(1), 2001; as half-planes of the projected triangle: Schwarz, Seidel, "Fast Parallel
/// Surface and Solid Voxelization on GPUs", SIGGRAPH Asia 2010, section 3.1. Differs: in double with error
/// bounds, which are derived in the source; what they leave open is decided by clip_bounds.
///
/// `bound_scale` multiplies the bounds: for the test that shows that half of them is wrong.
class TriangleBoxTest {
public:
    explicit TriangleBoxTest(const Triangle& triangle, double bound_scale = 1.0);

    bool touches(const Box& box) const;
    /// The same for a box that has a point in common with bounds(): leaves out that part of the test.
    bool touches_near(const Box& box) const;
    /// The box of the triangle.
    const Box& bounds() const { return bounds_; }

private:
    enum class Answer { Apart, Touching, Open };

    bool has_corner_in(const Box& box) const;
    Answer compare_plane(const Box& box) const;
    Answer compare_edges(size_t axis, const Box& box) const;

    Triangle triangle_;
    Box bounds_;
    std::array<std::array<double, 3>, 3> corner_, edge_;  // edge i: from corner i to the next one
    std::array<double, 3> normal_, normal_terms_;         // normal_terms_: with absolute values of the terms
    std::array<int, 3> facing_;                           // sign of the normal; 0 where that is open
    double bound_scale_;
};

/// Whether a closed triangle and a closed box have a point in common; exact. See TriangleBoxTest.
bool touches(const Triangle& triangle, const Box& box);

}  // namespace boxwood
