#include "core/grid/uniform_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>

#include "core/base/parallel.h"
#include "core/refs/triangle_touches_box.h"

namespace boxwood {

namespace {

/// Cells [begin, end) along each axis.
struct CellBlock {
    std::array<uint32_t, 3> begin, end;

    uint32_t count(size_t axis) const { return end[axis] - begin[axis]; }
    bool is_one_cell() const { return count(0) == 1 && count(1) == 1 && count(2) == 1; }
    size_t longest_axis() const {
        const uint32_t x = count(0), y = count(1), z = count(2);
        return x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
    }
};

struct CellRef {
    uint32_t cell, prim;
};

/// A number of cells along an axis, never less than one.
uint32_t cells_of(double count, double most) {
    return static_cast<uint32_t>(std::clamp(std::floor(count + 0.5), 1.0, most));
}

/// The cells of a grid that a triangle touches.
class TouchedCells {
public:
    TouchedCells(const Grid& grid, const Triangle& triangle) : grid_(grid), test_(triangle) {}

    template <class Emit>
    void for_each(const Emit& emit) const {
        visit(block_of(test_.bounds()), emit);
    }

private:
    /// The cells that touch the box.
    CellBlock block_of(const Box& box) const {
        CellBlock block;
        for (size_t axis = 0; axis < 3; ++axis) {
            const std::vector<float>& walls = grid_.walls[axis];
            const int k = static_cast<int>(axis);
            const auto first = std::lower_bound(walls.begin() + 1, walls.end(), box.lower[k]);
            const auto end = std::upper_bound(walls.begin(), walls.end() - 1, box.upper[k]);
            block.begin[axis] = static_cast<uint32_t>(first - walls.begin()) - 1;
            block.end[axis] = static_cast<uint32_t>(end - walls.begin());
        }
        return block;
    }
    Box box_of(const CellBlock& block) const {
        const auto& walls = grid_.walls;
        return {{walls[0][block.begin[0]], walls[1][block.begin[1]], walls[2][block.begin[2]]},
                {walls[0][block.end[0]], walls[1][block.end[1]], walls[2][block.end[2]]}};
    }
    /// The triangle touches the block. Halves it, so that the time goes with the cells touched, not with the
    /// cells of the triangle's box; of two halves, one is touched.
    template <class Emit>
    void visit(const CellBlock& block, const Emit& emit) const {
        if (block.is_one_cell()) {
            emit(block.begin[0] +
                 grid_.cell_count(0) * (block.begin[1] + grid_.cell_count(1) * block.begin[2]));
            return;
        }
        const size_t axis = block.longest_axis();
        const uint32_t middle = block.begin[axis] + block.count(axis) / 2;
        CellBlock lower = block, upper = block;
        lower.end[axis] = middle;
        upper.begin[axis] = middle;
        const bool touches_lower = test_.touches_near(box_of(lower));
        if (touches_lower) visit(lower, emit);
        if (!touches_lower || test_.touches_near(box_of(upper))) visit(upper, emit);
    }

    const Grid& grid_;
    TriangleBoxTest test_;
};

/// The references of `prims`, block by block of them; nothing if they are more than `most`, which does not
/// depend on the number of threads.
std::optional<std::vector<std::vector<CellRef>>> make_cell_refs(const Mesh& mesh, const Grid& grid,
                                                                std::span<const uint32_t> prims, size_t most,
                                                                Task& task) {
    constexpr size_t kGrain = 1024;
    std::vector<std::vector<CellRef>> blocks((prims.size() + kGrain - 1) / kGrain);
    std::atomic<size_t> count{0};
    parallel_for(prims.size(), kGrain, [&](size_t begin, size_t end) {
        std::vector<CellRef>& block = blocks[begin / kGrain];
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            const size_t before = block.size();
            TouchedCells(grid, mesh.triangle(prims[i])).for_each([&](uint32_t cell) {
                block.push_back({cell, prims[i]});
            });
            if (count.fetch_add(block.size() - before) > most) return;
        }
        task.done += end - begin;
    });
    if (count > most) return std::nullopt;
    return blocks;
}

/// Counting sort by cell; primitives stay in ascending order.
void sort_into_cells(const std::vector<std::vector<CellRef>>& blocks, Grid& grid) {
    const size_t cell_count = size_t{grid.cell_count(0)} * grid.cell_count(1) * grid.cell_count(2);
    grid.cell_begin.assign(cell_count + 1, 0);
    for (const std::vector<CellRef>& block : blocks)
        for (const CellRef& ref : block) ++grid.cell_begin[ref.cell + 1];
    for (size_t cell = 0; cell < cell_count; ++cell) grid.cell_begin[cell + 1] += grid.cell_begin[cell];
    grid.prims.resize(grid.cell_begin.back());
    std::vector<uint32_t> next(grid.cell_begin.begin(), grid.cell_begin.end() - 1);
    for (const std::vector<CellRef>& block : blocks)
        for (const CellRef& ref : block) grid.prims[next[ref.cell]++] = ref.prim;
}

uint64_t product(const UVec3& n) { return uint64_t{n.x} * n.y * n.z; }

/// Half as many cells along the axes that have most.
UVec3 halved(UVec3 resolution) {
    const uint32_t most = std::max({resolution.x, resolution.y, resolution.z});
    for (int axis = 0; axis < 3; ++axis)
        if (resolution[axis] > most / 2) resolution[axis] = (resolution[axis] + 1) / 2;
    return resolution;
}

}  // namespace

std::vector<float> make_walls(float lower, float upper, uint32_t count) {
    if (lower == upper) return {lower, upper};
    const double extent = double(upper) - double(lower);
    std::vector<float> walls;
    for (; count > 1; count /= 2) {
        walls.resize(count + 1);
        walls[0] = lower;
        // Rounding is monotonic, so walls do not decrease; but extent, rounded up, may lead beyond upper.
        for (uint32_t i = 1; i < count; ++i)
            walls[i] = std::min(static_cast<float>(double(lower) + extent * (double(i) / count)), upper);
        walls[count] = upper;
        if (std::adjacent_find(walls.begin(), walls.end(), std::greater_equal<float>()) == walls.end())
            return walls;
    }
    return {lower, upper};
}

UVec3 UniformGrid::resolution(const Box& bounds, size_t prim_count) const {
    const DVec3 extent = bounds.extent();
    const std::array<int, 3> by_hand = {x, y, z};
    double cells = double(density) * double(prim_count);
    UVec3 result(1);
    std::array<bool, 3> is_set = {true, true, true};
    for (int axis = 0; axis < 3; ++axis) {
        const int wanted = by_hand[static_cast<size_t>(axis)];
        if (!(extent[axis] > 0.0)) continue;
        if (wanted == 0) is_set[static_cast<size_t>(axis)] = false;
        if (wanted == 0) continue;
        result[axis] = static_cast<uint32_t>(wanted);
        cells /= double(wanted);
    }
    // Of the axes that are left, those that are shorter than a cell get one, then the others share the cells.
    while (true) {
        double volume = 1.0;
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (is_set[static_cast<size_t>(axis)]) continue;
            volume *= extent[axis];
            ++axes;
        }
        if (axes == 0) break;
        const double cells_per_length = std::pow(std::max(cells, 1.0) / volume, 1.0 / axes);
        bool is_one_short = false;
        for (int axis = 0; axis < 3; ++axis) {
            if (is_set[static_cast<size_t>(axis)] || extent[axis] * cells_per_length >= 1.0) continue;
            is_set[static_cast<size_t>(axis)] = is_one_short = true;
        }
        if (is_one_short && axes > 1) continue;
        for (int axis = 0; axis < 3; ++axis)
            if (!is_set[static_cast<size_t>(axis)])
                result[axis] = cells_of(extent[axis] * cells_per_length, double(kMaxCells));
        break;
    }
    while (product(result) > kMaxCells) result = halved(result);
    return result;
}

Grid UniformGrid::build(const Mesh& mesh, std::span<const PrimRef> refs, Task& task) const {
    const std::vector<uint32_t> prims = prims_of(refs);
    if (prims.empty()) return {};
    Box bounds;
    for (const uint32_t prim : prims) bounds.extend(mesh.triangle(prim).bounds());
    const size_t most_refs = std::min(
        std::max(static_cast<size_t>(budget.per_triangle) * prims.size(), budget.at_least), kMaxReferences);
    UVec3 cells = resolution(bounds, prims.size());
    const uint64_t wanted = product(cells);
    task.total = prims.size();
    while (true) {
        Grid grid;
        for (int axis = 0; axis < 3; ++axis)
            grid.walls[static_cast<size_t>(axis)] =
                make_walls(bounds.lower[axis], bounds.upper[axis], cells[axis]);
        task.done = 0;
        const auto blocks = make_cell_refs(mesh, grid, prims, most_refs, task);
        if (task.stopped()) return {};
        if (blocks) {
            sort_into_cells(*blocks, grid);
            task.skipped.add("grid cells over the reference budget", wanted - product(cells));
            return grid;
        }
        cells = halved(cells);
    }
}

}  // namespace boxwood
