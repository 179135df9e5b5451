#include "core/scene/input_file.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

double to_number(const char* text, char** end, double) { return std::strtod(text, end); }
float to_number(const char* text, char** end, float) { return std::strtof(text, end); }

template <class Number>
bool parse_any(std::string_view token, Number& value) {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
    Number parsed{};
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), parsed);
    if (error == std::errc::invalid_argument || end != token.data() + token.size()) return false;
    if (error == std::errc::result_out_of_range) {  // leaves open whether infinity or zero is nearest
        parsed = to_number(std::string(token).c_str(), nullptr, Number{});
    }
    value = parsed;
    return true;
}

}  // namespace

void InputFile::fail(const std::string& sentence) const {
    throw Error(ExitCode::BadInput, to_utf8(path) + ": " + sentence + ".");
}

void InputFile::fail_at_line(uint64_t line, const std::string& sentence) const {
    fail("line " + std::to_string(line) + ": " + sentence);
}

void InputFile::fail_at_byte(uint64_t offset, const std::string& sentence) const {
    fail("byte " + std::to_string(offset) + ": " + sentence);
}

uint32_t read_u32(const std::string& bytes, size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value |= uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

InputFile read_input_file(const std::string& path) {
    InputFile file{path, {}};
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) file.fail("there is no such file");
    if (fs::is_directory(status)) file.fail("this is a folder, expected a scene file");
    if (!fs::is_regular_file(status)) file.fail("this is not a regular file, expected a scene file");
    const uintmax_t size = fs::file_size(path, error);
    if (error) file.fail("the file cannot be read: " + error.message());
    if (size == 0) file.fail("the file is empty");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) file.fail("the file cannot be opened for reading");
    file.bytes.resize(size);
    stream.read(file.bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<uintmax_t>(stream.gcount()) != size) file.fail("the file cannot be read to its end");
    return file;
}

std::string in_quotes(std::string_view text) {
    constexpr size_t kLongest = 40;
    std::string shown(text.substr(0, kLongest));
    for (char& c : shown) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return "\"" + to_utf8(shown) + (text.size() > kLongest ? "...\"" : "\"");
}

bool is_inside_folder(const std::string& folder, const std::string& path) {
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder, error);
    if (error) return false;
    const fs::path target = fs::weakly_canonical(path, error);
    if (error) return false;
    const fs::path inside = target.lexically_relative(root);
    return !inside.empty() && inside != "." && *inside.begin() != "..";
}

std::string folder_of(const std::string& path) {
    const std::string folder = fs::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

bool parse_number(std::string_view token, float& value) { return parse_any(token, value); }
bool parse_number(std::string_view token, double& value) { return parse_any(token, value); }

}  // namespace boxwood
