#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/render/image.h"

namespace boxwood {

/// Largest picture that is read: a hostile file can neither ask for more memory nor take long.
inline constexpr size_t kMaxPngPixels = size_t{1} << 25;

/// A picture and the session that it carries.
struct PngFile {
    Image image;
    std::string session_text;  ///< empty if the file carries none
};

/// The picture as a PNG file's bytes, with `session_text` (UTF-8; left out where empty) in an iTXt chunk
/// "boxwood-session". The picture has at least one pixel.
std::string encode_png(const Image& image, const std::string& session_text = {});

/// encode_png to a file, by write_file_atomically. Throws Error (WrongUsage) if it cannot be written.
void write_png(const std::string& path, const Image& image, const std::string& session_text = {});

/// Reads any PNG as 8-bit RGBA. Throws Error (BadInput) with the file's name if it is not a whole PNG, or
/// larger than kMaxPngPixels.
PngFile read_png(const std::string& path);

/// Whether a file that begins with these bytes is a PNG: at least 8 are needed.
bool has_png_signature(std::span<const std::byte> bytes);

}  // namespace boxwood
