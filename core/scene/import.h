#pragma once

#include "core/scene/readers.h"

namespace boxwood {

/// First argument of a process that imports for another; then the file's path and the number of the file
/// descriptor that takes the result.
inline constexpr const char* kImportWorkerArgument = "--import-worker";

/// Reads any other format through Assimp, in a child process (the running program again, with
/// kImportWorkerArgument) with a limit on time, processor time and memory. A crash, a hang or a refusal
/// becomes an Error (BadInput).
void read_by_import(const InputFile& file, Scene& scene, Task& task);

/// What `main` of every program that loads scenes calls first when argv[1] is kImportWorkerArgument; returns
/// the process's exit code.
int run_import_worker(int argc, char** argv);

}  // namespace boxwood
