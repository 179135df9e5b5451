#pragma once

#include <chrono>
#include <filesystem>

#include "app/gl/context_glfw.h"
#include "app/viewer/frame.h"

namespace boxwood {

/// The window: passes input on to the frame, draws when something changed, sleeps otherwise.
class Window {
public:
    /// Throws Error (NoDisplay). `viewer` outlives the window.
    explicit Window(Viewer& viewer);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Waits for input or finished work, at most `patience` seconds (below 0: without end), and draws what
    /// changed. False once the user has closed the window.
    bool step(double patience = -1.0);
    /// Until the user closes the window. Throws Error where the first scene is refused.
    void run();
    /// The interface as large as the user left it, otherwise as the display asks.
    void use_display_scale();
    /// Opens the scene's file again whenever it changes.
    void watch(bool on) { watching_ = on; }

    GLFWwindow* handle() const { return context_.window(); }
    const GlMessages& messages() const { return context_.messages(); }
    uint64_t frame_count() const { return frame_count_; }

private:
    void wait_for_events(double patience);
    void look_at_file();
    void draw();

    static constexpr int kFramesAfterInput = 3;  ///< the interface settles within them
    Viewer& viewer_;
    GlfwContext context_;
    Frame frame_;
    int frames_left_ = kFramesAfterInput;
    uint64_t frame_count_ = 0;
    bool watching_ = false;
    std::string watched_file_;
    std::filesystem::file_time_type file_time_{};  ///< of the watched file, when it was last seen
    std::string title_;
};

}  // namespace boxwood
