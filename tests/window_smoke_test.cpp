// The real window on a virtual display of its own: Xvfb, with pointer and buttons by the XTest extension.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <link.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <string>

// clang-format off
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
// clang-format on

#include "app/viewer/window.h"
#include "core/base/timer.h"

// After all others: it defines words such as None.
#include <X11/extensions/XTest.h>
#include <X11/Xlib.h>

namespace boxwood {
namespace {

/// An X server without a screen, which chooses its own number; ends with the object.
class VirtualDisplay {
public:
    VirtualDisplay() {
        std::array<int, 2> pipe_ends{};
        if (pipe(pipe_ends.data()) != 0) return;
        const std::string descriptor = std::to_string(pipe_ends[1]);
        std::string name = "Xvfb", option = "-displayfd", screen = "-screen", zero = "0",
                    size = "1400x900x24";
        std::string silent = "-nolisten", tcp = "tcp";
        std::string number = descriptor;
        std::array<char*, 9> arguments{name.data(), option.data(), number.data(), screen.data(), zero.data(),
                                       size.data(), silent.data(), tcp.data(),    nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1 /* O_WRONLY */, 0);
        if (posix_spawnp(&server_, "Xvfb", &actions, nullptr, arguments.data(), environ) != 0) server_ = 0;
        posix_spawn_file_actions_destroy(&actions);
        close(pipe_ends[1]);
        std::array<char, 32> text{};
        size_t length = 0;
        while (server_ != 0 && length + 1 < text.size() && read(pipe_ends[0], &text[length], 1) == 1) {
            if (text[length] == '\n') break;
            ++length;
        }
        close(pipe_ends[0]);
        if (length > 0) name_ = ":" + std::string(text.data(), length);
    }
    ~VirtualDisplay() {
        if (server_ == 0) return;
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    const std::string& name() const { return name_; }  ///< empty: there is no server

private:
    pid_t server_ = 0;
    std::string name_;
};

/// Steps the window until the condition holds; false after twenty seconds.
bool step_until(Window& window, const std::function<bool()>& condition) {
    constexpr double kPatience = 20000.0;
    for (const Timer timer; timer.milliseconds() < kPatience;) {
        if (condition()) return true;
        window.step(0.02);
    }
    return condition();
}

/// Keeps every library that is loaded now until the process ends: the leak checker names what a driver of the
/// window system leaves behind by its library, so that it can be passed over.
void keep_libraries() {
    dl_iterate_phdr(
        [](dl_phdr_info* library, size_t, void*) {
            dlopen(library->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
            return 0;
        },
        nullptr);
}

TEST(WindowSmoke, StartsDrawsTakesADragOpensAFileAndQuits) {
    const VirtualDisplay display;
    if (display.name().empty()) GTEST_SKIP() << "Xvfb is not installed or does not start";
    setenv("DISPLAY", display.name().c_str(), 1);
    setenv("XDG_SESSION_TYPE", "x11", 1);

    Session session;
    session.state.scene = "cornell";
    session.state.side().recipe = "evh(t=8) > bvh-binned-sah";
    session.state.width = 1000;
    session.state.height = 560;
    Viewer viewer(session);
    Window window(viewer);
    ASSERT_TRUE(step_until(window, [&] { return viewer.built() != nullptr && !viewer.busy(); }));
    EXPECT_GT(window.frame_count(), 0u);

    // The slider of t, by pointer and button events of the X server.
    Display* x = XOpenDisplay(display.name().c_str());
    ASSERT_NE(x, nullptr);
    int left = 0, top = 0;
    glfwGetWindowPos(window.handle(), &left, &top);
    const auto point_to = [&](int px) {
        XTestFakeMotionEvent(x, -1, left + px, top + 151, 0);
        XFlush(x);
        for (int i = 0; i < 4; ++i) window.step(0.05);
    };
    const auto button = [&](bool down) {
        XTestFakeButtonEvent(x, 1, down ? 1 : 0, 0);
        XFlush(x);
        for (int i = 0; i < 4; ++i) window.step(0.05);
    };
    point_to(140);
    button(true);
    for (int px = 150; px <= 240; px += 15) point_to(px);
    button(false);
    XCloseDisplay(x);
    EXPECT_NE(viewer.state.side().recipe, session.state.side().recipe) << "the drag changed nothing";
    EXPECT_TRUE(step_until(window, [&] {
        return !viewer.busy() && print(viewer.built()->recipe) == viewer.state.side().recipe;
    })) << viewer.state.side().recipe;

    // A file dropped on the window: the callback that the window has registered.
    const GLFWdropfun drop = glfwSetDropCallback(window.handle(), nullptr);
    ASSERT_NE(drop, nullptr);
    const char* bad = "./there-is-no-such-file.glb";
    drop(window.handle(), 1, &bad);
    EXPECT_TRUE(step_until(window, [&] { return !viewer.message().empty(); }));
    EXPECT_EQ(viewer.state.scene, "cornell");
    const char* scene = "two-triangles";
    drop(window.handle(), 1, &scene);
    EXPECT_TRUE(step_until(window, [&] { return viewer.state.scene == "two-triangles" && !viewer.busy(); }));

    // Nothing changes: nothing is drawn.
    step_until(window, [&] { return !viewer.busy(); });
    for (int i = 0; i < 10; ++i) window.step(0.02);
    const uint64_t frames = window.frame_count();
    for (int i = 0; i < 5; ++i) window.step(0.02);
    EXPECT_EQ(window.frame_count(), frames);

    EXPECT_TRUE(window.step(0.0));
    glfwSetWindowShouldClose(window.handle(), 1);
    EXPECT_FALSE(window.step(0.0));
    EXPECT_EQ(window.messages().first_error, "");
    keep_libraries();
}

}  // namespace
}  // namespace boxwood
