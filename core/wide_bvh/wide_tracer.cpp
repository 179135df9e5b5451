#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/wide_bvh/wide_tracer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <hwy/cache_control.h>

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

/// The nearest hits of some rays, each known for sure, whose t is still to be computed: that is done for as
/// many as a vector has lanes.
template <Mode mode, uint32_t Size>
class SureHits {
public:
    /// At most FloatRays::kCount, between two calls of write.
    HWY_INLINE void add(const Ray& ray, const TrianglePack<Size>& pack, uint32_t lane, Hit& hit) {
        for (int axis = 0; axis < 3; ++axis) {
            origin_[axis][count_] = ray.origin[axis];
            direction_[axis][count_] = ray.direction[axis];
            for (int corner = 0; corner < 3; ++corner)
                corners_[corner][axis][count_] = pack.corners[corner][axis][lane];
        }
        hit.prim = pack.prims[lane];
        found_[count_++] = {&ray, &hit};
    }
    /// Sets the t of all that were added. What double leaves open goes to ClosestHit, in fast mode
    /// everything.
    HWY_INLINE void write(const Mesh& mesh) {
        if constexpr (mode == Mode::Exact) {
            const size_t lanes = hn::Lanes(D());
            for (size_t i = 0; i < count_; i += lanes) set_t(i, std::min(lanes, count_ - i), mesh);
        } else {
            for (size_t i = 0; i < count_; ++i) decide(i, mesh);
        }
        count_ = 0;
    }

private:
    using D = hn::CappedTag<double, 8>;
    using V = hn::Vec<D>;
    using DF = hn::Rebind<float, D>;
    static constexpr size_t kCount = FloatRays<mode>::kCount;
    struct Found {
        const Ray* ray;
        Hit* hit;
    };

    /// interval_of_t of filter.h, with its bounds; both ends rounded to the same float are the answer.
    HWY_INLINE void set_t(size_t first, size_t count, const Mesh& mesh) {
        const D d;
        V a[3], e1[3], e2[3], dir[3];
        for (int axis = 0; axis < 3; ++axis) {
            const V corner = load(corners_[0][axis], first);
            a[axis] = hn::Sub(corner, load(origin_[axis], first));
            e1[axis] = hn::Sub(load(corners_[1][axis], first), corner);
            e2[axis] = hn::Sub(load(corners_[2][axis], first), corner);
            dir[axis] = load(direction_[axis], first);
        }
        V numerator = hn::Zero(d), denominator = numerator, numerator_size = numerator,
          denominator_size = numerator;
        for (int axis = 0; axis < 3; ++axis) {
            const int next = (axis + 1) % 3, last = (axis + 2) % 3;
            const V p = hn::Mul(e1[next], e2[last]), q = hn::Mul(e1[last], e2[next]);
            const V n = hn::Sub(p, q), n_size = hn::Add(hn::Abs(p), hn::Abs(q));
            numerator = hn::Add(numerator, hn::Mul(a[axis], n));
            denominator = hn::Add(denominator, hn::Mul(dir[axis], n));
            numerator_size = hn::Add(numerator_size, hn::Mul(hn::Abs(a[axis]), n_size));
            denominator_size = hn::Add(denominator_size, hn::Mul(hn::Abs(dir[axis]), n_size));
        }
        constexpr double kUnit = FilterBounds::kTermUnit;
        const V numerator_error = hn::Mul(hn::Set(d, 8.0 * kUnit), numerator_size);
        const V denominator_error = hn::Mul(hn::Set(d, 7.0 * kUnit), denominator_size);
        const V rest = hn::Sub(hn::Abs(denominator), denominator_error);
        const V t = hn::Div(numerator, denominator), t_size = hn::Abs(t);
        const V quotient = hn::Div(hn::Add(numerator_error, hn::Mul(t_size, denominator_error)), rest);
        const V error =
            hn::Add(hn::Mul(quotient, hn::Set(d, 1.0 + 0x1p-40)), hn::Mul(hn::Set(d, 2.0 * kUnit), t_size));
        const DF df;
        const auto lower = hn::DemoteTo(df, hn::Sub(t, error)), upper = hn::DemoteTo(df, hn::Add(t, error));
        HWY_ALIGN float lowers[8], uppers[8];
        HWY_ALIGN double rests[8];
        hn::Store(lower, df, lowers);
        hn::Store(upper, df, uppers);
        hn::Store(rest, d, rests);
        for (size_t i = 0; i < count; ++i) {
            if (HWY_LIKELY(rests[i] > 0.0 && lowers[i] == uppers[i])) {
                found_[first + i].hit->t = uppers[i];
            } else {
                decide(first + i, mesh);
            }
        }
    }
    HWY_INLINE V load(const float* from, size_t first) const {
        return hn::PromoteTo(D(), hn::LoadU(DF(), from + first));
    }
    HWY_NOINLINE void decide(size_t i, const Mesh& mesh) {
        NoCount count;
        ClosestHit<mode> closest(*found_[i].ray);
        const uint32_t prim = found_[i].hit->prim;
        closest.test(mesh.triangle(prim), prim, count);
        *found_[i].hit = closest.hit(mesh);
    }

    size_t count_ = 0;
    HWY_ALIGN float origin_[3][kCount], direction_[3][kCount], corners_[3][3][kCount];
    Found found_[kCount];
};

/// The nearest hit so far: as an interval of t as long as floats decide the order, by ClosestHit from the
/// first time they do not.
template <Mode mode, uint32_t Size>
struct Search {
    using Pack = TrianglePack<Size>;

    const Ray& ray;
    float limit;  ///< no hit beyond it counts
    const Pack* pack = nullptr;
    uint32_t lane = 0, prim = kNoIndex;
    float lower = 0.0f;  ///< of the best hit's t; its upper bound is `limit`
    std::optional<ClosestHit<mode> > decided;

    HWY_INLINE explicit Search(const Ray& searched) : ray(searched), limit(searched.t_max) {}

    /// Takes the lanes of a pack that are open.
    HWY_INLINE void keep(const Pack& hit_pack, const PackHits<Size>& hits) {
        for (uint32_t open = hits.open; open != 0; open &= open - 1) {
            const uint32_t i = static_cast<uint32_t>(std::countr_zero(open));
            if ((hits.sure >> i & 1) == 0 || decided) {
                decide(hit_pack, i);
                continue;
            }
            const float t_lower = hits.lower[i], t_upper = hits.upper[i];
            if (hit_pack.prims[i] == prim) continue;
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
    HWY_NOINLINE void decide(const Pack& hit_pack, uint32_t i) {
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
    /// Sets the hit, or adds it to those whose t is still to be computed.
    HWY_INLINE void finish(const Mesh& mesh, Hit& hit, SureHits<mode, Size>& sure) const {
        if (decided) {
            hit = decided->hit(mesh);
        } else if (prim != kNoIndex) {
            sure.add(ray, *pack, lane, hit);
        } else {
            hit = {};
        }
    }
};

/// Whether anything lies on the ray.
template <Mode mode, uint32_t Size>
struct Occlusion {
    const Ray& ray;
    std::optional<ClosestHit<mode> > decided;

    HWY_INLINE explicit Occlusion(const Ray& searched) : ray(searched) {}

    HWY_INLINE bool is_hit(const TrianglePack<Size>& pack, const PackHits<Size>& hits) {
        for (uint32_t open = hits.open; open != 0; open &= open - 1) {
            const uint32_t i = static_cast<uint32_t>(std::countr_zero(open));
            const bool is_sure =
                (hits.sure >> i & 1) != 0 && hits.lower[i] >= ray.t_min && hits.upper[i] <= ray.t_max;
            if (is_sure || decide(pack, i)) return true;
        }
        return false;
    }
    HWY_NOINLINE bool decide(const TrianglePack<Size>& pack, uint32_t i) {
        NoCount count;
        if (!decided) decided.emplace(ray);
        return decided->occludes(pack.triangle(i), count);
    }
};

/// Children to be visited, the next one last, with the parameters at which the ray enters them. A node adds
/// at most its width; vectors are written whole. At the bottom stands an empty child. Its size is kept beside
/// it, in a register.
template <uint32_t Width>
struct Stack {
    static constexpr uint32_t kSize = (WideBvh<Width>::kMaxDepth + 1) * (Width - 1) + 2 * Width;
    HWY_ALIGN uint32_t children[kSize];
    HWY_ALIGN float entries[kSize];

    HWY_INLINE Stack() {
        children[0] = kNoIndex;
        entries[0] = -std::numeric_limits<float>::infinity();
    }
    HWY_INLINE WideChild pop(uint32_t& count) const { return {children[--count]}; }
    /// Removes what is entered beyond a limit; what is left.
    HWY_INLINE uint32_t prune(float limit, uint32_t count) {
        const hn::CappedTag<float, Width> d;
        const hn::RebindToUnsigned<decltype(d)> du;
        const auto most = hn::Set(d, limit);
        uint32_t kept = 0;
        for (uint32_t first = 0; first < count; first += static_cast<uint32_t>(hn::Lanes(d))) {
            const auto entry = hn::LoadU(d, entries + first);
            const auto child = hn::LoadU(du, children + first);
            const auto is_kept = hn::And(hn::Le(entry, most), hn::FirstN(d, count - first));
            const uint32_t bits = mask_bits(d, is_kept);
            hn::StoreU(lanes_first(d, entry, is_kept, bits), d, entries + kept);
            hn::StoreU(lanes_first(du, child, hn::RebindMask(du, is_kept), bits), du, children + kept);
            kept += static_cast<uint32_t>(std::popcount(bits));
        }
        return kept;
    }
};

/// Of hierarchies of more bytes hardly anything stays in the cache.
constexpr size_t kLarge = size_t{128} << 20;

/// The next two packs, which are those of neighbouring leaves, where the next rays often go.
template <uint32_t Size>
HWY_INLINE void prefetch_after(const TrianglePack<Size>* pack) {
    const char* const bytes = reinterpret_cast<const char*>(pack + 1);
    for (size_t at = 0; at < 2 * sizeof(*pack); at += 64) hwy::Prefetch(bytes + at);
}

/// Adds the children whose boxes the ray meets to the stack, but for the nearest in the order of the ray's
/// octant, which is returned; the one on top of the stack if there is none.
template <uint32_t Width>
HWY_INLINE WideChild next_child(const WideBvh<Width>& bvh, uint32_t index, const BoxRay<Width>& ray,
                                const ChildLanes<Width>& lanes, float limit, Stack<Width>& stack,
                                uint32_t& count) {
    using Lanes = ChildLanes<Width>;
    const typename Lanes::D d;
    const typename Lanes::DU du;
    const typename WideBvh<Width>::Node& node = bvh.nodes[index];
    const size_t at = ray.place_of(index);
    typename Lanes::V entry[Lanes::kParts], exit[Lanes::kParts];
    uint32_t met = 0;
    for (size_t part = 0; part < Lanes::kParts; ++part) {
        const size_t first = part * hn::MaxLanes(d);
        entry[part] = ray.entry(at + first);
        exit[part] = ray.exit(at + first, limit);
        met |= mask_bits(d, hn::Le(entry[part], exit[part])) << first;
    }
    if (met == 0) return stack.pop(count);
    if ((met & (met - 1)) == 0) return node.children[std::countr_zero(met)];
    if constexpr (Lanes::kHasPush) {
        typename Lanes::VU children[Lanes::kParts];
        for (size_t part = 0; part < Lanes::kParts; ++part)
            children[part] = hn::Load(du, &node.children[part * hn::MaxLanes(d)].bits);
        return node
            .children[lanes.push_met(node, entry, exit, children, stack.entries, stack.children, count)];
    } else {
        HWY_ALIGN float entries[Width];
        for (size_t part = 0; part < Lanes::kParts; ++part)
            hn::Store(entry[part], d, entries + part * hn::MaxLanes(d));
        lanes.for_each_back_to_front(node, met, [&](uint32_t lane) {
            stack.children[count] = node.children[lane].bits;
            stack.entries[count++] = entries[lane];
        });
        return stack.pop(count);
    }
}

/// The same in any order, without parameters: any hit will do.
template <uint32_t Width>
HWY_INLINE WideChild next_unordered(const WideBvh<Width>& bvh, uint32_t index, const BoxRay<Width>& ray,
                                    float limit, uint32_t* stack, uint32_t& count) {
    const hn::CappedTag<float, Width> d;
    const typename WideBvh<Width>::Node& node = bvh.nodes[index];
    const size_t at = ray.place_of(index);
    uint32_t met = 0;
    for (size_t first = 0; first < Width; first += hn::Lanes(d))
        met |= mask_bits(d, hn::Le(ray.entry(at + first), ray.exit(at + first, limit))) << first;
    if (met == 0) return {stack[--count]};
    const WideChild nearest = node.children[std::countr_zero(met)];
    met &= met - 1;
    if (met == 0) return nearest;
    const hn::RebindToUnsigned<decltype(d)> du;
    for (size_t first = 0; first < Width; first += hn::Lanes(d)) {
        const uint32_t bits = met >> first & ((1u << hn::MaxLanes(d)) - 1);
        const auto children = hn::Load(du, &node.children[first].bits);
        hn::StoreU(lanes_first(du, children, mask_of(du, bits), bits), du, stack + count);
        count += static_cast<uint32_t>(std::popcount(bits));
    }
    return nearest;
}

/// Triangles of a pack.
template <uint32_t Width>
constexpr uint32_t kPackSize = WideBvh<Width>::Pack::kSize;

// A ray's constants are made anew for every run of nodes and for every leaf. Kept over the triangles' tests,
// where a function is called, they would lie in memory, and each node would read all of them from there.

template <Mode mode, uint32_t Width>
HWY_NOINLINE void find_closest(const WideBvh<Width>& bvh, const FloatRays<mode>& rays, size_t i,
                               Search<mode, kPackSize<Width> >& search) {
    const Planes<Width> planes(rays.octant[i]);
    const auto* const packs = bvh.packs.data();
    const bool is_large = bvh.byte_count() > kLarge;
    const ChildLanes<Width> lanes(rays.octant[i]);
    Stack<Width> stack;
    uint32_t count = 1;
    WideChild child = WideChild::inner(0);
    while (true) {
        const BoxRay<Width> box_ray(rays, i, planes, bvh.nodes.data());
        while (child.is_inner())
            child = next_child(bvh, child.node(), box_ray, lanes, search.limit, stack, count);
        if (child.is_empty()) return;
        const auto* pack = packs + child.first_pack();
        const auto* const end = pack + child.pack_count();
        if (is_large) prefetch_after(pack);
        const FloatRay<mode, kPackSize<Width> > ray(rays, i);
        const float limit = search.limit;
        for (; pack != end; ++pack) {
            PackHits<kPackSize<Width> > hits;
            if (test_pack(*pack, ray, search.limit, hits)) search.keep(*pack, hits);
        }
        if (search.limit < limit) count = stack.prune(search.limit, count);
        child = stack.pop(count);
    }
}

template <Mode mode, uint32_t Width>
HWY_NOINLINE bool find_any(const WideBvh<Width>& bvh, const FloatRays<mode>& rays, size_t i,
                           Occlusion<mode, kPackSize<Width> >& occlusion) {
    const Planes<Width> planes(rays.octant[i]);
    const auto* const packs = bvh.packs.data();
    const bool is_large = bvh.byte_count() > kLarge;
    const float limit = rays.t_max[i];
    HWY_ALIGN uint32_t stack[Stack<Width>::kSize];
    stack[0] = kNoIndex;
    uint32_t count = 1;
    WideChild child = WideChild::inner(0);
    while (true) {
        const BoxRay<Width> box_ray(rays, i, planes, bvh.nodes.data());
        while (child.is_inner()) child = next_unordered(bvh, child.node(), box_ray, limit, stack, count);
        if (child.is_empty()) return false;
        const auto* pack = packs + child.first_pack();
        const auto* const end = pack + child.pack_count();
        if (is_large) prefetch_after(pack);
        const FloatRay<mode, kPackSize<Width> > ray(rays, i);
        for (; pack != end; ++pack) {
            PackHits<kPackSize<Width> > hits;
            if (test_pack(*pack, ray, limit, hits) && occlusion.is_hit(*pack, hits)) return true;
        }
        child = {stack[--count]};
    }
}

/// Calls trace(prepared rays, i, number of the ray) for each ray that floats can be used for, plain(number)
/// for the others, and after some rays end_of_part().
template <Mode mode, uint32_t Width, class Trace, class Plain, class EndOfPart>
HWY_INLINE void for_each_ray(const WideBvh<Width>& bvh, std::span<const Ray> rays, const Task& task,
                             Trace&& trace, Plain&& plain, EndOfPart&& end_of_part) {
    const FloatScene scene(bvh.nodes[0].bounds());
    for (size_t first = 0; first < rays.size() && !task.stopped(); first += FloatRays<mode>::kCount) {
        const size_t count = std::min(FloatRays<mode>::kCount, rays.size() - first);
        const FloatRays<mode> prepared(rays.subspan(first, count), scene);
        for (size_t i = 0; i < count; ++i) {
            // Of the next part, which would be waited for at once.
            hwy::Prefetch(&rays[std::min(first + count + i, rays.size() - 1)]);
            if (HWY_LIKELY(prepared.usable[i] != 0)) {
                trace(prepared, i, first + i);
            } else {
                plain(first + i);
            }
        }
        end_of_part();
    }
}

template <Mode mode, uint32_t Width>
HWY_NOINLINE void closest_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                                  std::span<Hit> hits, const Task& task) {
    std::ranges::fill(hits, Hit{});
    if (bvh.nodes.empty()) return;
    SureHits<mode, kPackSize<Width> > sure;
    for_each_ray<mode>(
        bvh, rays, task,
        [&](const FloatRays<mode>& prepared, size_t i, size_t number) {
            Search<mode, kPackSize<Width> > search(rays[number]);
            find_closest<mode, Width>(bvh, prepared, i, search);
            search.finish(mesh, hits[number], sure);
        },
        [&](size_t number) { hits[number] = plain_closest_hit<mode>(bvh, mesh, rays[number], task); },
        [&] { sure.write(mesh); });
}

template <Mode mode, uint32_t Width>
HWY_NOINLINE void any_hits_in(const WideBvh<Width>& bvh, const Mesh& mesh, std::span<const Ray> rays,
                              std::span<uint8_t> occluded, const Task& task) {
    std::ranges::fill(occluded, uint8_t{0});
    if (bvh.nodes.empty()) return;
    for_each_ray<mode>(
        bvh, rays, task,
        [&](const FloatRays<mode>& prepared, size_t i, size_t number) {
            Occlusion<mode, kPackSize<Width> > occlusion(rays[number]);
            occluded[number] = find_any<mode, Width>(bvh, prepared, i, occlusion) ? 1 : 0;
        },
        [&](size_t number) { occluded[number] = plain_any_hit<mode>(bvh, mesh, rays[number], task) ? 1 : 0; },
        [] {});
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
void closest_hits16(const WideBvh<16>& bvh, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
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
void any_hits16(const WideBvh<16>& bvh, const Mesh& mesh, std::span<const Ray> rays,
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
HWY_EXPORT(closest_hits16);
HWY_EXPORT(any_hits4);
HWY_EXPORT(any_hits8);
HWY_EXPORT(any_hits16);

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
void WideBvh<16>::closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                               const Task& task) const {
    HWY_DYNAMIC_DISPATCH(closest_hits16)(*this, mesh, rays, hits, mode, task);
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
template <>
void WideBvh<16>::any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded,
                           Mode mode, const Task& task) const {
    HWY_DYNAMIC_DISPATCH(any_hits16)(*this, mesh, rays, occluded, mode, task);
}

}  // namespace boxwood
#endif
