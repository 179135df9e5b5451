#include "core/bvh/morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <tuple>

#include "core/bvh/morton_order.h"
#include "core/measure/tree_stats.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

constexpr float kCells = 2097152.0f;  // 2^21

/// A point at a cell of the grid of 2^21 cells along each axis.
PrimRef at_cell(uint32_t prim, float x, float y, float z) {
    // Half centres are half of these.
    return {Box{2.0f * Vec3(x, y, z), 2.0f * Vec3(x, y, z)}, prim};
}

/// Two corners that make the cells of at_cell those of the grid.
std::vector<PrimRef> whole_grid() { return {at_cell(0, 0, 0, 0), at_cell(1, kCells, kCells, kCells)}; }

MortonGrid grid_of(std::span<const PrimRef> refs) {
    Box half_centers;
    for (const PrimRef& ref : refs) half_centers.extend(half_center(ref.bounds));
    return MortonGrid(half_centers);
}

std::vector<uint64_t> codes_of(std::span<const PrimRef> refs) {
    const MortonGrid grid = grid_of(refs);
    std::vector<uint64_t> codes;
    for (const PrimRef& ref : refs) codes.push_back(grid.code(ref));
    return codes;
}

/// Many references in few cells of the leading codes, some in equal places, and a few far away.
std::vector<PrimRef> crowded_refs() {
    std::vector<PrimRef> refs = whole_grid();
    Rng rng(3);
    for (uint32_t i = 2; i < 4000; ++i) {
        const float extent = i % 5 == 0 ? kCells : i % 3 == 0 ? 4.0f : 3000.0f;
        const float x = rng.next(0.0f, extent), y = rng.next(0.0f, extent), z = rng.next(0.0f, extent);
        refs.push_back(at_cell(i, std::floor(x), std::floor(y), std::floor(z)));
    }
    return refs;
}

TEST(MortonGrid, InterleavesTheBitsOfTheCells) {
    std::vector<PrimRef> refs = whole_grid();
    Rng rng(1);
    for (uint32_t i = 2; i < 200; ++i) {
        const uint32_t x = static_cast<uint32_t>(rng.next_index(1 << 21)),
                       y = static_cast<uint32_t>(rng.next_index(1 << 21)),
                       z = static_cast<uint32_t>(rng.next_index(1 << 21));
        refs.push_back(at_cell(i, static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
        uint64_t expected = 0;
        for (int bit = 20; bit >= 0; --bit)
            for (const uint32_t cell : {x, y, z}) expected = expected << 1 | ((cell >> bit) & 1);
        const MortonGrid grid = grid_of(refs);
        EXPECT_EQ(grid.code(refs.back()), expected);
        EXPECT_EQ(grid.leading_code(refs.back()), expected >> 30);
    }
    EXPECT_EQ(grid_of(refs).code(refs[1]), (uint64_t{1} << 63) - 1);  // the far corner is in the last cell
}

TEST(MortonGrid, HasCubicCellsAndCutsLongerAxesFirst) {
    const std::vector<PrimRef> refs = {at_cell(0, 0, 0, 0), at_cell(1, 16, 1024, 256)};
    const MortonGrid grid = grid_of(refs);
    const auto top_bit = [&](float x, float y, float z) {
        return 63 - std::countl_zero(grid.code(at_cell(0, x, y, z)));
    };
    EXPECT_EQ(top_bit(0, 512, 0), 62);
    EXPECT_EQ(top_bit(0, 0, 512), 61);
    EXPECT_EQ(top_bit(512, 0, 0), 60);
    EXPECT_EQ(top_bit(0, 256, 0), 59);
}

/// Sets of one leading code, of 1 to 20 references in all places of the grid, and some larger ones.
std::vector<PrimRef> sets_of_one_leading_code() {
    std::vector<PrimRef> refs = whole_grid();
    Rng rng(5);
    const auto coordinate = [&](size_t cells, size_t width) {
        return static_cast<float>(rng.next_index(cells) * width);
    };
    for (uint32_t set = 0; set < 400; ++set) {
        const Vec3 cell(coordinate(1024, 2048), coordinate(1024, 2048), coordinate(1024, 2048));
        const uint32_t count = set % 100 == 99 ? 1500 : 1 + set % 20;
        for (uint32_t i = 0; i < count; ++i) {
            // Every third at the same place.
            const Vec3 at = i % 3 == 0
                                ? cell
                                : cell + Vec3(coordinate(2048, 1), coordinate(2048, 1), coordinate(2048, 1));
            refs.push_back(at_cell(static_cast<uint32_t>(refs.size()), at.x, at.y, at.z));
        }
    }
    return refs;
}

/// As morton_order says, by comparisons.
struct ExpectedOrder {
    std::vector<uint32_t> refs;
    std::vector<uint8_t> levels;

    ExpectedOrder(const std::vector<uint64_t>& codes, uint32_t run_limit) {
        std::map<uint64_t, uint32_t> counts;  // by leading code
        for (const uint64_t code : codes) ++counts[code >> 33];
        const auto key = [&](uint32_t ref) {
            const bool is_refined = counts[codes[ref] >> 33] > run_limit;
            return std::tuple(codes[ref] >> 33, is_refined ? codes[ref] : 0, ref);
        };
        for (uint32_t i = 0; i < codes.size(); ++i) refs.push_back(i);
        std::ranges::sort(refs, {}, key);
        for (size_t i = 0; i + 1 < refs.size(); ++i) {
            const uint64_t a = codes[refs[i]], b = codes[refs[i + 1]];
            const bool is_equal = a >> 33 == b >> 33 && (a == b || counts[a >> 33] <= run_limit);
            levels.push_back(is_equal ? MortonOrder::kEqual
                                      : static_cast<uint8_t>(std::countl_zero(a ^ b) - 1));
        }
    }
};

TEST(MortonOrder, IsThatOfComparisons) {
    const std::vector<PrimRef> refs = sets_of_one_leading_code();
    const std::vector<uint64_t> codes = codes_of(refs);
    for (const uint32_t run_limit : {1u, 4u, 8u, 10000u}) {
        const MortonOrder order = morton_order(refs, run_limit, Task());
        const ExpectedOrder expected(codes, run_limit);
        ASSERT_EQ(order.keys.size(), refs.size());
        ASSERT_EQ(order.levels.size(), refs.size() - 1);
        for (size_t i = 0; i < refs.size(); ++i)
            ASSERT_EQ(order.ref(i), expected.refs[i]) << run_limit << ", " << i;
        for (size_t i = 0; i + 1 < refs.size(); ++i)
            ASSERT_EQ(order.levels[i], expected.levels[i]) << run_limit << ", " << i;
    }
}

TEST(MortonOrder, OfManyTellsMoreOfThemApartAtOnce) {
    std::vector<PrimRef> refs = whole_grid();
    Rng rng(9);
    refs.reserve(MortonOrder::kMany);
    const auto coordinate = [&] { return static_cast<float>(rng.next_index(1 << 21)); };
    while (refs.size() < MortonOrder::kMany) {
        const float x = coordinate(), y = coordinate(), z = coordinate();
        refs.push_back(at_cell(static_cast<uint32_t>(refs.size()), x, y, z));
    }
    const MortonGrid grid = grid_of(refs);
    // Only leading codes: no set is larger than all.
    const MortonOrder order = morton_order(refs, MortonOrder::kMany, Task());
    const auto place = [&](size_t i) { return std::pair(grid.code(refs[order.ref(i)]) >> 30, order.ref(i)); };
    for (auto [i, a] = std::pair(size_t{0}, place(0)); i + 1 < refs.size(); ++i) {
        const auto b = place(i + 1);
        ASSERT_LT(a, b);
        const auto level = static_cast<uint8_t>(std::countl_zero(a.first ^ b.first) - 31);
        ASSERT_EQ(order.levels[i], a.first == b.first ? MortonOrder::kEqual : level);
        a = b;
    }
}

TEST(Morton, SortsAlongTheCurveThenByIndex) {
    Task task;
    const Mesh mesh = random_triangles(3000, 0.01f, 2);
    for (const std::vector<PrimRef>& refs : {whole_refs(mesh), crowded_refs()}) {
        const std::vector<uint64_t> codes = codes_of(refs);
        const Bvh2 bvh = Morton{.max_leaf_size = 1}.build(mesh, refs, task);
        ASSERT_EQ(bvh.prims.size(), refs.size());
        for (size_t i = 1; i < refs.size(); ++i) {
            const uint32_t a = bvh.prims[i - 1], b = bvh.prims[i];
            ASSERT_TRUE(codes[a] < codes[b] || (codes[a] == codes[b] && a < b)) << i;
        }
    }
}

TEST(Morton, SplitsWhereTheFirstBitChanges) {
    Task task;
    const std::vector<PrimRef> refs = crowded_refs();
    const std::vector<uint64_t> codes = codes_of(refs);
    for (const int max_leaf_size : {1, 4}) {
        const Bvh2 bvh = Morton{.max_leaf_size = max_leaf_size}.build(Mesh{}, refs, task);
        size_t halved = 0;
        // The codes of all primitives below a node, left before right.
        const std::function<std::vector<uint64_t>(uint32_t)> check = [&](uint32_t node) {
            const Bvh2::Node& n = bvh.nodes[node];
            std::vector<uint64_t> all;
            if (n.is_leaf()) {
                EXPECT_LE(n.count, static_cast<uint32_t>(max_leaf_size));
                for (uint32_t i = 0; i < n.count; ++i) all.push_back(codes[bvh.prims[n.first + i]]);
                return all;
            }
            const std::vector<uint64_t> left = check(n.first), right = check(n.first + 1);
            all = left;
            all.insert(all.end(), right.begin(), right.end());
            EXPECT_GT(all.size(), static_cast<size_t>(max_leaf_size));
            const auto [least, most] = std::minmax_element(all.begin(), all.end());
            if (*least == *most) {
                EXPECT_EQ(left.size(), all.size() / 2);
                ++halved;
                return all;
            }
            const uint64_t bit = std::bit_floor(*least ^ *most);
            for (const uint64_t code : left) EXPECT_EQ(code & bit, 0u);
            for (const uint64_t code : right) EXPECT_EQ(code & bit, bit);
            return all;
        };
        EXPECT_EQ(check(0).size(), refs.size());
        EXPECT_GT(halved, 10u);
    }
}

TEST(Morton, KeepsTheDepthBoundBelowCodesOfEveryLength) {
    // One reference for each single bit of a code parts off at each of 63 levels; a thousand equal ones at
    // the end of that chain would need 10 levels more.
    std::vector<PrimRef> refs = whole_grid();
    for (int bit = 0; bit < 21; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 cell(0.0f);
            cell[axis] = static_cast<float>(1 << bit);
            refs.push_back(at_cell(static_cast<uint32_t>(refs.size()), cell.x, cell.y, cell.z));
        }
    }
    for (int i = 0; i < 1000; ++i) refs.push_back(at_cell(static_cast<uint32_t>(refs.size()), 0, 0, 0));
    Task task;
    const Bvh2 bvh = Morton{.max_leaf_size = 1}.build(Mesh{}, refs, task);
    const LevelTable levels = make_level_table(bvh.list_nodes());
    EXPECT_EQ(check_nodes(levels.list, refs.size()), "");
    EXPECT_LE(levels.level_count(), 65u);
    EXPECT_GT(levels.level_count(), 50u);
}

TEST(Morton, HasTheBoxesOfItsReferences) {
    Task task;
    const Mesh mesh = random_triangles(20'000, 0.02f, 4);  // several parts
    const std::vector<PrimRef> refs = whole_refs(mesh);
    const Bvh2 bvh = Morton{}.build(mesh, refs, task);
    const std::function<Box(uint32_t)> check = [&](uint32_t node) {
        const Bvh2::Node& n = bvh.nodes[node];
        Box box;
        if (n.is_leaf()) {
            for (uint32_t i = 0; i < n.count; ++i) box.extend(refs[bvh.prims[n.first + i]].bounds);
        } else {
            box.extend(check(n.first));
            box.extend(check(n.first + 1));
        }
        EXPECT_EQ(box, (Box{n.lower, n.upper}));
        return box;
    };
    check(0);
}

}  // namespace
}  // namespace boxwood
