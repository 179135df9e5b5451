#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>
#include <vector>

#include "core/base/array.h"
#include "core/structure/structure.h"

namespace boxwood {

/// Triangles, structure of arrays: coordinate `axis` of corner `corner` of triangle i is
/// corners[corner][axis][i]. Lanes without a triangle repeat the last one, whose primitive they carry too: a
/// second test of it changes nothing.
template <uint32_t Size>
struct alignas(32) TrianglePack {
    static constexpr uint32_t kSize = Size;
    float corners[3][3][Size];
    uint32_t prims[Size];

    Triangle triangle(uint32_t lane) const { return {corner(0, lane), corner(1, lane), corner(2, lane)}; }
    Vec3 corner(uint32_t i, uint32_t lane) const {
        return {corners[i][0][lane], corners[i][1][lane], corners[i][2][lane]};
    }
    /// Triangles that are no repetition; they stand in the first lanes.
    uint32_t count() const {
        uint32_t n = 1;
        while (n < Size && prims[n] != prims[n - 1]) ++n;
        return n;
    }
    /// Packs that hold so many triangles.
    static constexpr uint32_t packs_for(uint32_t triangle_count) {
        return (triangle_count + Size - 1) / Size;
    }
};
static_assert(sizeof(TrianglePack<4>) == 160 && sizeof(TrianglePack<8>) == 320);

/// What a child of a wide node is, in 32 bits: an inner node, or a leaf of 1 to 31 consecutive packs, or
/// nothing. Larger leaves of the input become several children with the same box.
struct WideChild {
    static constexpr uint32_t kLeafBit = 1u << 31, kFirstBits = 26, kMostPacks = 31;
    uint32_t bits = kNoIndex;

    static WideChild inner(uint32_t node) { return {node}; }
    static WideChild leaf(uint32_t first_pack, uint32_t pack_count) {
        return {kLeafBit | (pack_count - 1) << kFirstBits | first_pack};
    }
    bool is_empty() const { return bits == kNoIndex; }
    bool is_inner() const { return (bits & kLeafBit) == 0; }
    bool is_leaf() const { return !is_inner() && !is_empty(); }
    uint32_t node() const { return bits; }
    uint32_t first_pack() const { return bits & ((1u << kFirstBits) - 1); }
    uint32_t pack_count() const { return ((bits >> kFirstBits) & 31) + 1; }
    bool operator==(const WideChild&) const = default;
};

/// Bounding volume hierarchy whose nodes have up to `Width` children, their boxes as a structure of arrays.
/// Dammertz, Hanika, Keller, "Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of Incoherent
/// Rays", EGSR 2008 (QBVH); sixteen children as in Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008.
/// Nodes in depth-first order, the root first; an empty mesh has no node. Leaves in the order of the nodes
/// and, in a node, of the children; the packs of one stand together, those of a collapse in the order of the
/// leaves, those of Preview and Balanced depth first.
template <uint32_t Width>
struct WideBvh {
    static_assert(Width == 4 || Width == 8 || Width == 16);
    static constexpr const char* kFamily = Width == 4   ? "4-wide BVH"
                                           : Width == 8 ? "8-wide BVH"
                                                        : "16-wide BVH";
    static constexpr uint32_t kWidth = Width;
    static constexpr uint32_t kMaxDepth = 64;  ///< levels of nodes below the root at most
    /// As many triangles as a node has children, so that vectors of one length test both; at most eight, as
    /// in most of sixteen places there would be a repetition.
    using Pack = TrianglePack<std::min(Width, 8u)>;
    /// The lanes of all children in some order, kLaneBits each, the first in the lowest bits.
    using Order = std::conditional_t<Width == 4, uint8_t, std::conditional_t<Width == 8, uint32_t, uint64_t>>;
    static constexpr uint32_t kLaneBits = std::bit_width(Width - 1);

    /// Children stand in the first lanes; an empty lane has a box that no ray meets: lower = infinity, upper
    /// = -infinity, its child is empty.
    struct alignas(64) Node {
        float lower[3][Width], upper[3][Width];
        WideChild children[Width];
        /// For the ray octants 0 to 3 (bit axis set: the direction's sign bit is), the lanes front to back.
        /// Octant 7 - i is the opposite one of i: back to front.
        std::array<Order, 4> orders;
        uint32_t first_leaf;  ///< number of its first leaf child among all leaves, in their order

        Box bounds(uint32_t lane) const {
            return {{lower[0][lane], lower[1][lane], lower[2][lane]},
                    {upper[0][lane], upper[1][lane], upper[2][lane]}};
        }
        /// Around all its children.
        Box bounds() const {
            Box box;
            for (uint32_t lane = 0; lane < Width; ++lane) box.extend(bounds(lane));
            return box;
        }
        /// Lane at `rank` (0: nearest) of the order for an octant.
        uint32_t lane_at(uint32_t octant, uint32_t rank) const {
            const bool is_opposite = octant >= 4;
            const Order order = orders[is_opposite ? 7 - octant : octant];
            const uint32_t place = is_opposite ? Width - 1 - rank : rank;
            return static_cast<uint32_t>(order >> (kLaneBits * place)) & (Width - 1);
        }
    };
    static_assert(sizeof(Node) == 32 * Width);

    Array<Node> nodes;
    Array<Pack> packs;
    uint32_t leaf_count = 0;

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    /// For whole batches, the same answers as closest_hit by SIMD; see float_bounds.h. hits.size() ==
    /// rays.size(). After a stop what is not yet traced is a miss, and not to be read.
    void closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                      const Task& task) const;
    /// As closest_hits; by packets of 16 rays where these share their origin, up to four of them searched for
    /// as one. See packet_bounds.h.
    void closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                               const Task& task) const;
    void any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded, Mode mode,
                  const Task& task) const;
    /// Nodes first, as they stand; then the leaves in their order: leaf i is node nodes.size() + i.
    NodeList list_nodes() const;
    size_t byte_count() const { return nodes.size() * sizeof(Node) + packs.size() * sizeof(Pack); }
};

}  // namespace boxwood
