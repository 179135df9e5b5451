#pragma once

#include "core/base/params.h"
#include "core/bsp/bsp_tree.h"
#include "core/refs/prim_ref.h"
#include "core/structure/sah.h"

namespace boxwood {

/// Top-down BSP by surface area cost over candidate planes: those of triangles in the cell (auto-partition),
/// those on their edges perpendicular to them, axis planes at the ends of their boxes, and the axis planes
/// through the middle of the cell. Fuchs, Kedem, Naylor 1980 (planes of the triangles); Ize, Wald, Parker,
/// "Ray Tracing with the BSP Tree", IRT 2008, section 4 (these candidates, areas of convex cells as
/// probabilities); lecture (Kerbl), "Binary Space Partition Tree". Differs: where a node has more triangles
/// than `candidates`, planes of so many drawn at random are weighed, by at most 64 triangles drawn likewise.
///
/// Sides are decided exactly, see sides_of. A triangle in the plane goes to the side that is cheaper, of
/// equal ones to the left. References count by their triangles alone: boxes of pieces are not looked at. Ends
/// by cost, by depth, and by the budget of references, which bounds memory: below 1000 bytes for each
/// reference that the budget allows. The same tree for the same seed.
struct BspSah {
    int planes = 0;                         ///< candidates: 0 all, 1 triangles, 2 axes
    int candidates = 6;                     ///< triangles of a node whose planes are weighed, 1 to 64
    float traversal_cost = kTraversalCost;  ///< one inner node, in triangle tests, 0 to 16
    int leaf_size = 2;                      ///< 1 to 64
    int max_depth = 0;                      ///< 0 to 64; 0: by the number of triangles
    int budget = 8;                         ///< 1 to 64
    int seed = 1;

    void describe(ParamVisitor& v) {
        static constexpr const char* kPlanes[] = {"all", "triangles", "axes"};
        v.on_enum("planes", planes, kPlanes, "candidates: all, those of triangles alone, or axis planes");
        v.on_int("candidates", candidates, 1, 64, "triangles of a node whose planes are weighed");
        v.on_float("traversal-cost", traversal_cost, 0.0f, 16.0f, "one inner node, in triangle tests");
        v.on_int("leaf-size", leaf_size, 1, 64, "so few triangles are not divided");
        v.on_int("max-depth", max_depth, 0, 64, "levels below the root; 0: 8 + 1.3 log2 of the triangles");
        v.on_int("budget", budget, 1, 64, "references in leaves at most, for each triangle");
        v.on_int("seed", seed, 0, 1000000, "of the random candidates");
    }
    /// Measured: 55 microseconds for each triangle and six candidates.
    double estimate_seconds(size_t triangle_count) const {
        return 55e-6 / 6.0 * candidates * static_cast<double>(triangle_count);
    }
    BspTree build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const;
};

}  // namespace boxwood
