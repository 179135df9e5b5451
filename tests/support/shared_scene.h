#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/load_file.h"

namespace boxwood {

/// A scene of the folder of real scenes beside the sources; nothing where it is missing.
inline std::optional<Scene> shared_scene(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(BOXWOOD_SHARED_DIR) / "scenes" / name;
    if (!std::filesystem::exists(path)) return std::nullopt;
    Task task;
    return load_file(path.string(), task);
}

}  // namespace boxwood
