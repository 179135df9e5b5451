#include "app/gl/gl_messages.h"

#include <glad/gl.h>

#include "core/base/error.h"

namespace boxwood {
namespace {

void GLAD_API_PTR take_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                               const GLchar* text, const void* user) {
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
    auto* messages = static_cast<GlMessages*>(const_cast<void*>(user));
    if (messages->error_count++ > 0) return;
    messages->first_error = length < 0 ? std::string(text) : std::string(text, static_cast<size_t>(length));
}

}  // namespace

void start_gl(GlProcAddress proc_address, GlMessages& messages) {
    const int version = gladLoadGL(proc_address);
    if (version == 0)
        throw Error(ExitCode::NoDisplay, "OpenGL has no functions: its driver cannot be loaded");
    if (version < GLAD_MAKE_VERSION(4, 5)) {
        throw Error(ExitCode::NoDisplay, "OpenGL 4.5 is needed, this driver has " +
                                             std::to_string(GLAD_VERSION_MAJOR(version)) + "." +
                                             std::to_string(GLAD_VERSION_MINOR(version)));
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(take_message, &messages);
}

}  // namespace boxwood
