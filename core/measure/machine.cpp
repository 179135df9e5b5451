#include "core/measure/machine.h"

#include <fstream>
#include <thread>

#include "boxwood_build_info.h"

namespace boxwood {
namespace {

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace

Machine this_machine() {
    return {cpu_name(), static_cast<int>(std::thread::hardware_concurrency()), compiler_name(),
            BOXWOOD_BUILD_TYPE};
}

std::string build_commit() { return BOXWOOD_COMMIT; }
std::string build_version() { return BOXWOOD_VERSION; }

}  // namespace boxwood
