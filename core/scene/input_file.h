#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace boxwood {

/// A scene file in memory, and how its readers say what is wrong with it.
struct InputFile {
    std::string path;
    std::string bytes;

    /// Throws Error (BadInput): "PATH: SENTENCE.".
    [[noreturn]] void fail(const std::string& sentence) const;
    [[noreturn]] void fail_at_line(uint64_t line, const std::string& sentence) const;
    [[noreturn]] void fail_at_byte(uint64_t offset, const std::string& sentence) const;
};

/// Reads a whole file. Throws Error (BadInput) for one that is missing, a folder, no regular file, empty, or
/// not readable.
InputFile read_input_file(const std::string& path);

/// A piece of a file as a message shows it: in quotes, valid UTF-8 without control characters, at most 40
/// bytes.
std::string in_quotes(std::string_view text);

/// Whether the file that `path` names lies inside the folder, links and ".." resolved.
bool is_inside_folder(const std::string& folder, const std::string& path);

/// The folder of a path; "." if it names none.
std::string folder_of(const std::string& path);

/// Little endian; all four bytes must be there.
uint32_t read_u32(const std::string& bytes, size_t at);

/// Parses one whole token, correctly rounded; "inf", "nan" and a leading '+' are accepted, what is too large
/// becomes infinity and what is too small zero. False if it is not a number: `value` is then unchanged.
bool parse_number(std::string_view token, float& value);
bool parse_number(std::string_view token, double& value);

}  // namespace boxwood
