#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include "app/command/commands.h"
#include "app/command/shared.h"
#include "core/scene/import.h"

int main(int argc, char** argv) {
    using boxwood::ExitCode;
    if (argc > 1 && std::strcmp(argv[1], boxwood::kImportWorkerArgument) == 0)
        return boxwood::run_import_worker(argc, argv);
    ExitCode result = ExitCode::Done;
    try {
        result = boxwood::run_program(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const boxwood::Error& error) {
        boxwood::print_error(error);
        result = error.exit_code();
    } catch (const std::bad_alloc&) {
        std::fputs("boxwood: there is not enough memory for this\n", stderr);
        result = ExitCode::BadInput;
    }
    return static_cast<int>(result);
}
