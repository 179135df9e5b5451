#pragma once

#include <string>

namespace boxwood {

/// The clipboard of the interface: the window system's where there is a window, otherwise memory.
std::string clipboard();
void set_clipboard(const std::string& text);

}  // namespace boxwood
