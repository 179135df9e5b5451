#pragma once

#include <string>
#include <vector>

namespace boxwood {

/// What the window remembers for its user from one run to the next.
struct Settings {
    static constexpr size_t kMaxRecent = 10;
    std::vector<std::string> recent;  ///< files opened, the last one first; absolute paths
    float interface_scale = 0.0f;     ///< 0: as the display asks

    /// Puts a file first.
    void add_recent(const std::string& path);
    bool operator==(const Settings&) const = default;
};

/// $XDG_CONFIG_HOME/boxwood/settings.json, ~/.config/boxwood/settings.json without that variable; empty if
/// there is no home either.
std::string settings_path();

/// What can be read of the file; the rest has its default. Never fails: settings are a comfort.
Settings load_settings(const std::string& path);

/// False if the file cannot be written.
bool save_settings(const Settings& settings, const std::string& path);

}  // namespace boxwood
