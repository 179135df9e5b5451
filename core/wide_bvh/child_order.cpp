#include "core/wide_bvh/child_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/wide_bvh/child_order.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The lanes of a node. Only operations that round as their scalar forms are used, so every instruction set
/// gives the same orders.
template <uint32_t Width>
struct NodeLanes {
    using D = hn::CappedTag<float, Width>;
    using DI = hn::RebindToSigned<D>;
    using V = hn::Vec<D>;
    using VI = hn::Vec<DI>;
    static constexpr uint32_t kLanes = hn::MaxLanes(D()), kParts = Width / kLanes;
    static constexpr uint32_t kOctants = 4;  ///< the others are their opposites

    /// For each octant: the others that the child is before. Nothing for empty lanes, whose centres are NaN.
    VI wins[kOctants][kParts];

    HWY_INLINE NodeLanes(const typename WideBvh<Width>::Node& node, uint32_t child_count) {
        constexpr float kSmallest = std::numeric_limits<float>::min();  // two flat boxes reach so far
        const D d;
        const DI di;
        V centers[3][kParts], halves[3][kParts];
        for (uint32_t part = 0; part < kParts; ++part) {
            for (uint32_t axis = 0; axis < 3; ++axis) {
                const V half = hn::Set(d, 0.5f);
                const V lower = hn::Mul(half, hn::Load(d, node.lower[axis] + part * kLanes));
                const V upper = hn::Mul(half, hn::Load(d, node.upper[axis] + part * kLanes));
                centers[axis][part] = hn::Add(lower, upper);
                halves[axis][part] = hn::Sub(upper, lower);
            }
            for (uint32_t octant = 0; octant < kOctants; ++octant) wins[octant][part] = hn::Zero(di);
        }
        for (uint32_t b = 0; b < child_count; ++b) {
            for (uint32_t part = 0; part < kParts; ++part) {
                V separation[3];  // of b from the others
                for (uint32_t axis = 0; axis < 3; ++axis) {
                    const float lower = 0.5f * node.lower[axis][b], upper = 0.5f * node.upper[axis][b];
                    const V reach = hn::Add(hn::Set(d, upper - lower), halves[axis][part]);
                    separation[axis] = hn::Div(hn::Sub(hn::Set(d, lower + upper), centers[axis][part]),
                                               hn::Max(reach, hn::Set(d, kSmallest)));
                }
                const V plus = hn::Add(separation[0], separation[1]);
                const V minus = hn::Sub(separation[0], separation[1]);
                const V z = separation[2], none = hn::Zero(d);
                count(hn::Gt(hn::Add(plus, z), none), wins[0][part]);
                count(hn::Gt(hn::Sub(z, minus), none), wins[1][part]);
                count(hn::Gt(hn::Add(minus, z), none), wins[2][part]);
                count(hn::Gt(hn::Sub(z, plus), none), wins[3][part]);
            }
        }
    }
    /// The lanes by descending wins. Of equal ones the first comes first, and empty lanes come last.
    HWY_INLINE typename WideBvh<Width>::Order order(uint32_t octant, uint32_t child_count) const {
        using Order = typename WideBvh<Width>::Order;
        const DI di;
        HWY_ALIGN int32_t all_keys[Width], all_ranks[Width];
        VI keys[kParts], ranks[kParts];
        for (uint32_t part = 0; part < kParts; ++part) {
            const VI lane = hn::Iota(di, static_cast<int32_t>(part * kLanes));
            const auto is_child = hn::Lt(lane, hn::Set(di, static_cast<int32_t>(child_count)));
            const VI most = hn::IfThenElse(is_child, wins[octant][part], hn::Set(di, -1));
            keys[part] = hn::Sub(hn::Mul(most, hn::Set(di, static_cast<int32_t>(Width))), lane);
            hn::Store(keys[part], di, all_keys + part * kLanes);
            ranks[part] = hn::Zero(di);
        }
        for (const int32_t key : all_keys)
            for (uint32_t part = 0; part < kParts; ++part)
                count(hn::Gt(hn::Set(di, key), keys[part]), ranks[part]);
        for (uint32_t part = 0; part < kParts; ++part) hn::Store(ranks[part], di, all_ranks + part * kLanes);
        Order order = 0;
        for (uint32_t lane = 0; lane < Width; ++lane) {
            const auto shift = WideBvh<Width>::kLaneBits * static_cast<uint32_t>(all_ranks[lane]);
            order = static_cast<Order>(order | static_cast<Order>(lane) << shift);
        }
        return order;
    }

private:
    /// Adds 1 where the mask is set.
    template <class Mask>
    static HWY_INLINE void count(Mask mask, VI& number) {
        const DI di;
        number = hn::IfThenElse(hn::RebindMask(di, mask), hn::Add(number, hn::Set(di, 1)), number);
    }
};

template <uint32_t Width>
HWY_INLINE void set_order_in(typename WideBvh<Width>::Node& node) {
    uint32_t child_count = 0;
    while (child_count < Width && !node.children[child_count].is_empty()) ++child_count;
    const NodeLanes<Width> lanes(node, child_count);
    for (uint32_t octant = 0; octant < lanes.kOctants; ++octant)
        node.orders[octant] = lanes.order(octant, child_count);
}

// Highway exports plain functions, not templates: one for each width.
void set_order4(WideBvh<4>::Node& node) { set_order_in<4>(node); }
void set_order8(WideBvh<8>::Node& node) { set_order_in<8>(node); }
void set_order16(WideBvh<16>::Node& node) { set_order_in<16>(node); }

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(set_order4);
HWY_EXPORT(set_order8);
HWY_EXPORT(set_order16);

template <>
void set_order<4>(WideBvh<4>::Node& node) {
    HWY_DYNAMIC_DISPATCH(set_order4)(node);
}
template <>
void set_order<8>(WideBvh<8>::Node& node) {
    HWY_DYNAMIC_DISPATCH(set_order8)(node);
}
template <>
void set_order<16>(WideBvh<16>::Node& node) {
    HWY_DYNAMIC_DISPATCH(set_order16)(node);
}

}  // namespace boxwood
#endif
