#include "core/scene/import.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/descriptor.h"
#include "core/scene/import_stream.h"

namespace boxwood {
namespace {

constexpr const char* kGuardVariable = "BOXWOOD_IMPORT_WORKER";  ///< a worker never starts another

/// The child: killed and waited for at the latest when this goes.
class Child {
public:
    explicit Child(pid_t id) : id_(id) {}
    ~Child() { finish(true); }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    /// The status of waitpid.
    int finish(bool must_kill) {
        if (id_ == 0) return status_;
        if (must_kill) ::kill(id_, SIGKILL);
        while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
        }
        id_ = 0;
        return status_;
    }

private:
    pid_t id_;
    int status_ = 0;
};

/// Starts this program again as a worker whose descriptor kImportDescriptor is `result`.
pid_t start_worker(const InputFile& file, int result) {
    const std::string descriptor = std::to_string(kImportDescriptor);
    std::vector<std::string> words = {"boxwood", kImportWorkerArgument, file.path, descriptor};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::string guard = std::string(kGuardVariable) + "=1";
    std::vector<char*> environment;
    for (char** variable = environ; *variable != nullptr; ++variable) environment.push_back(*variable);
    environment.push_back(guard.data());
    environment.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, result, kImportDescriptor);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t id = 0;
    const int error =
        ::posix_spawn(&id, "/proc/self/exe", &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) file.fail("the import process cannot be started: " + std::string(std::strerror(error)));
    return id;
}

/// All that the worker sends until it closes its end; fails on the time limit.
std::string receive(const InputFile& file, int source, Task& task) {
    const std::chrono::seconds limit(import_seconds(file.bytes.size()));
    const auto end = std::chrono::steady_clock::now() + limit;
    const uint64_t most = import_memory(file.bytes.size());
    std::string result;
    std::vector<char> piece(size_t{1} << 16);
    while (!task.stopped()) {
        pollfd wait{source, POLLIN, 0};
        const int ready = ::poll(&wait, 1, 50);
        if (std::chrono::steady_clock::now() > end)
            file.fail("the import took more than " + std::to_string(limit.count()) +
                      " seconds and was ended");
        if (ready <= 0) continue;
        const ssize_t count = ::read(source, piece.data(), piece.size());
        if (count == 0) break;
        if (count > 0) result.append(piece.data(), static_cast<size_t>(count));
        if (result.size() > most) file.fail("the import gives more data than its memory limit");
    }
    return result;
}

}  // namespace

void read_by_import(const InputFile& file, Scene& scene, Task& task) {
    if (std::getenv(kGuardVariable) != nullptr) file.fail("an import process cannot import again");
    if (!is_known_to_import(file.path))
        file.fail("the format is not known, expected glTF, OBJ, PLY, STL or what Assimp reads");
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) file.fail("no pipe to the import process");
    const Descriptor source(ends[0]);
    Descriptor sink(ends[1]);
    Child child(start_worker(file, sink.number()));
    sink.close();
    const std::string result = receive(file, source.number(), task);
    const int status = child.finish(task.stopped());
    if (task.stopped()) return;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        file.fail("the import took too much processor time and was ended");
    if (WIFSIGNALED(status))
        file.fail("the import crashed (" + std::string(strsignal(WTERMSIG(status))) +
                  ") or was ended by a limit");
    read_import_stream(file, result, scene);
}

}  // namespace boxwood
