#include "app/viewer/window.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

// clang-format off
#include <GLFW/glfw3.h>
// clang-format on

#include <algorithm>

#include "app/viewer/scene_path.h"

namespace boxwood {
namespace {

constexpr double kFrameTime = 1.0 / 60.0, kWatchTime = 0.5;  // seconds

Viewer& viewer_of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }

void on_drop(GLFWwindow* window, int count, const char** paths) {
    for (int i = 0; i < count; ++i) viewer_of(window).open(paths[i]);
}

}  // namespace

Window::Window(Viewer& viewer)
    : viewer_(viewer), context_("Boxwood", viewer.state.width, viewer.state.height) {
    glfwSetWindowUserPointer(handle(), &viewer_);
    glfwSetDropCallback(handle(), on_drop);
    ImGui_ImplGlfw_InitForOpenGL(handle(), /*install_callbacks=*/true);
}

Window::~Window() { ImGui_ImplGlfw_Shutdown(); }

void Window::use_display_scale() {
    float scale = viewer_.settings().interface_scale, unused = 1.0f;
    if (scale <= 0.0f) glfwGetWindowContentScale(handle(), &scale, &unused);
    viewer_.state.interface_scale = std::clamp(scale, 0.5f, 4.0f);
    viewer_.forget_steps();
}

void Window::wait_for_events(double patience) {
    double longest = viewer_.busy() ? kFrameTime : watching_ ? kWatchTime : -1.0;
    if (patience >= 0.0) longest = longest < 0.0 ? patience : std::min(longest, patience);
    if (frames_left_ > 0) {
        glfwPollEvents();
        return;
    }
    if (longest < 0.0) {
        glfwWaitEvents();
        frames_left_ = kFramesAfterInput;
        return;
    }
    const double begin = glfwGetTime();
    glfwWaitEventsTimeout(longest);
    if (glfwGetTime() - begin < 0.95 * longest) frames_left_ = kFramesAfterInput;
    if (viewer_.busy()) frames_left_ = std::max(frames_left_, 2);
}

void Window::look_at_file() {
    if (!watching_ || is_built_in(viewer_.state.scene)) return;
    const std::string file = scene_file(viewer_.state.scene);
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    if (error || (time == file_time_ && file == watched_file_)) return;
    if (file == watched_file_) {
        viewer_.reload();
        frames_left_ = kFramesAfterInput;
    }
    watched_file_ = file;
    file_time_ = time;
}

void Window::draw() {
    int width = 0, height = 0, window_width = 0, window_height = 0;
    glfwGetFramebufferSize(handle(), &width, &height);
    glfwGetWindowSize(handle(), &window_width, &window_height);
    if (width <= 0 || height <= 0 || window_width <= 0) return;  // minimised
    viewer_.state.width = std::clamp(width, 16, 8192);
    viewer_.state.height = std::clamp(height, 16, 8192);
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    const float ratio = static_cast<float>(width) / static_cast<float>(window_width);
    io.DisplayFramebufferScale = ImVec2(1.0f, 1.0f);
    if (ImGui::IsMousePosValid(&io.MousePos))
        io.MousePos = ImVec2(io.MousePos.x * ratio, io.MousePos.y * ratio);

    frame_.draw(viewer_);
    frame_.target().show(width, height);
    context_.swap();
    ++frame_count_;
    const std::string title = (viewer_.scene() ? viewer_.scene()->title : viewer_.state.scene) + " - Boxwood";
    if (title != title_) glfwSetWindowTitle(handle(), title.c_str());
    title_ = title;
    // Flying and dragging go on without further events.
    if (std::ranges::any_of(io.MouseDown, [](bool down) { return down; })) frames_left_ = 2;
}

bool Window::step(double patience) {
    wait_for_events(patience);
    look_at_file();
    if (frames_left_ > 0) {
        --frames_left_;
        draw();
    }
    return glfwWindowShouldClose(handle()) == 0;
}

void Window::run() {
    while (step()) viewer_.require_scene();
}

}  // namespace boxwood
