#pragma once

#include "core/grid/grid.h"
#include "core/refs/subdivision.h"
#include "core/structure/method.h"

namespace boxwood {

/// Overlays the scene with a regular grid and sorts the triangles into the cells that they touch. Kerbl,
/// lecture, "Regular Grid". The resolution is given by hand for each axis, or follows from a density of cells
/// that are as near to cubes as the scene's box allows: Cleary, Wyvill, "Analysis of an Algorithm for Fast
/// Ray Tracing Using Uniform Space Subdivision", The Visual Computer 4, 1988.
///
/// A triangle belongs to a cell where its closed triangle touches the closed cell, decided exactly; so the
/// boxes of references change nothing. Bounded: at most kMaxCells cells; where the references exceed the
/// budget, or no float lies between two walls, the resolution is halved until they do not.
struct UniformGrid {
    static constexpr uint32_t kMaxCells = 1u << 24;

    float density = 4.0f;     ///< cells for each triangle, 0.001 to 1000
    int x = 0, y = 0, z = 0;  ///< cells along an axis, 0 to 4096; 0: from the density
    ReferenceBudget budget{.per_triangle = 64, .at_least = size_t{1} << 20};

    void describe(ParamVisitor& v) {
        v.on_float("density", density, 0.001f, 1000.0f, "cells for each triangle");
        v.on_int("x", x, 0, 4096, "cells along x; 0: from the density");
        v.on_int("y", y, 0, 4096, "cells along y; 0: from the density");
        v.on_int("z", z, 0, 4096, "cells along z; 0: from the density");
        v.on_int("budget", budget.per_triangle, 1, 1024,
                 "references at most, for each triangle of the scene");
    }
    /// In task.skipped: "grid cells over the limit", "grid cells over the reference budget".
    Grid build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;

    /// Cells along each axis that the parameters ask for; axes without extent have one. An axis of the
    /// density that would have less than one cell gets one, and the others share what is left.
    UVec3 resolution(const Box& bounds, size_t prim_count) const;
};

/// Walls of `count` equal cells from lower to upper, both included, each computed from its index; of fewer
/// cells where they would not be strictly increasing. Two equal walls if lower == upper.
std::vector<float> make_walls(float lower, float upper, uint32_t count);

}  // namespace boxwood
