#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace boxwood {

/// "@key=value" of a SCENE.
struct SceneSuffix {
    std::string key, value;

    bool operator==(const SceneSuffix&) const = default;
};

/// A SCENE taken apart.
struct SceneSpec {
    const BuiltInScene* built_in = nullptr;  ///< nullptr: a file
    std::string base;                        ///< path of the file or name of the built-in
    std::vector<SceneSuffix> suffixes;       ///< in the order given

    bool operator==(const SceneSpec&) const = default;
};

/// Takes `spec` apart. Up to the first '@' it may be a built-in name; otherwise the longest part that exists
/// as a path is the file (a file's name may hold '@'), or the part up to the first '@' if none does. Throws
/// Error (WrongUsage) for a suffix without '='.
SceneSpec parse_scene_spec(const std::string& spec);

}  // namespace boxwood
