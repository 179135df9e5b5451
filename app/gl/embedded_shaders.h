#pragma once

#include <vector>

namespace boxwood {

/// One file of shaders/, as the build embeds it.
struct EmbeddedShader {
    const char* name;
    const char* source;
};

/// Written by cmake/embed_shaders.cmake.
const std::vector<EmbeddedShader>& embedded_shaders();

}  // namespace boxwood
