#include <gtest/gtest.h>

#include <cstring>

#include "core/scene/import.h"

/// As GTest's own, but an import runs this program again as its worker.
int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], boxwood::kImportWorkerArgument) == 0)
        return boxwood::run_import_worker(argc, argv);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
