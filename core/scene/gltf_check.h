#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/scene/input_file.h"

namespace boxwood {

/// What a glTF document needs of the file around it.
struct GltfContainer {
    std::string_view json;
    std::string_view bin;  ///< the binary chunk of a GLB, empty if there is none
    bool is_binary = false;
};

/// Takes a GLB apart, or takes the whole file as JSON. Throws Error (BadInput) with the byte, also
/// for JSON nested so deep that a recursive reader would overflow the stack.
GltfContainer open_gltf_container(const InputFile& file);

/// Checks a document before any library reads it, and returns one that holds only what a scene is made of
/// (scenes, nodes, triangle meshes' positions and indices, base colours, accessors, buffers). In it
/// - every index names something that is there, and every range lies inside what it is a range of;
/// - integers are whole numbers, sizes fit, and no product or sum of them wraps;
/// - POSITION accessors are VEC3 of a type that the specification or KHR_mesh_quantization allows, index
///   accessors are unsigned SCALAR;
/// - nodes have one parent each and no cycle;
/// - buffers are the binary chunk, base64, or a file inside the folder of the scene, and as long as said.
/// Throws Error (BadInput) with the JSON path.
std::string checked_gltf(const InputFile& file, const GltfContainer& container);

}  // namespace boxwood
