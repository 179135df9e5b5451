#include "app/viewer/settings.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"

namespace boxwood {

void Settings::add_recent(const std::string& path) {
    std::error_code error;
    const std::string whole = std::filesystem::absolute(path, error).lexically_normal().string();
    std::erase(recent, whole);
    recent.insert(recent.begin(), whole);
    if (recent.size() > kMaxRecent) recent.resize(kMaxRecent);
}

std::string settings_path() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    if (config != nullptr && config[0] == '/') return std::string(config) + "/boxwood/settings.json";
    const char* home = std::getenv("HOME");
    return home != nullptr && home[0] == '/' ? std::string(home) + "/.config/boxwood/settings.json" : "";
}

Settings load_settings(const std::string& path) {
    Settings settings;
    std::ifstream file(path);
    const nlohmann::json json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) return settings;
    if (const auto recent = json.find("recent"); recent != json.end() && recent->is_array()) {
        for (const auto& entry : *recent) {
            if (entry.is_string() && settings.recent.size() < Settings::kMaxRecent) {
                settings.recent.push_back(entry.get<std::string>());
            }
        }
    }
    if (const auto scale = json.find("scale"); scale != json.end() && scale->is_number()) {
        const float value = scale->get<float>();
        if (value >= 0.5f && value <= 4.0f) settings.interface_scale = value;
    }
    return settings;
}

bool save_settings(const Settings& settings, const std::string& path) {
    if (path.empty()) return false;
    nlohmann::json json = {{"recent", settings.recent}};
    if (settings.interface_scale > 0.0f) json["scale"] = settings.interface_scale;
    std::error_code error;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), error);
    try {
        write_file_atomically(path,
                              json.dump(4, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const Error&) {
        return false;
    }
    return true;
}

}  // namespace boxwood
