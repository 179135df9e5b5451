#include "core/scene/scene_spec.h"

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"

namespace boxwood {
namespace {

bool path_exists(const std::string& path) {
    std::error_code error;
    return !path.empty() && std::filesystem::exists(path, error);
}

std::vector<SceneSuffix> parse_suffixes(std::string text) {
    std::vector<SceneSuffix> suffixes;
    while (!text.empty()) {
        const size_t end = std::min(text.find('@', 1), text.size());
        const std::string suffix = text.substr(1, end - 1);
        const size_t equals = suffix.find('=');
        if (equals == std::string::npos) {
            throw Error(ExitCode::WrongUsage,
                        "scene suffix '@" + to_utf8(suffix) + "': '@key=value' was expected");
        }
        suffixes.push_back({suffix.substr(0, equals), suffix.substr(equals + 1)});
        text.erase(0, end);
    }
    return suffixes;
}

}  // namespace

SceneSpec parse_scene_spec(const std::string& spec) {
    SceneSpec parsed;
    size_t end = std::min(spec.find('@'), spec.size());
    parsed.base = spec.substr(0, end);
    for (const BuiltInScene& scene : built_in_scenes())
        if (parsed.base == scene.name) parsed.built_in = &scene;
    if (parsed.built_in == nullptr) {
        for (size_t at = spec.size(); at != std::string::npos && at > 0; at = spec.rfind('@', at - 1)) {
            if (!path_exists(spec.substr(0, at))) continue;
            end = at;
            parsed.base = spec.substr(0, end);
            break;
        }
    }
    parsed.suffixes = parse_suffixes(spec.substr(end));
    return parsed;
}

}  // namespace boxwood
