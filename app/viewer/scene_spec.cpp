#include "app/viewer/scene_spec.h"

#include <algorithm>
#include <filesystem>

#include "core/scene/scene.h"

namespace boxwood {

std::pair<std::string, std::string> split_spec(const std::string& spec) {
    for (size_t at = spec.find('@'); at != std::string::npos; at = spec.find('@', at + 1)) {
        size_t end = at + 1;
        while (end < spec.size() && spec[end] >= 'a' && spec[end] <= 'z') ++end;
        if (end > at + 1 && end < spec.size() && spec[end] == '=')
            return {spec.substr(0, at), spec.substr(at)};
    }
    return {spec, ""};
}

bool is_built_in(const std::string& spec) {
    const std::string name = split_spec(spec).first;
    return std::ranges::any_of(built_in_scenes(),
                               [&](const BuiltInScene& scene) { return name == scene.name; });
}

std::string relative_spec(const std::string& spec, const std::string& folder) {
    namespace fs = std::filesystem;
    const auto [path, suffix] = split_spec(spec);
    std::error_code error;
    const fs::path whole = fs::absolute(path, error).lexically_normal();
    const fs::path base = fs::absolute(folder, error).lexically_normal();
    std::string relative = whole.lexically_relative(base).string();
    if (relative.empty()) relative = fs::path(path).filename().string();
    if (is_built_in(relative)) relative = "./" + relative;
    return relative + suffix;
}

}  // namespace boxwood
