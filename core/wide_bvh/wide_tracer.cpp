#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/wide_bvh/wide_tracer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/wide_bvh/float_tests-inl.h"
#include "core/wide_bvh/plain_hits.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

// No vectors: the plain tracer.
template <Mode mode, uint32_t Width>
void closest_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                     std::span<Hit> hits, const Task& task) {
    for (size_t i = 0; i < rays.size() && !task.stopped(); ++i)
        hits[i] = plain_closest_hit<mode>(bvh, mesh, rays[i], task);
}
template <Mode mode, uint32_t Width>
void any_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                 std::span<uint8_t> occluded, const Task& task) {
    for (size_t i = 0; i < rays.size() && !task.stopped(); ++i)
        occluded[i] = plain_any_hit<mode>(bvh, mesh, rays[i], task) ? 1 : 0;
}

#else

/// The nearest hit so far: as an interval of t as long as floats decide the order, by ClosestHit from the
/// first time they do not.
template <Mode mode>
struct Search {
    const Ray& ray;
    float limit;  ///< no hit beyond it counts
    const TrianglePack* pack = nullptr;
    uint32_t lane = 0, prim = kNoIndex;
    float lower = 0.0f;  ///< of the best hit's t; its upper bound is `limit`
    std::optional<ClosestHit<mode> > decided;

    HWY_INLINE explicit Search(const Ray& searched) : ray(searched), limit(searched.t_max) {}

    /// Takes the lanes of a pack that are open.
    HWY_INLINE void keep(const TrianglePack& hit_pack, const PackHits& hits) {
        for (uint32_t open = hits.open; open != 0; open &= open - 1) {
            const uint32_t i = static_cast<uint32_t>(std::countr_zero(open));
            if ((hits.sure >> i & 1) == 0 || decided) {
                decide(hit_pack, i);
                continue;
            }
            const float t_lower = hits.lower[i], t_upper = hits.upper[i];
            if (t_upper < ray.t_min || hit_pack.prims[i] == prim) continue;
            const bool is_in_range = t_lower >= ray.t_min && t_upper <= ray.t_max;
            if (is_in_range && (prim == kNoIndex || t_upper < lower)) {
                pack = &hit_pack;
                lane = i;
                prim = hit_pack.prims[i];
                lower = t_lower;
                limit = t_upper;
            } else if (!(t_lower > limit)) {
                decide(hit_pack, i);
            }
        }
    }
    HWY_NOINLINE void decide(const TrianglePack& hit_pack, uint32_t i) {
        NoCount count;
        if (!decided) {
            decided.emplace(ray);
            if (prim != kNoIndex) decided->test(pack->triangle(lane), prim, count);
        }
        decided->test(hit_pack.triangle(i), hit_pack.prims[i], count);
        const double bound = decided->limit();
        if (bound < double(limit)) {
            limit = static_cast<float>(bound);
            if (double(limit) < bound) limit = std::nextafter(limit, std::numeric_limits<float>::infinity());
        }
    }
    HWY_INLINE Hit hit(const Mesh& mesh) {
        if (!decided) {
            if (prim == kNoIndex) return {};
            if constexpr (mode == Mode::Exact) {
                const Interval t = interval_of_t<FilterBounds>(ray, pack->triangle(lane));
                const float t_lower = static_cast<float>(t.lower), t_upper = static_cast<float>(t.upper);
                if (t_lower == t_upper) return {t_upper, prim};
            }
            NoCount count;
            decided.emplace(ray);
            decided->test(pack->triangle(lane), prim, count);
        }
        return decided->hit(mesh);
    }
};

/// Whether anything lies on the ray.
template <Mode mode>
struct Occlusion {
    const Ray& ray;
    std::optional<ClosestHit<mode> > decided;

    HWY_INLINE explicit Occlusion(const Ray& searched) : ray(searched) {}

    HWY_INLINE bool is_hit(const TrianglePack& pack, const PackHits& hits) {
        for (uint32_t open = hits.open; open != 0; open &= open - 1) {
            const uint32_t i = static_cast<uint32_t>(std::countr_zero(open));
            if ((hits.sure >> i & 1) != 0) {
                if (hits.lower[i] >= ray.t_min && hits.upper[i] <= ray.t_max) return true;
                if (hits.upper[i] < ray.t_min) continue;
            }
            if (decide(pack, i)) return true;
        }
        return false;
    }
    HWY_NOINLINE bool decide(const TrianglePack& pack, uint32_t i) {
        NoCount count;
        if (!decided) decided.emplace(ray);
        return decided->occludes(pack.triangle(i), count);
    }
};

/// Children to be visited, the next one last, with the parameters at which the ray enters them. A node adds
/// at most its width, less the one that is visited at once; vectors are written whole.
template <uint32_t Width>
struct Stack {
    static constexpr uint32_t kSize = (WideBvh<Width>::kMaxDepth + 1) * (Width - 1) + Width;
    uint32_t children[kSize];
    float entries[kSize];
};

/// Adds the children whose boxes the ray meets to the stack, but for the nearest in the order of the ray's
/// octant, which is returned; empty if there is none.
template <uint32_t Width>
HWY_INLINE WideChild push_children(const typename WideBvh<Width>::Node& node, const BoxRay<Width>& ray,
                                   uint32_t octant, float limit, Stack<Width>& stack, uint32_t& count) {
    const hn::CappedTag<float, Width> d;
    using V = hn::Vec<decltype(d)>;
    const float* const planes = node.lower[0];
    if constexpr (hn::MaxLanes(d) == Width) {
        const hn::RebindToUnsigned<decltype(d)> du;
        const V entry = ray.entry(planes);
        const auto is_met = hn::Le(entry, ray.exit(planes, limit));
        const uint32_t met = bits_of(d, is_met);
        if ((met & (met - 1)) == 0) return met == 0 ? WideChild{} : node.children[std::countr_zero(met)];
        // The lanes back to front.
        constexpr uint32_t kBits = Width == 4 ? 2 : 3;
        uint32_t order;
        std::memcpy(&order, &node.order[octant * kBits * Width / 8], sizeof(order));
        HWY_ALIGN static constexpr uint32_t kShifts[8] = {7 * kBits, 6 * kBits, 5 * kBits, 4 * kBits,
                                                          3 * kBits, 2 * kBits, kBits,     0};
        const auto lanes =
            hn::And(hn::Shr(hn::Set(du, order), hn::LoadU(du, kShifts + 8 - Width)), hn::Set(du, Width - 1));
        const auto indices = hn::IndicesFromVec(d, lanes);
        const V infinity = hn::Set(d, std::numeric_limits<float>::infinity());
        const V entries = hn::TableLookupLanes(hn::IfThenElse(is_met, entry, infinity), indices);
        const auto children =
            hn::TableLookupLanes(hn::BitCast(d, hn::Load(du, &node.children[0].bits)), indices);
        const auto is_pushed = hn::Lt(entries, infinity);
        hn::StoreU(hn::Compress(entries, is_pushed), d, stack.entries + count);
        hn::StoreU(hn::BitCast(du, hn::Compress(children, is_pushed)), du, stack.children + count);
        count += static_cast<uint32_t>(std::popcount(met)) - 1;
        return {stack.children[count]};
    } else {
        HWY_ALIGN float entries[Width];
        uint32_t met = 0;
        for (size_t first = 0; first < Width; first += hn::Lanes(d)) {
            const V entry = ray.entry(planes + first);
            hn::Store(entry, d, entries + first);
            met |= bits_of(d, hn::Le(entry, ray.exit(planes + first, limit))) << first;
        }
        for (uint32_t rank = Width; met != 0; --rank) {
            const uint32_t lane = node.lane_at(octant, rank - 1);
            if ((met >> lane & 1) == 0) continue;
            met &= ~(1u << lane);
            if (met == 0) return node.children[lane];
            stack.children[count] = node.children[lane].bits;
            stack.entries[count++] = entries[lane];
        }
        return {};
    }
}

/// The same in any order, without parameters: any hit will do.
template <uint32_t Width>
HWY_INLINE WideChild push_unordered(const typename WideBvh<Width>::Node& node, const BoxRay<Width>& ray,
                                    float limit, uint32_t* stack, uint32_t& count) {
    const hn::CappedTag<float, Width> d;
    const float* const planes = node.lower[0];
    if constexpr (hn::MaxLanes(d) == Width) {
        const hn::RebindToUnsigned<decltype(d)> du;
        const auto is_met = hn::Le(ray.entry(planes), ray.exit(planes, limit));
        const uint32_t met = bits_of(d, is_met);
        if (met == 0) return {};
        if ((met & (met - 1)) == 0) return node.children[std::countr_zero(met)];
        const auto children = hn::Load(du, &node.children[0].bits);
        hn::StoreU(hn::Compress(children, hn::RebindMask(du, is_met)), du, stack + count);
        count += static_cast<uint32_t>(std::popcount(met)) - 1;
        return {stack[count]};
    } else {
        uint32_t met = 0;
        for (size_t first = 0; first < Width; first += hn::Lanes(d))
            met |= bits_of(d, hn::Le(ray.entry(planes + first), ray.exit(planes + first, limit))) << first;
        if (met == 0) return {};
        for (; (met & (met - 1)) != 0; met &= met - 1)
            stack[count++] = node.children[std::countr_zero(met)].bits;
        return node.children[std::countr_zero(met)];
    }
}

template <Mode mode, uint32_t Width>
HWY_INLINE void find_closest(const WideBvh<Width>& bvh, const FloatRay<mode>& ray, Search<mode>& search) {
    const BoxRay<Width> box_ray(ray);
    const auto* const nodes = bvh.nodes.data();
    const TrianglePack* const packs = bvh.packs.data();
    const uint32_t octant = ray.octant;
    Stack<Width> stack;
    uint32_t count = 0;
    WideChild child = WideChild::inner(0);
    while (true) {
        while (!child.is_leaf()) {
            child = push_children<Width>(nodes[child.node()], box_ray, octant, search.limit, stack, count);
            if (child.is_empty()) break;
        }
        if (!child.is_empty()) {
            const TrianglePack* pack = packs + child.first_pack();
            const TrianglePack* const end = pack + child.pack_count();
            for (; pack != end; ++pack) {
                PackHits hits;
                if (test_pack(*pack, ray, search.limit, hits)) search.keep(*pack, hits);
            }
        }
        do {
            if (count == 0) return;
            --count;
        } while (stack.entries[count] > search.limit);
        child = {stack.children[count]};
    }
}

template <Mode mode, uint32_t Width>
HWY_INLINE bool find_any(const WideBvh<Width>& bvh, const FloatRay<mode>& ray, Occlusion<mode>& occlusion) {
    const BoxRay<Width> box_ray(ray);
    const auto* const nodes = bvh.nodes.data();
    const TrianglePack* const packs = bvh.packs.data();
    const float limit = ray.t_max;
    uint32_t stack[Stack<Width>::kSize];
    uint32_t count = 0;
    WideChild child = WideChild::inner(0);
    while (true) {
        while (!child.is_leaf()) {
            child = push_unordered<Width>(nodes[child.node()], box_ray, limit, stack, count);
            if (child.is_empty()) break;
        }
        if (!child.is_empty()) {
            const TrianglePack* pack = packs + child.first_pack();
            const TrianglePack* const end = pack + child.pack_count();
            for (; pack != end; ++pack) {
                PackHits hits;
                if (test_pack(*pack, ray, limit, hits) && occlusion.is_hit(*pack, hits)) return true;
            }
        }
        if (count == 0) return false;
        child = {stack[--count]};
    }
}

constexpr size_t kStopInterval = 64;  ///< rays from one look at task.stop to the next

template <Mode mode, uint32_t Width>
HWY_NOINLINE void closest_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                                  std::span<Hit> hits, const Task& task) {
    std::ranges::fill(hits, Hit{});
    if (bvh.nodes.empty()) return;
    const FloatScene scene(bvh.nodes[0].bounds());
    for (size_t i = 0; i < rays.size(); ++i) {
        if (i % kStopInterval == 0 && task.stopped()) return;
        const FloatRay<mode> ray(rays[i], scene);
        if (HWY_LIKELY(ray.is_usable)) {
            Search<mode> search(rays[i]);
            find_closest<mode, Width>(bvh, ray, search);
            hits[i] = search.hit(mesh);
        } else {
            hits[i] = plain_closest_hit<mode>(bvh, mesh, rays[i], task);
        }
    }
}

template <Mode mode, uint32_t Width>
HWY_NOINLINE void any_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                              std::span<uint8_t> occluded, const Task& task) {
    std::ranges::fill(occluded, uint8_t{0});
    if (bvh.nodes.empty()) return;
    const FloatScene scene(bvh.nodes[0].bounds());
    for (size_t i = 0; i < rays.size(); ++i) {
        if (i % kStopInterval == 0 && task.stopped()) return;
        const FloatRay<mode> ray(rays[i], scene);
        if (HWY_LIKELY(ray.is_usable)) {
            Occlusion<mode> occlusion(rays[i]);
            occluded[i] = find_any<mode, Width>(bvh, ray, occlusion) ? 1 : 0;
        } else {
            occluded[i] = plain_any_hit<mode>(bvh, mesh, rays[i], task) ? 1 : 0;
        }
    }
}

#endif

// Highway exports plain functions, not templates: one for each width.
void closest_hits4(const WideBvh<4>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                   Mode mode, const Task& task) {
    mode == Mode::Exact ? closest_hits_in<Mode::Exact>(bvh, mesh, rays, hits, task)
                        : closest_hits_in<Mode::Fast>(bvh, mesh, rays, hits, task);
}
void closest_hits8(const WideBvh<8>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                   Mode mode, const Task& task) {
    mode == Mode::Exact ? closest_hits_in<Mode::Exact>(bvh, mesh, rays, hits, task)
                        : closest_hits_in<Mode::Fast>(bvh, mesh, rays, hits, task);
}
void any_hits4(const WideBvh<4>& bvh, const Mesh& mesh, std::span<const Ray> rays,
               std::span<uint8_t> occluded, Mode mode, const Task& task) {
    mode == Mode::Exact ? any_hits_in<Mode::Exact>(bvh, mesh, rays, occluded, task)
                        : any_hits_in<Mode::Fast>(bvh, mesh, rays, occluded, task);
}
void any_hits8(const WideBvh<8>& bvh, const Mesh& mesh, std::span<const Ray> rays,
               std::span<uint8_t> occluded, Mode mode, const Task& task) {
    mode == Mode::Exact ? any_hits_in<Mode::Exact>(bvh, mesh, rays, occluded, task)
                        : any_hits_in<Mode::Fast>(bvh, mesh, rays, occluded, task);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(closest_hits4);
HWY_EXPORT(closest_hits8);
HWY_EXPORT(any_hits4);
HWY_EXPORT(any_hits8);

template <>
void WideBvh<4>::closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                              const Task& task) const {
    HWY_DYNAMIC_DISPATCH(closest_hits4)(*this, mesh, rays, hits, mode, task);
}
template <>
void WideBvh<8>::closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                              const Task& task) const {
    HWY_DYNAMIC_DISPATCH(closest_hits8)(*this, mesh, rays, hits, mode, task);
}
template <>
void WideBvh<4>::any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded, Mode mode,
                          const Task& task) const {
    HWY_DYNAMIC_DISPATCH(any_hits4)(*this, mesh, rays, occluded, mode, task);
}
template <>
void WideBvh<8>::any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded, Mode mode,
                          const Task& task) const {
    HWY_DYNAMIC_DISPATCH(any_hits8)(*this, mesh, rays, occluded, mode, task);
}

}  // namespace boxwood
#endif
