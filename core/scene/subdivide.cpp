#include "core/scene/subdivide.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace boxwood {
namespace {

constexpr size_t kVertexGrain = 1 << 14;

/// The sum is rounded once and its half is exact: a half that is not (below 2^-126) comes of a sum that was.
/// Where the sum overflows both halves are exact, but for bits that cannot count.
float half_sum(float a, float b) {
    const float sum = a + b;
    return std::isfinite(sum) ? 0.5f * sum : 0.5f * a + 0.5f * b;
}

/// Side i of triangle t, the one from its corner i to the next, is side number 3 t + i.
struct SideOfVertex {
    uint32_t other;  ///< the end with the higher index
    uint32_t side;
};

uint32_t corner(const UVec3& triangle, uint32_t i) { return triangle[static_cast<int>(i % 3)]; }

/// All sides, grouped by the end with the lower index: first[v] .. first[v + 1] are those of vertex v, sorted
/// by the other end.
struct SidesByVertex {
    std::vector<uint32_t> first;
    std::vector<SideOfVertex> sides;
};

/// Unfinished after a stop.
SidesByVertex group_sides(const Mesh& mesh, const Task& task) {
    SidesByVertex grouped;
    grouped.first.assign(mesh.positions.size() + 2, 0);
    const auto for_each_side = [&](auto&& visit) {
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            if (t % kVertexGrain == 0 && task.stopped()) return;
            for (uint32_t i = 0; i < 3; ++i) {
                const uint32_t a = corner(mesh.triangles[t], i), b = corner(mesh.triangles[t], i + 1);
                visit(std::min(a, b), std::max(a, b), 3 * t + i);
            }
        }
    };
    // Counting sort; first[v + 1] is where vertex v writes next, and so in the end where its sides end.
    for_each_side([&](uint32_t low, uint32_t, uint32_t) { ++grouped.first[low + 2]; });
    for (size_t v = 2; v < grouped.first.size(); ++v) grouped.first[v] += grouped.first[v - 1];
    grouped.sides.resize(3 * mesh.triangles.size());
    for_each_side([&](uint32_t low, uint32_t high, uint32_t side) {
        grouped.sides[grouped.first[low + 1]++] = {high, side};
    });
    if (task.stopped()) return grouped;
    parallel_for(mesh.positions.size(), kVertexGrain, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end && !task.stopped(); ++v) {
            std::sort(grouped.sides.begin() + grouped.first[v], grouped.sides.begin() + grouped.first[v + 1],
                      [](const SideOfVertex& a, const SideOfVertex& b) {
                          return a.other < b.other || (a.other == b.other && a.side < b.side);
                      });
        }
    });
    return grouped;
}

/// Appends the middle of each edge to the positions; gives for each side the index of its middle. Unfinished
/// after a stop.
std::vector<uint32_t> add_middles(Mesh& mesh, const Task& task) {
    const SidesByVertex grouped = group_sides(mesh, task);
    std::vector<uint32_t> middle(grouped.sides.size());
    if (task.stopped()) return middle;
    const auto vertex_count = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t v = 0; v < vertex_count; ++v) {
        if (v % kVertexGrain == 0 && task.stopped()) return middle;
        for (uint32_t i = grouped.first[v]; i < grouped.first[v + 1]; ++i) {
            const SideOfVertex& side = grouped.sides[i];
            const bool is_first = i == grouped.first[v] || grouped.sides[i - 1].other != side.other;
            if (is_first) mesh.positions.push_back(midpoint(mesh.positions[v], mesh.positions[side.other]));
            middle[side.side] = static_cast<uint32_t>(mesh.positions.size() - 1);
        }
    }
    return middle;
}

void subdivide_once(Mesh& mesh, Task& task) {
    const std::vector<uint32_t> middle = add_middles(mesh, task);
    if (task.stopped()) return;
    const size_t count = mesh.triangles.size();
    Array<UVec3> triangles(4 * count);
    std::vector<uint32_t> source_prim(4 * count), object(4 * count);
    parallel_for(count, kVertexGrain, [&](size_t begin, size_t end) {
        if (task.stopped()) return;
        for (size_t t = begin; t < end; ++t) {
            const UVec3 v = mesh.triangles[t];
            const UVec3 m(middle[3 * t], middle[3 * t + 1], middle[3 * t + 2]);
            triangles[4 * t] = UVec3(v.x, m.x, m.z);
            triangles[4 * t + 1] = UVec3(m.x, v.y, m.y);
            triangles[4 * t + 2] = UVec3(m.z, m.y, v.z);
            triangles[4 * t + 3] = UVec3(m.x, m.y, m.z);
            for (size_t k = 4 * t; k < 4 * t + 4; ++k) {
                source_prim[k] = 4 * mesh.source_prim[t] + static_cast<uint32_t>(k - 4 * t);
                object[k] = mesh.object[t];
            }
        }
        task.done += 4 * (end - begin);
    });
    mesh.triangles = std::move(triangles);
    mesh.source_prim = std::move(source_prim);
    mesh.object = std::move(object);
}

}  // namespace

Vec3 midpoint(const Vec3& a, const Vec3& b) {
    return {half_sum(a.x, b.x), half_sum(a.y, b.y), half_sum(a.z, b.z)};
}

void subdivide(Mesh& mesh, int times, Task& task) {
    if (mesh.triangles.empty()) return;
    const double parts = std::exp2(2.0 * times);
    const double result = parts * static_cast<double>(mesh.triangles.size());
    if (result > static_cast<double>(kMaxSubdividedTriangles) ||
        parts * (1.0 + mesh.source_prim.back()) > 0x1p32) {
        throw Error(ExitCode::WrongUsage, "@subdivide=" + std::to_string(times) + " would make more than " +
                                              std::to_string(kMaxSubdividedTriangles / 1'000'000) +
                                              " million triangles out of " +
                                              std::to_string(mesh.triangles.size()));
    }
    task.done = 0;
    task.total = 0;
    for (int i = 1; i <= times; ++i) task.total += mesh.triangles.size() << (2 * i);
    for (int i = 0; i < times && !task.stopped(); ++i) subdivide_once(mesh, task);
}

}  // namespace boxwood
