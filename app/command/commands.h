#pragma once

#include <span>
#include <string>

#include "core/base/error.h"

namespace boxwood {

/// What is typed after the command's name.
using Arguments = std::span<const std::string>;

/// One command of the program.
struct Command {
    const char* name;
    const char* summary;  ///< for the list in `boxwood --help`
    /// Returns Done or CheckFailed. Throws Error.
    ExitCode (*run)(Arguments arguments);
};

/// All commands, in the order of the help.
std::span<const Command> commands();

/// Runs `boxwood ARGUMENTS`: a command, --help, --version; without a command: view.
ExitCode run_program(Arguments arguments);

ExitCode run_bench(Arguments arguments);
ExitCode run_bench_amortize(Arguments arguments);
ExitCode run_bench_builds(Arguments arguments);
ExitCode run_bench_collapse(Arguments arguments);
ExitCode run_bench_error(Arguments arguments);
ExitCode run_bench_interact(Arguments arguments);
ExitCode run_bench_lecture(Arguments arguments);
ExitCode run_bench_measures(Arguments arguments);
ExitCode run_bench_peers(Arguments arguments);
ExitCode run_bench_refit(Arguments arguments);
ExitCode run_bench_scale(Arguments arguments);
ExitCode run_bench_trees(Arguments arguments);
ExitCode run_cast(Arguments arguments);
ExitCode run_check(Arguments arguments);
ExitCode run_list(Arguments arguments);
ExitCode run_scenes(Arguments arguments);
ExitCode run_shot(Arguments arguments);
ExitCode run_stats(Arguments arguments);
ExitCode run_stress(Arguments arguments);
ExitCode run_trace(Arguments arguments);
ExitCode run_verify(Arguments arguments);
ExitCode run_view(Arguments arguments);

}  // namespace boxwood
