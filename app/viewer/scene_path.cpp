#include "app/viewer/scene_path.h"

#include <filesystem>

#include "core/base/error.h"
#include "core/scene/scene_spec.h"

namespace boxwood {
namespace {

SceneSpec taken_apart(const std::string& spec) {
    try {
        return parse_scene_spec(spec);
    } catch (const Error&) {
        return {.built_in = nullptr, .base = spec, .suffixes = {}};  // open_scene will say what is wrong
    }
}

}  // namespace

bool is_built_in(const std::string& spec) { return taken_apart(spec).built_in != nullptr; }

std::string scene_file(const std::string& spec) { return taken_apart(spec).base; }

std::string relative_spec(const std::string& spec, const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path whole = fs::absolute(spec, error).lexically_normal();
    const fs::path base = fs::absolute(folder, error).lexically_normal();
    std::string relative = whole.lexically_relative(base).string();
    if (relative.empty()) relative = fs::path(spec).filename().string();
    return is_built_in(relative) ? "./" + relative : relative;
}

}  // namespace boxwood
