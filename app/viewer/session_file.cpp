#include <array>
#include <filesystem>
#include <fstream>

#include "app/viewer/scene_path.h"
#include "app/viewer/session.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/render/png.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& sentence) {
    throw Error(ExitCode::BadInput, where + ": " + sentence);
}

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::array<char, 65536> block;
    while (file && text.size() <= kMostSessionBytes) {
        file.read(block.data(), block.size());
        text.append(block.data(), static_cast<size_t>(file.gcount()));
    }
    if (file.bad() || (!file && !file.eof())) refuse(path, "expected a file that can be read");
    return text;
}

}  // namespace

std::string session_folder(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::optional<Session> load_session(const std::string& path) {
    if (is_built_in(path) || !std::filesystem::is_regular_file(scene_file(path))) return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    std::array<char, 8> start{};
    file.read(start.data(), start.size());
    if (has_png_signature(std::as_bytes(std::span(start)))) {
        const std::string text = read_png(path).session_text;
        if (text.empty()) refuse(path, "expected a picture with a session in it; this one carries none");
        return parse_session(text, session_folder(path), path);
    }
    if (!file || start[0] == 0) return std::nullopt;
    const std::string text = read_file(path);
    if (!is_session_text(text)) return std::nullopt;
    return parse_session(text, session_folder(path), path);
}

void save_session(const Session& session, const std::string& path) {
    write_file_atomically(path, print_session(session, session_folder(path)));
}

}  // namespace boxwood
