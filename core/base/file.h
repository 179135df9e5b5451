#pragma once

#include <string>
#include <string_view>

namespace boxwood {

/// Replaces the file `path` by `content`: it is written to a temporary file beside it and renamed, so that a
/// killed program leaves the old file whole. A symbolic link is followed; what is no regular file (a device,
/// a pipe) is written to directly. Throws Error (WrongUsage) that names the file and the reason.
void write_file_atomically(const std::string& path, std::string_view content);

/// Throws Error (WrongUsage) where write_file_atomically would surely fail, so that long work is not begun in
/// vain: the folder is missing or not writable, or `path` is a folder.
void check_writable(const std::string& path);

}  // namespace boxwood
