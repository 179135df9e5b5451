#include "core/scene/frame.h"

#include <charconv>

#include "core/base/error.h"
#include "core/scene/scene_spec.h"

namespace boxwood {
namespace {

constexpr const char* kKey = "frame";

std::optional<int> frame_number(const std::string& text, int count) {
    int frame = 0;
    const char* end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, frame);
    if (read.ec != std::errc() || read.ptr != end || frame < 0 || frame >= count) return std::nullopt;
    return frame;
}

std::string range_of(int count) { return "0 to " + std::to_string(count - 1); }

/// "kitchen": the names of all built-in scenes with frames.
std::string animated_names() {
    std::string names;
    for (const BuiltInScene& scene : built_in_scenes())
        if (scene.frame_count > 0) names += (names.empty() ? "" : ", ") + std::string(scene.name);
    return names;
}

}  // namespace

std::optional<SceneFrame> scene_frame(const std::string& spec) {
    try {
        const SceneSpec parsed = parse_scene_spec(spec);
        if (parsed.built_in == nullptr || parsed.built_in->frame_count == 0) return std::nullopt;
        const int count = parsed.built_in->frame_count;
        for (const SceneSuffix& suffix : parsed.suffixes) {
            if (suffix.key != kKey) continue;
            const std::optional<int> frame = frame_number(suffix.value, count);
            return frame ? std::optional(SceneFrame{*frame, count}) : std::nullopt;
        }
        return SceneFrame{0, count};
    } catch (const Error&) {
        return std::nullopt;  // open_scene will say what is wrong
    }
}

std::string with_frame(const std::string& spec, int frame) {
    const SceneSpec parsed = parse_scene_spec(spec);
    const int count = parsed.built_in == nullptr ? 0 : parsed.built_in->frame_count;
    if (count == 0) {
        throw Error(ExitCode::WrongUsage, "scene '" + to_utf8(spec) +
                                              "' has no frames; built-in scenes that " +
                                              "have some: " + animated_names());
    }
    if (frame < 0 || frame >= count) {
        throw Error(ExitCode::WrongUsage, "scene '" + to_utf8(spec) + "' has no frame " +
                                              std::to_string(frame) + ", but frames " + range_of(count));
    }
    std::string result = parsed.base;
    if (frame > 0) result += "@" + std::string(kKey) + "=" + std::to_string(frame);
    for (const SceneSuffix& suffix : parsed.suffixes)
        if (suffix.key != kKey) result += "@" + suffix.key + "=" + suffix.value;
    return result;
}

int frame_option(const SceneOptions& options, const std::string& scene, int count) {
    const auto given = options.values.find(kKey);
    if (given == options.values.end()) return 0;
    const std::optional<int> frame = frame_number(given->second, count);
    if (frame) return *frame;
    throw Error(ExitCode::WrongUsage, scene + "@frame=" + to_utf8(given->second) +
                                          ": a whole number was expected, " + range_of(count));
}

}  // namespace boxwood
