#include "core/scene/load_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "core/base/timer.h"
#include "core/scene/import.h"
#include "core/scene/mesh_check.h"
#include "core/scene/readers.h"

namespace boxwood {
namespace {

std::string lower_extension(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

/// The first line that is no comment begins like a statement of OBJ.
bool looks_like_obj(const std::string& bytes) {
    const std::string_view text(bytes);
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        const std::string_view line = text.substr(at, end - at);
        at = end + 1;
        if (line.empty() || line[0] == '#') continue;
        for (const char* word : {"v ", "vn ", "vt ", "o ", "g ", "mtllib ", "usemtl ", "s "}) {
            if (line.starts_with(word)) return true;
        }
        return false;
    }
    return false;
}

using Reader = void (*)(const InputFile& file, Scene& scene, Task& task);

Reader choose_reader(const InputFile& file) {
    const std::string& bytes = file.bytes;
    if (bytes.starts_with("glTF")) return read_gltf;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return read_ply;
    const std::string extension = lower_extension(file.path);
    if (extension != ".obj" && is_stl(bytes)) return read_stl;
    const size_t start = bytes.find_first_not_of(" \t\r\n", bytes.starts_with("\xef\xbb\xbf") ? 3 : 0);
    if (start != std::string::npos && bytes[start] == '{') return read_gltf;
    if (extension == ".obj") return read_obj;
    if (extension == ".stl") return read_stl;
    if (extension == ".glb") file.fail_at_byte(0, "expected a GLB, which begins with glTF");
    if (extension == ".gltf") file.fail_at_byte(0, "expected JSON, which begins with {");
    if (extension == ".ply") file.fail_at_line(1, "expected the word ply");
    if (looks_like_obj(bytes)) return read_obj;
    return read_by_import;
}

/// Drops points that cannot be shown.
void check_points(PointCloud& points, Task& task) {
    size_t kept = 0;
    for (size_t i = 0; i < points.positions.size(); ++i) {
        const Vec3 p = points.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
        points.positions[kept] = p;
        if (!points.normals.empty()) points.normals[kept] = points.normals[i];
        ++kept;
    }
    task.skipped.add("non-finite point", points.positions.size() - kept);
    points.positions.resize(kept);
    if (!points.normals.empty()) points.normals.resize(kept);
}

}  // namespace

uint32_t add_object(Mesh& mesh, const std::string& name, const Vec3& base_color) {
    mesh.objects.push_back({to_utf8(name), base_color});
    return static_cast<uint32_t>(mesh.objects.size() - 1);
}

Scene load_file(const std::string& path, Task& task) {
    const Timer timer;
    Scene scene;
    {
        const InputFile file = read_input_file(path);
        Task reading(task.stop);  // counts of this file alone
        choose_reader(file)(file, scene, reading);
        const size_t read_count = scene.mesh.triangles.size();
        if (!task.stopped()) check_mesh(scene.mesh, reading);
        check_points(scene.mesh.points, reading);
        scene.skipped = reading.skipped.counts();
        if (!task.stopped() && scene.mesh.triangles.empty() && scene.mesh.points.positions.empty()) {
            file.fail(read_count == 0 ? "the scene has no triangles"
                                      : "nothing visible is left: all " + std::to_string(read_count) +
                                            " triangles have zero area or a vertex that is not finite");
        }
    }
    for (const auto& [reason, count] : scene.skipped) {
        task.skipped.add(reason, count);
        scene.warnings.push_back("left out " + std::to_string(count) + ": " + reason);
    }
    scene.title = to_utf8(std::filesystem::path(path).filename().string());
    scene.load_ms = timer.milliseconds();
    return scene;
}

}  // namespace boxwood
