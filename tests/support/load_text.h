#pragma once

#include <string>

#include "core/base/error.h"
#include "core/scene/load_file.h"
#include "tests/support/temporary_folder.h"

namespace boxwood {

/// Loads a file of these bytes.
inline Scene load_bytes(const std::string& name, const std::string& bytes) {
    const TemporaryFolder folder;
    Task task;
    return load_file(folder.write(name, bytes), task);
}

/// What the error says that loading a file of these bytes ends with, without the file's name; empty for none.
inline std::string refusal_of(const std::string& name, const std::string& bytes) {
    try {
        load_bytes(name, bytes);
    } catch (const Error& error) {
        const std::string sentence = error.what();
        return sentence.substr(sentence.find(name + ": ") + name.size() + 2);
    }
    return {};
}

/// Corner `corner` of a triangle of the mesh.
inline Vec3 corner_of(const Mesh& mesh, size_t triangle, int corner) {
    return mesh.positions[mesh.triangles[triangle][corner]];
}

/// Sum of the areas of all triangles.
inline double area_of(const Mesh& mesh) {
    double area = 0.0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const DVec3 a(corner_of(mesh, t, 0)), b(corner_of(mesh, t, 1)), c(corner_of(mesh, t, 2));
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

}  // namespace boxwood
