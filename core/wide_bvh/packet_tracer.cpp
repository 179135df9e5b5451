#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/wide_bvh/packet_tracer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

#include "core/structure/closest.h"
#include "core/wide_bvh/packet_tests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// No vectors: one by one.
template <uint32_t Width>
void trace_packets(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                   std::span<Hit> hits, const Task& task) {
    bvh.closest_hits(mesh, rays, hits, Mode::Exact, task);
}

#else

/// The nearest hits of a packet's rays so far: as intervals of t as long as floats decide the order, by
/// ClosestHit from the first time they do not.
using ClosestHits = std::optional<ClosestHit<Mode::Exact> >;

template <uint32_t Size>
struct PacketSearch {
    using Pack = TrianglePack<Size>;
    static constexpr uint32_t kPart = PackEdges<Size>::kPart;

    const Ray* rays;
    const Pack* packs;
    PacketFloats limits;                        ///< no hit beyond it counts; upper bound of the best hit's t
    PacketFloats lowers;                        ///< of the best hit's t; -infinity for a ray that is decided
    HWY_ALIGN uint32_t prims[kPacketSize];      ///< kNoIndex for none, and where decided
    HWY_ALIGN uint32_t triangles[kPacketSize];  ///< of the best hit: pack and lane
    float limit;                                ///< the largest of all
    ClosestHits* decided;                       ///< one for each ray; empty but for those of `decided_bits`
    uint32_t decided_bits = 0;

    PacketSearch() = default;  ///< sets nothing
    HWY_INLINE PacketSearch(const Ray* searched, const PacketRays& prepared, const Pack* first_pack,
                            ClosestHits* exact)
        : rays(searched), packs(first_pack), limits(prepared.t_max), decided(exact) {
        const PacketTag d;
        for (uint32_t i = 0; i < kVectors; ++i)
            lowers[i] = hn::Set(d, std::numeric_limits<float>::infinity());
        std::fill_n(prims, kPacketSize, kNoIndex);
        std::fill_n(triangles, kPacketSize, 0u);
        limit = limits.largest();
    }

    /// The first `count` triangles of the part of the pack that begins at lane `first`, one at least.
    /// Whether any ray may have a hit there.
    template <uint32_t Width>
    HWY_INLINE bool test(const PacketRays& ray, const Frustum<Width>& frustum, const Pack& pack,
                         const PackEdges<Size>& edges, uint32_t first, uint32_t count) {
        const PacketTag d;
        uint32_t open[kPart], hit[kPart], any = 0;
        for (uint32_t lane = 0; lane < count; ++lane) {
            open[lane] = hit[lane] = 0;
            const PacketVector bound = hn::Set(d, edges.bounds[lane]);
            for (uint32_t i = 0; i < kVectors; ++i) {
                const EdgeFunctions functions(ray, edges, lane, i);
                const auto missed = functions.is_missed(bound);
                if (HWY_LIKELY(hn::AllTrue(d, missed))) continue;
                const uint32_t all = (1u << kLanes) - 1;
                open[lane] |= (all & ~packet_bits(missed)) << (kLanes * i);
                hit[lane] |= packet_bits(functions.is_hit(bound)) << (kLanes * i);
                any |= 1;
            }
        }
        if (any == 0) return false;
        const PackPlanes<Size> planes(edges, frustum);
        for (uint32_t lane = 0; lane < count; ++lane)
            if (open[lane] != 0) keep(ray, pack, planes, first, lane, open[lane], hit[lane]);
        limit = limits.largest();
        return true;
    }
    HWY_INLINE void keep(const PacketRays& ray, const Pack& pack, const PackPlanes<Size>& planes,
                         uint32_t first, uint32_t lane, uint32_t open, uint32_t hit) {
        const PacketTag d;
        const hn::RebindToUnsigned<PacketTag> du;
        const uint32_t prim = pack.prims[first + lane];
        const uint32_t triangle = static_cast<uint32_t>(&pack - packs) * Size + first + lane;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const uint32_t all = (1u << kLanes) - 1;
            const uint32_t open_here = open >> (kLanes * i) & all, hit_here = hit >> (kLanes * i) & all;
            if (open_here == 0) continue;
            const PlaneInterval t(ray, planes, lane, i);
            const PacketVector lower = t.lower, upper = t.upper;
            const auto is_sure = hn::And(packet_mask(hit_here), t.is_sure);
            const auto is_in_range = hn::And(hn::Ge(lower, ray.t_min[i]), hn::Le(upper, ray.t_max[i]));
            const auto is_nearer = hn::And(is_sure, hn::And(is_in_range, hn::Lt(upper, lowers[i])));
            const auto old_prims = hn::Load(du, prims + kLanes * i);
            const auto is_same = hn::RebindMask(d, hn::Eq(old_prims, hn::Set(du, prim)));
            const auto is_farther = hn::And(
                is_sure, hn::Or(hn::Or(is_same, hn::Gt(lower, limits[i])), hn::Lt(upper, ray.t_min[i])));
            const uint32_t nearer = packet_bits(is_nearer) & open_here;
            uint32_t unknown = open_here & ~nearer & ~packet_bits(is_farther);
            if (nearer != 0) {
                const auto mask = is_nearer;
                const auto mask_u = hn::RebindMask(du, mask);
                limits[i] = hn::IfThenElse(mask, upper, limits[i]);
                lowers[i] = hn::IfThenElse(mask, lower, lowers[i]);
                hn::Store(hn::IfThenElse(mask_u, hn::Set(du, prim), old_prims), du, prims + kLanes * i);
                hn::Store(hn::IfThenElse(mask_u, hn::Set(du, triangle), hn::Load(du, triangles + kLanes * i)),
                          du, triangles + kLanes * i);
            }
            for (; unknown != 0; unknown &= unknown - 1)
                decide(kLanes * i + static_cast<uint32_t>(std::countr_zero(unknown)), pack, first + lane);
        }
    }
    Triangle triangle(uint32_t i) const { return packs[triangles[i] / Size].triangle(triangles[i] % Size); }
    HWY_NOINLINE void decide(uint32_t i, const Pack& pack, uint32_t lane) {
        NoCount count;
        ClosestHits& closest = decided[i];
        if (!closest) {
            closest.emplace(rays[i]);
            if (prims[i] != kNoIndex) closest->test(triangle(i), prims[i], count);
            set(lowers, i, -std::numeric_limits<float>::infinity());
            prims[i] = kNoIndex;
            decided_bits |= 1u << i;
        }
        closest->test(pack.triangle(lane), pack.prims[lane], count);
        const double bound = closest->limit();
        if (bound < double(limit_of(i))) {
            float rounded = static_cast<float>(bound);
            if (double(rounded) < bound)
                rounded = std::nextafter(rounded, std::numeric_limits<float>::infinity());
            set(limits, i, rounded);
        }
    }
    float limit_of(uint32_t i) const {
        HWY_ALIGN float lanes[kLanes];
        hn::Store(limits[i / kLanes], PacketTag(), lanes);
        return lanes[i % kLanes];
    }
    static void set(PacketFloats& floats, uint32_t i, float value) {
        HWY_ALIGN float lanes[kLanes];
        hn::Store(floats[i / kLanes], PacketTag(), lanes);
        lanes[i % kLanes] = value;
        floats[i / kLanes] = hn::Load(PacketTag(), lanes);
    }
    HWY_INLINE void write(const Mesh& mesh, const PacketRays& prepared, Hit* hits) {
        const uint32_t hit = hit_bits();
        HWY_ALIGN float t[kPacketSize];
        uint32_t unknown = hit == 0 ? 0u : hit & ~round_t(prepared, t);
        write_lanes(prepared.members, hit, t, hits);
        unknown = (unknown | decided_bits) & prepared.members;
        for (; HWY_UNLIKELY(unknown != 0); unknown &= unknown - 1) {
            const uint32_t i = static_cast<uint32_t>(std::countr_zero(unknown));
            if (!decided[i]) {
                NoCount count;
                decided[i].emplace(rays[i]);
                decided_bits |= 1u << i;
                decided[i]->test(triangle(i), prims[i], count);
            }
            hits[i] = decided[i]->hit(mesh);
        }
        for (; decided_bits != 0; decided_bits &= decided_bits - 1)
            decided[std::countr_zero(decided_bits)].reset();
    }
    HWY_INLINE uint32_t hit_bits() const {
        const hn::RebindToUnsigned<PacketTag> du;
        uint32_t bits = 0;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const auto is_hit = hn::Ne(hn::Load(du, prims + kLanes * i), hn::Set(du, kNoIndex));
            bits |= packet_bits(hn::RebindMask(PacketTag(), is_hit)) << (kLanes * i);
        }
        return bits;
    }
    HWY_INLINE uint32_t round_t(const PacketRays& prepared, float* t) const {
        PacketTriangles best;
        if (are_same()) {
            best.set_all(packs[triangles[0] / Size], triangles[0] % Size);
        } else {
            for (uint32_t i = 0; i < kPacketSize; ++i)
                best.set(i, packs[triangles[i] / Size], triangles[i] % Size);
        }
        return best.round_t(prepared, t);
    }
    HWY_INLINE bool are_same() const {
        const hn::RebindToUnsigned<PacketTag> du;
        auto same = hn::Eq(hn::Load(du, triangles), hn::Set(du, triangles[0]));
        for (uint32_t i = 1; i < kVectors; ++i)
            same = hn::And(same, hn::Eq(hn::Load(du, triangles + kLanes * i), hn::Set(du, triangles[0])));
        return hn::AllTrue(du, same);
    }
    HWY_INLINE void write_lanes(uint32_t members, uint32_t hit, const float* t, Hit* hits) const {
        static_assert(sizeof(Hit) == 2 * sizeof(float) && offsetof(Hit, prim) == sizeof(float));
        const PacketTag d;
        const hn::RebindToUnsigned<PacketTag> du;
        Hit apart[kPacketSize];
        Hit* const to = members == (1u << kPacketSize) - 1 ? hits : apart;
        for (uint32_t i = 0; i < kVectors; ++i) {
            const PacketVector found =
                hn::IfThenElse(packet_mask(hit >> (kLanes * i)), hn::Load(d, t + kLanes * i),
                               hn::Set(d, std::numeric_limits<float>::infinity()));
            hn::StoreInterleaved2(found, hn::BitCast(d, hn::Load(du, prims + kLanes * i)), d,
                                  &to[kLanes * i].t);
        }
        if (to == hits) return;
        for (; members != 0; members &= members - 1) {
            const int i = std::countr_zero(members);
            hits[i] = apart[i];
        }
    }
};

/// Children to be visited, the next one last: node and lane, with the parameter at which the first ray
/// enters.
template <uint32_t Width>
struct PacketStack {
    static constexpr uint32_t kSize = (WideBvh<Width>::kMaxDepth + 1) * Width;
    uint32_t children[kSize];
    float entries[kSize];
};

/// Adds the children whose boxes the frustum meets to the stack, but for the first in the order of the
/// octant, whose lane is returned; Width if there is none.
template <uint32_t Width>
HWY_INLINE uint32_t push_met(const typename WideBvh<Width>::Node& node, uint32_t index,
                             const Frustum<Width>& frustum, const ChildLanes<Width>& lanes, float limit,
                             PacketStack<Width>& stack, uint32_t& count) {
    using Lanes = ChildLanes<Width>;
    const typename Lanes::D d;
    const typename Lanes::DU du;
    const float* const planes = node.lower[0];
    typename Lanes::V entry[Lanes::kParts], exit[Lanes::kParts];
    uint32_t met = 0;
    for (size_t part = 0; part < Lanes::kParts; ++part) {
        const size_t first = part * hn::MaxLanes(d);
        entry[part] = frustum.entry(planes + first);
        exit[part] = frustum.exit(planes + first, limit);
        met |= mask_bits(d, hn::Le(entry[part], exit[part])) << first;
    }
    if ((met & (met - 1)) == 0) return met == 0 ? Width : static_cast<uint32_t>(std::countr_zero(met));
    if constexpr (Lanes::kHasPush) {
        typename Lanes::VU children[Lanes::kParts];
        for (uint32_t part = 0; part < Lanes::kParts; ++part)
            children[part] = hn::Iota(du, index * Width + part * hn::MaxLanes(d));
        return lanes.push_met(node, entry, exit, children, stack.entries, stack.children, count);
    } else {
        HWY_ALIGN float entries[Width];
        for (size_t part = 0; part < Lanes::kParts; ++part)
            hn::Store(entry[part], d, entries + part * hn::MaxLanes(d));
        lanes.for_each_back_to_front(node, met, [&](uint32_t lane) {
            stack.children[count] = index * Width + lane;
            stack.entries[count++] = entries[lane];
        });
        return stack.children[--count] % Width;
    }
}

/// Packets that fit each other, searched for as one: a node's boxes are tested, and a pack is prepared, once
/// for all of them. Neighbouring packets meet almost the same nodes.
template <uint32_t Width>
class PacketGroup {
public:
    using Pack = typename WideBvh<Width>::Pack;

    PacketGroup(const WideBvh<Width>& bvh, const Mesh& mesh)
        : bvh_(bvh), mesh_(mesh), scene_(bvh.nodes[0].bounds()) {}

    /// The bits of those of 16 rays that can be a packet, of those whose bits are set in `wanted`; 0 where
    /// the first of these cannot. They are added, to be searched for now or later, unless they are few.
    HWY_INLINE uint32_t add(const Ray* rays, const RayLanes& lanes, uint32_t wanted, Hit* hits,
                            bool& is_added) {
        if (count_ == kMost) search();
        PacketRays& packet = *new (&rays_[count_]) PacketRays(rays, lanes, scene_, wanted);
        is_added = std::popcount(packet.members) > kFew;
        if (!is_added) return packet.members;
        const uint32_t members = packet.members;
        if (count_ > 0 && !packet.fits(rays_[0])) {
            const PacketRays copy = packet;
            search();
            rays_[0] = copy;
        }
        new (&searches_[count_])
            PacketSearch<Pack::kSize>(rays, rays_[count_], bvh_.packs.data(), decided_[count_]);
        hits_[count_++] = hits;
        return members;
    }
    /// Finds the hits of all that were added.
    HWY_NOINLINE void search() {
        if (count_ == 0) return;
        const Frustum<Width> frustum(std::span(rays_, count_));
        set_limit();
        search(frustum);
        for (uint32_t i = 0; i < count_; ++i) searches_[i].write(mesh_, rays_[i], hits_[i]);
        count_ = 0;
    }

private:
    static constexpr uint32_t kMost = 4;
    static constexpr int kFew = 3;  ///< rays that are better cast one by one

    HWY_INLINE void search(const Frustum<Width>& frustum) {
        const auto* const nodes = bvh_.nodes.data();
        const ChildLanes<Width> lanes(rays_[0].octant);
        PacketStack<Width> stack;
        uint32_t count = 0, index = 0;
        while (true) {
            uint32_t lane = push_met<Width>(nodes[index], index, frustum, lanes, limit_, stack, count);
            while (true) {
                if (lane != Width) {
                    const auto& node = nodes[index];
                    const WideChild child = node.children[lane];
                    if (!child.is_leaf()) {
                        index = child.node();
                        break;
                    }
                    const uint32_t met = meeting(node.lower[0], frustum.at, lane);
                    if (met != 0) {
                        const Pack* const first = bvh_.packs.data() + child.first_pack();
                        test(frustum, std::span(first, child.pack_count()), met);
                    }
                }
                do {
                    if (count == 0) return;
                    --count;
                } while (stack.entries[count] > limit_);
                index = stack.children[count] / Width;
                lane = stack.children[count] % Width;
            }
        }
    }
    /// Bit i: packet i meets the box.
    HWY_INLINE uint32_t meeting(const float* planes, const Planes<Width>& at, uint32_t lane) const {
        uint32_t met = 0;
        for (uint32_t i = 0; i < count_; ++i)
            met |= uint32_t{rays_[i].any_meets(planes, at, lane, searches_[i].limits)} << i;
        return met;
    }
    HWY_INLINE void test(const Frustum<Width>& frustum, std::span<const Pack> leaf, uint32_t met) {
        constexpr uint32_t kPart = PackEdges<Pack::kSize>::kPart;
        bool is_any_nearer = false;
        for (const Pack& pack : leaf) {
            const uint32_t count = count_of(pack);
            for (uint32_t first = 0; first < count; first += kPart) {
                const PackEdges<Pack::kSize> edges(pack, first, frustum);
                for (uint32_t packets = met; packets != 0; packets &= packets - 1) {
                    const int i = std::countr_zero(packets);
                    is_any_nearer |= searches_[i].test(rays_[i], frustum, pack, edges, first,
                                                       std::min(kPart, count - first));
                }
            }
        }
        if (is_any_nearer) set_limit();
    }
    /// Lanes before the first of those that repeat the last one, and one of these.
    static HWY_INLINE uint32_t count_of(const Pack& pack) {
        const hn::CappedTag<uint32_t, Pack::kSize> du;
        if constexpr (hn::MaxLanes(du) < Pack::kSize) {
            return pack.count();
        } else {
            const auto is_last = hn::Eq(hn::LoadU(du, pack.prims), hn::Set(du, pack.prims[Pack::kSize - 1]));
            return static_cast<uint32_t>(std::countr_zero(mask_bits(du, is_last))) + 1;
        }
    }
    HWY_INLINE void set_limit() {
        limit_ = searches_[0].limit;
        for (uint32_t i = 1; i < count_; ++i) limit_ = std::max(limit_, searches_[i].limit);
    }

    const WideBvh<Width>& bvh_;
    const Mesh& mesh_;
    const FloatScene scene_;
    uint32_t count_ = 0;
    float limit_ = 0.0f;  ///< the largest of all packets
    PacketRays rays_[kMost];
    PacketSearch<Pack::kSize> searches_[kMost];
    Hit* hits_[kMost];
    ClosestHits decided_[kMost][kPacketSize];
};

constexpr size_t kStopInterval = 4;  ///< packets from one look at task.stop to the next

template <uint32_t Width>
HWY_NOINLINE void trace_packets(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                                std::span<Hit> hits, const Task& task) {
    size_t begin = 0;
    if (!bvh.nodes.empty()) {
        PacketGroup<Width> group(bvh, mesh);
        for (; begin + kPacketSize <= rays.size(); begin += kPacketSize) {
            if (begin / kPacketSize % kStopInterval == 0 && task.stopped()) return;
            const Ray* const first = rays.data() + begin;
            const RayLanes lanes(first);
            uint32_t left = (1u << kPacketSize) - 1;
            while (left != 0) {
                bool is_added;
                uint32_t members = group.add(first, lanes, left, hits.data() + begin, is_added);
                if (members == 0) members = left & (0u - left);
                left &= ~members;
                if (HWY_LIKELY(is_added)) continue;
                for (; members != 0; members &= members - 1) {
                    const size_t i = begin + static_cast<size_t>(std::countr_zero(members));
                    bvh.closest_hits(mesh, rays.subspan(i, 1), hits.subspan(i, 1), Mode::Exact, task);
                }
            }
        }
        group.search();
    }
    bvh.closest_hits(mesh, rays.subspan(begin), hits.subspan(begin), Mode::Exact, task);
}

#endif

// Highway exports plain functions, not templates: one for each width.
void trace_packets4(const WideBvh<4>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                    const Task& task) {
    trace_packets(bvh, mesh, rays, hits, task);
}
void trace_packets8(const WideBvh<8>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                    const Task& task) {
    trace_packets(bvh, mesh, rays, hits, task);
}
void trace_packets16(const WideBvh<16>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                     const Task& task) {
    trace_packets(bvh, mesh, rays, hits, task);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(trace_packets4);
HWY_EXPORT(trace_packets8);
HWY_EXPORT(trace_packets16);

template <>
void WideBvh<4>::closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                       Mode mode, const Task& task) const {
    if (mode == Mode::Fast) return closest_hits(mesh, rays, hits, mode, task);
    HWY_DYNAMIC_DISPATCH(trace_packets4)(*this, mesh, rays, hits, task);
}
template <>
void WideBvh<8>::closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                       Mode mode, const Task& task) const {
    if (mode == Mode::Fast) return closest_hits(mesh, rays, hits, mode, task);
    HWY_DYNAMIC_DISPATCH(trace_packets8)(*this, mesh, rays, hits, task);
}
template <>
void WideBvh<16>::closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                        Mode mode, const Task& task) const {
    if (mode == Mode::Fast) return closest_hits(mesh, rays, hits, mode, task);
    HWY_DYNAMIC_DISPATCH(trace_packets16)(*this, mesh, rays, hits, task);
}

}  // namespace boxwood
#endif
