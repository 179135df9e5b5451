#pragma once

#include "core/bvh/bvh2.h"
#include "core/structure/method.h"
#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// What traversal of a wide hierarchy costs, in any one unit.
struct WideCosts {
    double node = 1.0;  ///< visiting an inner node: the boxes of all its children
    double pack = 1.0;  ///< testing a pack of triangles, however many of them are repetitions
};

/// Expected cost of a random ray that meets the root (see sah.h): the sum over all nodes of the probability
/// of a visit times the cost of a node (inner nodes), or the packs times the cost of a pack (leaves). This is
/// what `Collapse` makes least. 0 for an empty hierarchy.
template <uint32_t Width>
double wide_cost(const WideBvh<Width>& bvh, const WideCosts& costs);

/// Makes inner nodes with up to `Width` children out of a binary BVH: each node and each leaf of the result
/// is a subtree of the input, with its box.
///
/// Optimal: the subtrees are chosen so that wide_cost is the least of all choices. Ylitie, Karras, Laine,
/// "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, section 3.1; before
/// it Pinto, "Adaptive Collapsing on Bounding Volume Hierarchies for Ray-Tracing", Eurographics 2010 (short).
/// Differs: a leaf costs by packs, and holds a primitive of several references once; `leaf_size` is for
/// merged leaves, those of the input stay whole.
/// Greedy: the child with the largest area gives way to its two children as long as there is room. Wald,
/// Benthin, Boulos, "Getting Rid of Packets", RT 2008, section 3.1. Differs: subtrees that fit into one pack
/// become leaves.
template <uint32_t Width>
struct Collapse {
    using Input = Bvh2;
    using Output = WideBvh<Width>;

    enum Way { Greedy, Optimal };
    int way = Optimal;
    /// Triangles of a leaf that is made of several, at most, 1 to 124.
    int leaf_size = 2 * WideBvh<Width>::Pack::kSize;
    float node_cost = 1.0f;  ///< see WideCosts, 0 to 16
    /// See WideCosts, 0 to 16. Eight-wide: between 0.3 and 0.5, which both traced faster than 1 on most of
    /// nine scenes; fewer and fuller leaves are also fewer bytes. Sixteen-wide: times
    /// of five scenes differ by at most 6 % from 0.2 to 0.7, and not in one direction.
    float pack_cost = Width == 16 ? 0.3f : Width == 8 ? 0.4f : 1.0f;

    void describe(ParamVisitor& v) {
        static constexpr const char* kWays[] = {"greedy", "optimal"};
        v.on_enum("collapse", way, kWays, "open the largest child first, or by least expected cost");
        v.on_int("leaf-size", leaf_size, 1, 124, "triangles of a leaf made of several, at most");
        v.on_float("node-cost", node_cost, 0.0f, 16.0f, "cost of visiting one node with all its children");
        v.on_float("pack-cost", pack_cost, 0.0f, 16.0f,
                   "cost of testing one pack of triangles, four or eight");
    }
    Output apply(const Mesh& mesh, std::span<const PrimRef> refs, const Bvh2& input, Task& task) const;
};

}  // namespace boxwood
