#pragma once

#include <string>

#include "core/base/task.h"
#include "core/scene/scene.h"

namespace boxwood {

/// Reads a scene file of any known format, told apart by its content. The mesh has passed check_mesh. Throws
/// Error (BadInput) with file, place and what was expected.
Scene load_file(const std::string& path, Task& task);

}  // namespace boxwood
