#pragma once

#include <string>
#include <utility>

namespace boxwood {

/// A scene's spec taken apart: file or built-in name, and its suffixes from the first "@key=" on.
std::pair<std::string, std::string> split_spec(const std::string& spec);

/// Whether the spec names a built-in scene and not a file.
bool is_built_in(const std::string& spec);

/// The spec of a file, relative to `folder`; both are relative to the current folder or absolute.
std::string relative_spec(const std::string& spec, const std::string& folder);

}  // namespace boxwood
