#include "core/bvh/morton_order.h"

#include <array>
#include <cmath>

#include "core/base/assert.h"
#include "core/base/radix_sort.h"

namespace boxwood {

namespace {

constexpr int kAxisBits = 21, kCodeBits = 3 * kAxisBits;
constexpr int kLeadingAxisBits = 11, kLeadingBits = 3 * kLeadingAxisBits;
static_assert(kLeadingBits + MortonOrder::kRefBits == 64);
constexpr size_t kCodeGrain = 1 << 14, kRunsAtOnce = 64;

/// Of the codes of so many references. Shorter digits sort faster.
constexpr int leading_bits(size_t ref_count) {
    return ref_count < MortonOrder::kMany ? kLeadingBits - 3 : kLeadingBits;
}

/// Bit i of 21 bits to bit 3 i.
constexpr uint64_t spread(uint64_t v) {
    v = (v | (v << 32)) & 0x001f00000000ffffull;
    v = (v | (v << 16)) & 0x001f0000ff0000ffull;
    v = (v | (v << 8)) & 0x100f00f00f00f00full;
    v = (v | (v << 4)) & 0x10c30c30c30c30c3ull;
    return (v | (v << 2)) & 0x1249249249249249ull;
}

/// spread() of what the leading bits of an axis can be.
constexpr auto kSpread = [] {
    std::array<uint32_t, 1 << kLeadingAxisBits> table{};
    for (uint64_t cell = 0; cell < table.size(); ++cell) table[cell] = static_cast<uint32_t>(spread(cell));
    return table;
}();

Box half_centers_of(std::span<const PrimRef> refs) {
    std::vector<Box> boxes((refs.size() + kCodeGrain - 1) / kCodeGrain);
    parallel_for(refs.size(), kCodeGrain, [&](size_t begin, size_t end) {
        Box4 box = empty_box4();
        for (const PrimRef& ref : refs.subspan(begin, end - begin)) {
            const Float4 center = half_center4(load_lower(ref), load_upper(ref));
            box.extend(center, center);
        }
        boxes[begin / kCodeGrain] = box.box();
    });
    Box all;
    for (const Box& box : boxes) all.extend(box);
    return all;
}

/// Entries [begin, end) with one leading code.
struct Run {
    size_t begin, end;
};

/// Sorts runs by whole codes. Keeps its memory from one to the next.
class Refinement {
public:
    Refinement(std::span<const PrimRef> refs, const MortonGrid& grid, MortonOrder& order)
        : refs_(refs), grid_(grid), order_(order) {}

    /// What the first references of a run that is refined soon need.
    void prefetch(Run run) const {
        constexpr size_t kMost = 16;
        for (size_t i = run.begin; i < std::min(run.end, run.begin + kMost); ++i)
            __builtin_prefetch(&refs_[order_.ref(i)]);
    }
    void refine(Run run) {
        const size_t count = run.end - run.begin;
        items_.resize(count);
        parallel_for(count, kCodeGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                items_[i] = {grid_.code(refs_[order_.ref(run.begin + i)]), order_.keys[run.begin + i]};
            }
        });
        std::span<const Item> sorted = items_;
        if (count < 1024) {
            std::sort(items_.begin(), items_.end(), [](const Item& a, const Item& b) {
                return a.code < b.code || (a.code == b.code && a.key < b.key);
            });
        } else {
            spare_.resize(count);
            const int other_bits = kCodeBits - leading_bits(order_.keys.size());
            sorted = radix_sort(std::span(items_), std::span(spare_), 0, other_bits,
                                [](const Item& item) { return item.code; });
        }
        parallel_for(count, kCodeGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                order_.keys[run.begin + i] = sorted[i].key;
                if (i + 1 == count) break;
                const uint64_t difference = sorted[i].code ^ sorted[i + 1].code;
                order_.levels[run.begin + i] = static_cast<uint8_t>(std::countl_zero(difference) - 1);
            }
        });
    }

private:
    struct Item {
        uint64_t code;
        uint64_t key;
    };

    std::span<const PrimRef> refs_;
    const MortonGrid& grid_;
    MortonOrder& order_;
    Array<Item> items_, spare_;
};

/// Levels from leading codes; returns the runs longer than the limit.
std::vector<Run> find_levels(MortonOrder& order, uint32_t run_limit) {
    const size_t count = order.keys.size();
    order.levels.resize(count - 1);
    std::vector<std::vector<Run>> runs((count + kCodeGrain - 1) / kCodeGrain);
    parallel_for(count - 1, kCodeGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint64_t difference = order.leading_code(i) ^ order.leading_code(i + 1);
            order.levels[i] = difference == 0
                                  ? MortonOrder::kEqual
                                  : static_cast<uint8_t>(std::countl_zero(difference) - (64 - kLeadingBits));
            if (difference != 0 || (i > 0 && order.leading_code(i - 1) == order.leading_code(i))) continue;
            size_t run_end = i + 2;
            while (run_end < count && order.leading_code(run_end) == order.leading_code(i)) ++run_end;
            if (run_end - i > run_limit) runs[begin / kCodeGrain].push_back({i, run_end});
        }
    });
    std::vector<Run> all;
    for (const std::vector<Run>& some : runs) all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace

MortonGrid::MortonGrid(const Box& half_centers) {
    const Vec3 lower = half_centers.lower, extent = half_centers.upper - lower;
    lower_ = Float4{lower.x, lower.y, lower.z, 0.0f};
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = static_cast<float>(1 << kAxisBits) / largest;
    scale_ = splat(std::isfinite(scale) ? scale : 0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        shift_[axis] = 2;
        for (int other = 0; other < 3; ++other) {
            const bool is_longer =
                extent[other] > extent[axis] || (extent[other] == extent[axis] && other < axis);
            if (is_longer) --shift_[axis];
        }
    }
}

Int4 MortonGrid::cell(const PrimRef& ref) const {
    const Float4 position = (half_center4(load_lower(ref), load_upper(ref)) - lower_) * scale_;
    const Int4 cell = __builtin_convertvector(position, Int4);
    constexpr int32_t kLast = (1 << kAxisBits) - 1;
    return cell > kLast ? Int4{kLast, kLast, kLast, kLast} : cell;
}

uint64_t MortonGrid::code(const PrimRef& ref) const {
    const Int4 c = cell(ref);
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) code |= spread(static_cast<uint64_t>(c[axis])) << shift_[axis];
    return code;
}

uint64_t MortonGrid::leading_code(const PrimRef& ref) const {
    const Int4 c = cell(ref) >> (kAxisBits - kLeadingAxisBits);
    const auto spread_at = [&](uint32_t cell, int axis) { return uint64_t{kSpread[cell]} << shift_[axis]; };
    return spread_at(static_cast<uint32_t>(c[0]), 0) | spread_at(static_cast<uint32_t>(c[1]), 1) |
           spread_at(static_cast<uint32_t>(c[2]), 2);
}

MortonOrder morton_order(std::span<const PrimRef> refs, uint32_t run_limit, const Task& task) {
    MortonOrder order;
    if (refs.empty()) return order;
    BOXWOOD_ASSERT(refs.size() <= size_t{1} << MortonOrder::kRefBits);
    const MortonGrid grid(half_centers_of(refs));
    order.keys.resize(refs.size());
    const int unused_bits = kLeadingBits - leading_bits(refs.size());
    const uint64_t used = ~uint64_t{0} << unused_bits;
    parallel_for(refs.size(), kCodeGrain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            order.keys[i] = (grid.leading_code(refs[i]) & used) << MortonOrder::kRefBits | i;
    });
    if (task.stopped()) return order;
    Array<uint64_t> spare(refs.size());
    radix_sort(std::span(order.keys), std::span(spare), MortonOrder::kRefBits + unused_bits,
               leading_bits(refs.size()), [](uint64_t key) { return key; });
    order.keys.swap(spare);  // three digits: the result is in the spare
    const std::vector<Run> runs = find_levels(order, run_limit);
    parallel_for(runs.size(), kRunsAtOnce, [&](size_t begin, size_t end) {
        Refinement refinement(refs, grid, order);
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            if (i + 1 < end) refinement.prefetch(runs[i + 1]);
            refinement.refine(runs[i]);
        }
    });
    return order;
}

}  // namespace boxwood
