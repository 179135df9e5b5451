# The one place for language level, warnings and sanitizers. Every target of ours links boxwood_options PRIVATE.
add_library(boxwood_options INTERFACE)
target_compile_features(boxwood_options INTERFACE cxx_std_20)
target_include_directories(boxwood_options INTERFACE "${CMAKE_SOURCE_DIR}")
target_compile_options(boxwood_options INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion
    -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual>
    -ffp-contract=off
    $<$<CONFIG:Release>:-O2>
    $<$<CONFIG:Debug>:-O1 -g1 -fno-omit-frame-pointer>)
# Vectors from SSE4 on: what is older is rare and gets plain numbers.
target_compile_definitions(boxwood_options INTERFACE HWY_DISABLED_TARGETS=HWY_SSSE3)
set(CMAKE_CXX_FLAGS_RELEASE "")
set(CMAKE_CXX_FLAGS_DEBUG "")
set(CMAKE_CXX_EXTENSIONS OFF)
if(BOXWOOD_WERROR)
    target_compile_options(boxwood_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(BOXWOOD_ASSERTS)
    target_compile_definitions(boxwood_options INTERFACE BOXWOOD_ASSERTS=1)
endif()
if(BOXWOOD_SANITIZE)
    list(JOIN BOXWOOD_SANITIZE "," boxwood_sanitizers)
    target_compile_options(boxwood_options INTERFACE
        -fsanitize=${boxwood_sanitizers} -fno-sanitize-recover=all)
    target_link_options(boxwood_options INTERFACE -fsanitize=${boxwood_sanitizers})
    # Leaks of Mesa's that are not ours.
    target_sources(boxwood_options INTERFACE
        $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${CMAKE_SOURCE_DIR}/cmake/sanitizer_options.cpp>)
    # g++ 12 warns falsely about initialised memory once the sanitizers have rewritten the code.
    target_compile_options(boxwood_options INTERFACE -Wno-maybe-uninitialized -Wno-stringop-overflow)
    if("thread" IN_LIST BOXWOOD_SANITIZE)
        target_compile_definitions(boxwood_options INTERFACE BOXWOOD_STD_THREADS=1)
    endif()
endif()

find_program(BOXWOOD_CCACHE ccache)
if(BOXWOOD_CCACHE)
    set(CMAKE_C_COMPILER_LAUNCHER "${BOXWOOD_CCACHE}")
    set(CMAKE_CXX_COMPILER_LAUNCHER "${BOXWOOD_CCACHE}")
endif()
