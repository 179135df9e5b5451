#include "app/gl/context_glfw.h"

#include <glad/gl.h>
// glad stands before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>

#include "core/base/error.h"

namespace boxwood {
namespace {

/// What GLFW says about its last failure.
std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? std::string(": ") + text : std::string();
}

GLFWwindow* make_window(const std::string& title, int width, int height) {
    if (glfwInit() != GLFW_TRUE) {
        throw Error(ExitCode::NoDisplay, "no window can be opened" + glfw_reason());
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // everything is drawn into a RenderTarget, which has its own depth
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
        const std::string reason = glfw_reason();
        glfwTerminate();
        throw Error(ExitCode::NoDisplay, "no window with OpenGL 4.5 can be opened" + reason);
    }
    return window;
}

}  // namespace

GlfwContext::GlfwContext(const std::string& title, int width, int height)
    : window_(make_window(title, width, height)), messages_(std::make_unique<GlMessages>()) {
    glfwMakeContextCurrent(window_);
    try {
        start_gl(glfwGetProcAddress, *messages_);
    } catch (...) {
        glfwDestroyWindow(window_);
        glfwTerminate();
        throw;
    }
    glfwSwapInterval(1);
}

GlfwContext::~GlfwContext() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

std::string GlfwContext::renderer_name() const {
    const GLubyte* name = glGetString(GL_RENDERER);
    return name != nullptr ? std::string(reinterpret_cast<const char*>(name)) : std::string();
}

void GlfwContext::swap() { glfwSwapBuffers(window_); }

}  // namespace boxwood
