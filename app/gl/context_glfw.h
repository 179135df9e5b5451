#pragma once

#include <memory>
#include <string>

#include "app/gl/gl_messages.h"

struct GLFWwindow;

namespace boxwood {

/// A window with an OpenGL 4.5 core context, current in the thread that made it. One at a time.
class GlfwContext {
public:
    /// Width and height in screen coordinates. Throws Error (NoDisplay) that says why there is no window.
    GlfwContext(const std::string& title, int width, int height);
    ~GlfwContext();
    GlfwContext(const GlfwContext&) = delete;
    GlfwContext& operator=(const GlfwContext&) = delete;

    GLFWwindow* window() const { return window_; }
    const GlMessages& messages() const { return *messages_; }
    /// The vendor's name for what draws, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer_name() const;
    /// Shows what was drawn.
    void swap();

private:
    GLFWwindow* window_ = nullptr;
    std::unique_ptr<GlMessages> messages_;
};

}  // namespace boxwood
