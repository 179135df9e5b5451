#pragma once

#include <string>

#include "bench/stress.h"

namespace boxwood::bench {

/// Writes the case as `STEM.ply` (binary, little-endian: no bit is lost) and the ray as `STEM.rays`, as
/// `boxwood cast` reads them, into the folder, which is made; STEM is recipe, kind and mode with '-' for what
/// is no letter or digit. Returns the `boxwood cast` line that casts the ray again. Throws Error (WrongUsage)
/// for a folder that cannot be written.
std::string save_failure(const StressFailure& failure, const std::string& folder);

}  // namespace boxwood::bench
