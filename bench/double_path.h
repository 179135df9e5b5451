#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/base/ray.h"
#include "core/scene/mesh.h"
#include "core/structure/node_list.h"

namespace boxwood::bench {

/// What a tracer in plain double precision does over the boxes of a structure: Moeller, Trumbore, "Fast,
/// Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997, and slabs, without error bounds or an exact
/// case. A contestant of the benchmarks, no part of the program's answers.
class DoubleTracer {
public:
    /// Nothing for nodes of more than kMaxChildren children, such as a grid: they need a traversal of their
    /// own.
    static std::optional<DoubleTracer> over(const NodeList& list);

    /// Nearest hit of each ray; hits.size() == rays.size(). A ray that is not valid misses.
    void closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits) const;
    /// The same, counted.
    void closest_hits_counted(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                              std::span<Count> counts) const;
    size_t byte_count() const { return nodes_.size() * sizeof(Node) + prims_.size() * sizeof(uint32_t); }

    static constexpr uint32_t kMaxChildren = 16;

private:
    /// Children are adjacent.
    struct Node {
        Vec3 lower;
        uint32_t first;  ///< inner: its first child; leaf: its first entry of prims_
        Vec3 upper;
        uint32_t count;  ///< children or primitives, with kLeafBit
    };
    static constexpr uint32_t kLeafBit = uint32_t{1} << 31;

    struct StackEntry {
        uint32_t node;
        double entry;
    };

    template <class Counter>
    Hit closest_hit(const Mesh& mesh, const Ray& ray, std::vector<StackEntry>& stack, Counter& count) const;

    std::vector<Node> nodes_;
    std::vector<uint32_t> prims_;
};

}  // namespace boxwood::bench
