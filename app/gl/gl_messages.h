#pragma once

#include <string>

namespace boxwood {

/// What OpenGL reported through its message callback. An error here is our own mistake and fails a test.
struct GlMessages {
    std::string first_error;  ///< empty: none
    int error_count = 0;
};

/// Address of an OpenGL function of the current context.
using GlProcAddress = void (*(*)(const char* name))();

/// Loads the functions of the current context and lets its messages go to `messages`, which must outlive the
/// context. Throws Error (NoDisplay) where the context has less than OpenGL 4.5.
void start_gl(GlProcAddress proc_address, GlMessages& messages);

}  // namespace boxwood
