#pragma once

#include <stdexcept>
#include <string>

namespace boxwood {

/// How the program ends. The numbers are the process's exit codes.
enum class ExitCode {
    Done = 0,
    CheckFailed = 1,  ///< a check did not hold
    WrongUsage = 2,   ///< an option, recipe or argument that is not understood
    BadInput = 3,     ///< a file that cannot be read; the message names file, place and what was expected
    NoDisplay = 4,    ///< no usable display or OpenGL
};

/// What is wrong with something that came from outside: one clear sentence and the exit code it leads to.
/// Only readers and writers of such input and the context classes throw it.
class Error : public std::runtime_error {
public:
    Error(ExitCode exit_code, const std::string& sentence)
        : std::runtime_error(sentence), exit_code_(exit_code) {}
    ExitCode exit_code() const { return exit_code_; }

private:
    ExitCode exit_code_;
};

}  // namespace boxwood
