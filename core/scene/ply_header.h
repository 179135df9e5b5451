#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/input_file.h"

namespace boxwood {

enum class PlyType : uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };
enum class PlyFormat : uint8_t { Ascii, LittleEndian, BigEndian };

/// Bytes of one value in a binary file.
size_t ply_type_size(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float;
    bool is_list = false;
    PlyType count_type = PlyType::UInt8;  ///< of a list's length
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    size_t body = 0;         ///< offset of the first byte after the header
    uint64_t body_line = 0;  ///< its line number, from 1
};

/// Throws Error (BadInput) with the line. Line ends: LF, CR LF or CR.
PlyHeader parse_ply_header(const InputFile& file);

}  // namespace boxwood
