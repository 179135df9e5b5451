# Run at every build: writes boxwood_build_info.h, and only where it changes, so that a commit compiles one file.
# -DSOURCE_DIR -DOUTPUT -DVERSION -DBUILD_TYPE
find_package(Git QUIET)
set(commit "unknown")
if(GIT_FOUND)
    execute_process(
        COMMAND "${GIT_EXECUTABLE}" describe --always --dirty --abbrev=12 --exclude=*
        WORKING_DIRECTORY "${SOURCE_DIR}"
        OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
        RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed)
        set(commit "${described}")
    endif()
endif()
set(text "#pragma once

#define BOXWOOD_COMMIT \"${commit}\"
#define BOXWOOD_VERSION \"${VERSION}\"
#define BOXWOOD_BUILD_TYPE \"${BUILD_TYPE}\"
")
set(old "")
if(EXISTS "${OUTPUT}")
    file(READ "${OUTPUT}" old)
endif()
if(NOT old STREQUAL text)
    file(WRITE "${OUTPUT}" "${text}")
endif()
