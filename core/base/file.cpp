#include "core/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/base/descriptor.h"
#include "core/base/error.h"

namespace boxwood {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw Error(ExitCode::WrongUsage, path + ": cannot be written: " + reason);
}

bool write_all(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        content.remove_prefix(static_cast<size_t>(written));
    }
    return true;
}

/// Where a chain of symbolic links ends; the path itself where it is none.
std::string followed(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) return path;
    const std::filesystem::path target = std::filesystem::weakly_canonical(path, error);
    return error ? path : target.string();
}

std::string folder_of(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

}  // namespace

void write_file_atomically(const std::string& path, std::string_view content) {
    if (path.empty()) refuse("\"\"", "the name is empty");
    const std::string target = followed(path);
    struct stat old {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) refuse(path, "it is a folder");
    if (exists && !S_ISREG(old.st_mode)) {
        Descriptor device(::open(target.c_str(), O_WRONLY | O_CLOEXEC));
        if (device.number() < 0 || !write_all(device.number(), content) || !device.close())
            refuse(path, std::strerror(errno));
        return;
    }
    const std::string temporary = target + ".part-" + std::to_string(::getpid());
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (file.number() < 0) refuse(path, std::strerror(errno));
    if (exists) static_cast<void>(::fchmod(file.number(), old.st_mode & 07777));
    if (!write_all(file.number(), content) || !file.close() ||
        ::rename(temporary.c_str(), target.c_str()) != 0) {
        const std::string reason = std::strerror(errno);
        ::unlink(temporary.c_str());
        refuse(path, reason);
    }
}

void check_writable(const std::string& path) {
    if (path.empty()) refuse("\"\"", "the name is empty");
    const std::string target = followed(path);
    struct stat old {};
    const bool exists = ::stat(target.c_str(), &old) == 0;
    if (exists && S_ISDIR(old.st_mode)) refuse(path, "it is a folder");
    const bool to_device = exists && !S_ISREG(old.st_mode);
    if (::access(to_device ? target.c_str() : folder_of(target).c_str(), W_OK) != 0)
        refuse(path, std::strerror(errno));
}

}  // namespace boxwood
