#pragma once

#include <array>
#include <vector>

#include "core/structure/structure.h"

namespace boxwood {

/// Regular grid: the scene's box in equal cells, each with the primitives that touch it. Cells are closed, so
/// a primitive in a wall belongs to both sides. A ray walks from cell to cell, front to back, and tests no
/// primitive twice.
struct Grid {
    static constexpr const char* kFamily = "grid";

    /// Walls of each axis: one more than cells, strictly increasing; an axis without extent has one cell
    /// between two equal walls.
    std::array<std::vector<float>, 3> walls;
    /// Cell (x, y, z) is number x + cell_count(0) (y + cell_count(1) z), and has the primitives
    /// prims[cell_begin[number] .. cell_begin[number + 1]), ascending. An empty mesh has no cell.
    std::vector<uint32_t> cell_begin;
    std::vector<uint32_t> prims;

    bool is_empty() const { return cell_begin.empty(); }
    uint32_t cell_count(size_t axis) const { return static_cast<uint32_t>(walls[axis].size() - 1); }
    /// Of the cell (x, y, z).
    Box cell_box(uint32_t x, uint32_t y, uint32_t z) const {
        return {{walls[0][x], walls[1][y], walls[2][z]}, {walls[0][x + 1], walls[1][y + 1], walls[2][z + 1]}};
    }
    Box bounds() const {
        return {{walls[0].front(), walls[1].front(), walls[2].front()},
                {walls[0].back(), walls[1].back(), walls[2].back()}};
    }

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const;
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const;
    /// The box, then its cells by number.
    NodeList list_nodes() const;
    size_t byte_count() const;
};

}  // namespace boxwood
