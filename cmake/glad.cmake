# The OpenGL loader, generated into the build folder from the specification that Debian's python3-glad brings.
find_program(BOXWOOD_GLAD_GENERATOR glad REQUIRED)
set(boxwood_glad_folder "${CMAKE_BINARY_DIR}/glad")
add_custom_command(
    OUTPUT "${boxwood_glad_folder}/src/gl.c" "${boxwood_glad_folder}/include/glad/gl.h"
    COMMAND "${BOXWOOD_GLAD_GENERATOR}" --quiet --reproducible --api gl:core=4.5 --extensions ""
            --out-path "${boxwood_glad_folder}" c
    COMMENT "Generating the OpenGL 4.5 loader"
    VERBATIM)
add_library(boxwood_glad STATIC
    "${boxwood_glad_folder}/src/gl.c"
    "${boxwood_glad_folder}/include/glad/gl.h")
target_include_directories(boxwood_glad SYSTEM PUBLIC "${boxwood_glad_folder}/include")
target_link_libraries(boxwood_glad PRIVATE boxwood_options)
