#pragma once

#include <cstdint>
#include <string>

#include "core/scene/import.h"

namespace boxwood {

inline constexpr int kImportDescriptor = 3;  ///< where a worker writes its result

/// Limits of one import, from the size of its file in bytes.
uint64_t import_seconds(uint64_t file_size);
uint64_t import_memory(uint64_t file_size);

/// Whether Assimp has an importer for the name's extension.
bool is_known_to_import(const std::string& path);

/// What a worker sends: a mesh, or a sentence that says why there is none.
std::string write_import_stream(const Mesh& mesh);
std::string write_import_failure(const std::string& sentence);

/// Reads it back, trusting none of it. Throws Error (BadInput) for the worker's sentence, for a stream that
/// was cut short, and for indices out of range.
void read_import_stream(const InputFile& file, const std::string& stream, Scene& scene);

}  // namespace boxwood
