#pragma once

#include "core/base/task.h"
#include "core/scene/input_file.h"
#include "core/scene/scene.h"

namespace boxwood {

// One function for each file format, called by load_file. Each fills scene.mesh (positions, triangles,
// object, objects, points; not yet checked) and scene.warnings, throws Error (BadInput) where the file breaks
// its format's rules, allocates nothing for a count that the file merely claims, and leaves an unfinished
// mesh when the task was stopped.

/// glTF 2.0, text or binary, by tinygltf. Khronos, "glTF 2.0 Specification", 2.0.1.
void read_gltf(const InputFile& file, Scene& scene, Task& task);
/// Wavefront OBJ by tinyobjloader; materials give the base colour (Kd, taken as linear RGB).
void read_obj(const InputFile& file, Scene& scene, Task& task);
/// PLY 1.0: Turk, "The PLY Polygon File Format", 1994. Vertices without faces become points.
void read_ply(const InputFile& file, Scene& scene, Task& task);
/// STL, binary or text; corners are not shared.
void read_stl(const InputFile& file, Scene& scene, Task& task);

/// Appends one object and returns its index; the name may be any bytes.
uint32_t add_object(Mesh& mesh, const std::string& name, const Vec3& base_color = Vec3(0.8f));

/// Whether the bytes are an STL: 84 + 50 n of them with n as declared, or text that begins with "solid".
bool is_stl(const std::string& bytes);

}  // namespace boxwood
