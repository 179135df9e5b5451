#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/scene/generate/built_in.h"
#include "core/scene/suffix_value.h"

namespace boxwood {
namespace {

constexpr double kMaxTriangles = 50e6;
constexpr double kSide = 100.0;   // of the square, in world units
constexpr double kRelief = 27.0;  // from the lowest valley to the highest summit there can be

double lattice_value(int64_t x, int64_t z, int octave) {
    return static_cast<double>(hashed_float(static_cast<uint32_t>(x), static_cast<uint32_t>(z),
                                            static_cast<uint32_t>(octave), 20081));
}

/// Value noise in [0, 1]: random values at whole coordinates, between them a blend with continuous second
/// derivative.
double value_noise(double x, double z, int octave) {
    const double cell_x = std::floor(x), cell_z = std::floor(z);
    const double fx = x - cell_x, fz = z - cell_z;
    const double u = fx * fx * fx * (fx * (fx * 6.0 - 15.0) + 10.0);
    const double v = fz * fz * fz * (fz * (fz * 6.0 - 15.0) + 10.0);
    const auto i = static_cast<int64_t>(cell_x), k = static_cast<int64_t>(cell_z);
    const double near = lattice_value(i, k, octave) * (1.0 - u) + lattice_value(i + 1, k, octave) * u;
    const double far = lattice_value(i, k + 1, octave) * (1.0 - u) + lattice_value(i + 1, k + 1, octave) * u;
    return near * (1.0 - v) + far * v;
}

/// Height over the unit square: octaves of noise, each of half the size of the one before (fractional
/// Brownian motion), weaker in the valleys, so that these stay smooth and the mountains get ridges.
double height(double x, double z) {
    double sum = 0.0, weight = 1.0, amplitude = 0.55, frequency = 2.6;
    for (int octave = 0; octave < 9; ++octave) {
        const double noise = value_noise(x * frequency, z * frequency, octave);
        const double ridge = 1.0 - std::abs(2.0 * noise - 1.0);
        const double layer = octave < 1 ? noise : ridge * ridge;
        sum += amplitude * weight * layer;
        weight = std::clamp(1.5 * sum - 0.1, 0.0, 1.0);
        amplitude *= 0.44;
        frequency *= 2.03;
    }
    return kRelief * sum;
}

/// Squares along each side, so that the triangles are as near to what is asked for as can be.
size_t grid_size(const SceneOptions& options) {
    const auto tris = options.values.find("tris");
    if (tris == options.values.end()) return 224;
    const std::optional<double> count = count_value(tris->second);
    if (!count || *count < 1.0) {
        throw Error(ExitCode::WrongUsage, "terrain@tris=" + to_utf8(tris->second) +
                                              ": a number of triangles was expected, such as 500k or 10M");
    }
    if (*count > kMaxTriangles) {
        throw Error(ExitCode::WrongUsage,
                    "terrain@tris=" + to_utf8(tris->second) + ": at most 50M triangles can be made");
    }
    return static_cast<size_t>(std::max(1.0, std::round(std::sqrt(0.5 * *count))));
}

}  // namespace

void make_terrain(const SceneOptions& options, Scene& scene, Task& task) {
    const size_t size = grid_size(options);
    const size_t stride = size + 1;
    Mesh& mesh = scene.mesh;
    mesh.objects.push_back({"terrain", {0.42f, 0.40f, 0.28f}});
    mesh.positions.resize(stride * stride);
    mesh.triangles.resize(2 * size * size);
    mesh.object.assign(mesh.triangles.size(), 0);
    task.done = 0;
    task.total = mesh.positions.size();
    const auto vertex_at = [&](size_t i, size_t k) {
        const double x = static_cast<double>(i) / static_cast<double>(size);
        const double z = static_cast<double>(k) / static_cast<double>(size);
        return Vec3(DVec3((x - 0.5) * kSide, height(x, z), (z - 0.5) * kSide));
    };
    parallel_for(mesh.positions.size(), 1024, [&](size_t begin, size_t end) {
        if (task.stopped()) return;
        for (size_t v = begin; v < end; ++v) mesh.positions[v] = vertex_at(v % stride, v / stride);
        task.done += end - begin;
    });
    parallel_for(size, 16, [&](size_t begin, size_t end) {
        for (size_t k = begin; k < end && !task.stopped(); ++k) {
            for (size_t i = 0; i < size; ++i) {
                const auto v = static_cast<uint32_t>(k * stride + i),
                           below = static_cast<uint32_t>(v + stride);
                mesh.triangles[2 * (k * size + i)] = UVec3(v, below, v + 1);
                mesh.triangles[2 * (k * size + i) + 1] = UVec3(v + 1, below, below + 1);
            }
        }
    });
    scene.camera = Camera{.eye = {-38.0f, 40.0f, 70.0f}, .target = {1.0f, 5.0f, 0.0f}, .fov = 40.0f};
}

}  // namespace boxwood
