#pragma once

#include <string>

namespace boxwood {

/// Whether the spec names a built-in scene and not a file.
bool is_built_in(const std::string& spec);

/// The file that a spec names, without suffixes; for a built-in its name.
std::string scene_file(const std::string& spec);

/// The spec of a file, relative to `folder`; both are relative to the current folder or absolute.
std::string relative_spec(const std::string& spec, const std::string& folder);

}  // namespace boxwood
