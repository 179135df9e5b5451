#pragma once

#include <string>

namespace boxwood {

/// What a measured number depends on beside the program's text.
struct Machine {
    std::string cpu;  ///< "unknown" where the system does not say
    int cores = 0;    ///< hardware threads
    std::string compiler;
    std::string build_type;  ///< with the sanitizers, if any
};

Machine this_machine();

/// The commit this program was built from, with "-dirty" where files differed from it; "unknown" outside git.
std::string build_commit();

/// "0.1.0"
std::string build_version();

}  // namespace boxwood
