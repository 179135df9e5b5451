#include "bench/stress_failure.h"

#include <bit>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "bench/stress_cases.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/measure/ray_file.h"

namespace boxwood::bench {

namespace {

void append(std::string& bytes, uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xffu);
}

std::string ply_of(const Mesh& mesh) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
        std::to_string(mesh.triangle_count()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis) append(bytes, std::bit_cast<uint32_t>(p[axis]));
    for (const UVec3& triangle : mesh.triangles) {
        bytes += '\3';
        for (int corner = 0; corner < 3; ++corner) append(bytes, triangle[corner]);
    }
    return bytes;
}

std::string stem_of(const StressFailure& failure) {
    std::string stem =
        failure.recipe + " " + failure.kind + (failure.mode == Mode::Exact ? " exact" : " fast");
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    return stem;
}

/// Between single quotes, for a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

}  // namespace

std::string save_failure(const StressFailure& failure, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(ExitCode::WrongUsage, folder + ": cannot be made: " + error.message());
    const StressCase test = failure.make(failure.seed, failure.ray_count);
    const std::string stem = (std::filesystem::path(folder) / stem_of(failure)).string();
    write_file_atomically(stem + ".ply", ply_of(test.mesh));
    write_file_atomically(stem + ".rays", ray_line("0", failure.ray) + "\n");
    return "boxwood cast " + quoted(stem + ".ply") + " --recipe " + quoted(failure.recipe) + " --mode " +
           (failure.mode == Mode::Exact ? "exact" : "fast") + " --rays " + quoted(stem + ".rays") + " -o -";
}

}  // namespace boxwood::bench
