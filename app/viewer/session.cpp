#include "app/viewer/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "app/viewer/scene_path.h"
#include "app/viewer/session_fields.h"
#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMaxNesting = 32;
constexpr size_t kMostHidden = 10000;

[[noreturn]] void refuse(const std::string& where, const std::string& sentence) {
    throw Error(ExitCode::BadInput, where + ": " + sentence);
}

/// Deepest nesting of brackets outside strings. The parser itself does not care, but printing recurses.
int nesting(const std::string& text) {
    int depth = 0, deepest = 0;
    bool in_string = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c == '"') in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            deepest = std::max(deepest, ++depth);
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return deepest;
}

/// What a JSON value is, in a sentence.
std::string kind_of(const Json& value) {
    if (value.is_number()) return "the number " + value.dump();
    if (value.is_string()) return "a text";
    return value.is_null()      ? "null"
           : value.is_boolean() ? value.dump()
                                : std::string("an ") + value.type_name();
}

/// Fills a session from a JSON object; what it reads it takes out of the object.
class Reader {
public:
    Reader(Json& object, const std::string& folder, const std::string& where)
        : object_(object), folder_(folder), where_(where) {}

    void scene(const char* key, std::string& value, const std::string& default_value) {
        text(key, value, default_value);
        if (is_built_in(value)) return;
        if (value.empty()) fail(key, "a scene's name", "an empty text");
        const std::filesystem::path path(value);
        if (path.is_absolute()) {
            refuse(where_, std::string("\"") + key + "\": expected a file relative to the session, got the " +
                               "absolute path \"" + value + "\"");
        }
        value = (std::filesystem::path(folder_) / path).lexically_normal().string();
        if (is_built_in(value)) value = "./" + value;
    }
    void text(const char* key, std::string& value, const std::string&) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_string()) fail(key, "a text", kind_of(*json));
        value = json->get<std::string>();
    }
    void flag(const char* key, bool& value, bool) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_boolean()) fail(key, "true or false", kind_of(*json));
        value = json->get<bool>();
    }
    template <class Enum>
    void choice(const char* key, Enum& value, Enum, std::span<const char* const> names) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        std::string expected = "one of";
        for (size_t i = 0; i < names.size(); ++i) {
            if (*json == names[i]) {
                value = static_cast<Enum>(i);
                return;
            }
            expected += std::string(i == 0 ? " \"" : ", \"") + names[i] + "\"";
        }
        fail(key, expected,
             json->is_string() ? json->dump(-1, ' ', false, Json::error_handler_t::replace) : kind_of(*json));
    }
    void number(const char* key, float& value, float, float lower, float upper) {
        if (const std::optional<Json> json = take(key)) value = as_number(key, *json, lower, upper);
    }
    void whole_number(const char* key, int& value, int, int lower, int upper) {
        if (const std::optional<Json> json = take(key)) value = as_int(key, *json, lower, upper);
    }
    void size(const char* key, int& width, int& height, int, int) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_array() || json->size() != 2) fail(key, "[width, height]", kind_of(*json));
        width = as_int(key, (*json)[0], 16, 8192);
        height = as_int(key, (*json)[1], 16, 8192);
    }
    void levels(const char* key, LevelRange& range, LevelRange) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_array() || json->size() != 2) fail(key, "[first, last]", kind_of(*json));
        range.first = as_int(key, (*json)[0], 0, LevelRange::kMaxLevel);
        range.last = as_int(key, (*json)[1], range.first, LevelRange::kMaxLevel);
    }
    void camera(const char* key, std::optional<Camera>& camera) {
        if (const std::optional<Json> json = take(key)) camera = as_camera(key, *json);
    }
    void views(const char* key, std::array<std::optional<Camera>, 9>& views) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_object()) fail(key, "an object of cameras, \"1\" to \"9\"", kind_of(*json));
        for (const auto& [name, value] : json->items()) {
            if (name.size() != 1 || name[0] < '1' || name[0] > '9') {
                refuse(where_, std::string("\"") + key + "\": expected keys \"1\" to \"9\"");
            }
            views[static_cast<size_t>(name[0] - '1')] = as_camera(key, value);
        }
    }
    void ray(const char* key, std::optional<PickedRay>& ray) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_object() || json->size() != 2 || !json->contains("origin") ||
            !json->contains("direction")) {
            fail(key, "an object with origin and direction", kind_of(*json));
        }
        ray = PickedRay{as_vec3(key, (*json)["origin"]), as_vec3(key, (*json)["direction"])};
        if (ray->direction == Vec3(0.0f)) fail(key, "a direction that is not zero", "[0, 0, 0]");
    }
    void index(const char* key, uint32_t& value) {
        if (const std::optional<Json> json = take(key)) value = as_index(key, *json);
    }
    void indices(const char* key, std::vector<uint32_t>& values) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_array() || json->size() > kMostHidden)
            fail(key, "at most " + std::to_string(kMostHidden) + " whole numbers", kind_of(*json));
        for (const Json& value : *json) values.push_back(as_index(key, value));
    }
    void limits(const char* key, CheckLimits& limits, const CheckLimits&) {
        const std::optional<Json> json = take(key);
        if (!json) return;
        if (!json->is_object()) fail(key, "an object", kind_of(*json));
        for (const auto& [name, value] : json->items()) {
            if (name == "difference") {
                limits.difference = as_int(key, value, 0, 255);
            } else if (name == "pixels") {
                limits.pixels = as_int(key, value, 0, 8192 * 8192);
            } else if (name == "tile_mean") {
                limits.tile_mean = static_cast<double>(as_number(key, value, 0.0f, 255.0f));
            } else {
                refuse(where_, std::string("\"") + key + "\": expected difference, pixels or tile_mean");
            }
        }
    }

private:
    std::optional<Json> take(const char* key) {
        const auto found = object_.find(key);
        if (found == object_.end()) return std::nullopt;
        Json value = std::move(*found);
        object_.erase(found);
        return value;
    }
    [[noreturn]] void fail(const char* key, const std::string& expected, const std::string& got) const {
        refuse(where_, std::string("\"") + key + "\": expected " + expected + ", got " + got);
    }
    int as_int(const char* key, const Json& json, int lower, int upper) const {
        const std::string expected =
            "a whole number from " + std::to_string(lower) + " to " + std::to_string(upper);
        if (!json.is_number_integer()) fail(key, expected, kind_of(json));
        const bool too_big = json.is_number_unsigned() && json.get<uint64_t>() > static_cast<uint64_t>(upper);
        if (too_big || json.get<int64_t>() < lower || json.get<int64_t>() > upper) {
            fail(key, expected, kind_of(json));
        }
        return json.get<int>();
    }
    uint32_t as_index(const char* key, const Json& json) const {
        return static_cast<uint32_t>(as_int(key, json, 0, std::numeric_limits<int>::max()));
    }
    float as_number(const char* key, const Json& json, float lower, float upper) const {
        const double value = json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
        if (!(value >= static_cast<double>(lower) && value <= static_cast<double>(upper))) {
            fail(key, "a number from " + Json(lower).dump() + " to " + Json(upper).dump(), kind_of(json));
        }
        return static_cast<float>(value);
    }
    Vec3 as_vec3(const char* key, const Json& json) const {
        if (!json.is_array() || json.size() != 3) fail(key, "three numbers", kind_of(json));
        constexpr float kFar = 1e30f;
        const float x = as_number(key, json[0], -kFar, kFar), y = as_number(key, json[1], -kFar, kFar),
                    z = as_number(key, json[2], -kFar, kFar);
        return {x, y, z};
    }
    Camera as_camera(const char* key, const Json& json) const {
        if (!json.is_object()) fail(key, "an object with eye and target", kind_of(json));
        Camera camera;
        bool has_eye = false, has_target = false;
        for (const auto& [name, value] : json.items()) {
            if (name == "eye") {
                camera.eye = as_vec3(key, value), has_eye = true;
            } else if (name == "target") {
                camera.target = as_vec3(key, value), has_target = true;
            } else if (name == "up") {
                camera.up = as_vec3(key, value);
            } else if (name == "fov") {
                camera.fov = as_number(key, value, 1.0f, 170.0f);
            } else if (name == "orthographic") {
                if (!value.is_boolean()) fail(key, "orthographic: true or false", kind_of(value));
                camera.orthographic = value.get<bool>();
            } else {
                refuse(where_, std::string("\"") + key + "\": expected eye, target, up, fov or orthographic");
            }
        }
        if (!has_eye || !has_target) fail(key, "both eye and target", "one of them or none");
        return camera;
    }

    Json& object_;
    const std::string& folder_;
    const std::string& where_;
};

/// The number whose digits are the shortest that give the same float again.
Json short_number(float value) {
    char digits[32];
    for (int precision = 1; precision <= 9; ++precision) {
        std::snprintf(digits, sizeof digits, "%.*g", precision, static_cast<double>(value));
        if (std::strtof(digits, nullptr) == value) break;
    }
    return std::strtod(digits, nullptr);
}

/// Adds to a JSON object what differs from its default.
class Writer {
public:
    Writer(Json& object, const std::string& folder) : object_(object), folder_(folder) {}

    void scene(const char* key, const std::string& value, const std::string& default_value) {
        if (value == default_value) return;
        object_[key] = is_built_in(value) ? value : relative_spec(value, folder_);
    }
    void text(const char* key, const std::string& value, const std::string& default_value) {
        if (value != default_value) object_[key] = value;
    }
    void flag(const char* key, bool value, bool default_value) {
        if (value != default_value) object_[key] = value;
    }
    template <class Enum>
    void choice(const char* key, Enum value, Enum default_value, std::span<const char* const> names) {
        if (value != default_value) object_[key] = names[static_cast<size_t>(value)];
    }
    void number(const char* key, float value, float default_value, float, float) {
        if (value != default_value) object_[key] = short_number(value);
    }
    void whole_number(const char* key, int value, int default_value, int, int) {
        if (value != default_value) object_[key] = value;
    }
    void size(const char* key, int width, int height, int default_width, int default_height) {
        if (width != default_width || height != default_height) object_[key] = {width, height};
    }
    void levels(const char* key, LevelRange range, LevelRange default_range) {
        if (!(range == default_range)) object_[key] = {range.first, range.last};
    }
    void camera(const char* key, const std::optional<Camera>& camera) {
        if (camera) object_[key] = camera_json(*camera);
    }
    void views(const char* key, const std::array<std::optional<Camera>, 9>& views) {
        for (size_t i = 0; i < views.size(); ++i) {
            if (views[i]) object_[key][std::to_string(i + 1)] = camera_json(*views[i]);
        }
    }
    void ray(const char* key, const std::optional<PickedRay>& ray) {
        if (ray)
            object_[key] = {{"origin", vec3_json(ray->origin)}, {"direction", vec3_json(ray->direction)}};
    }
    void index(const char* key, uint32_t value) {
        if (value != kNoIndex) object_[key] = value;
    }
    void indices(const char* key, const std::vector<uint32_t>& values) {
        if (!values.empty()) object_[key] = values;
    }
    void limits(const char* key, const CheckLimits& limits, const CheckLimits& default_limits) {
        if (limits.difference != default_limits.difference) object_[key]["difference"] = limits.difference;
        if (limits.pixels != default_limits.pixels) object_[key]["pixels"] = limits.pixels;
        if (limits.tile_mean != default_limits.tile_mean) object_[key]["tile_mean"] = limits.tile_mean;
    }

private:
    static Json vec3_json(const Vec3& v) {
        return Json::array({short_number(v.x), short_number(v.y), short_number(v.z)});
    }
    static Json camera_json(const Camera& camera) {
        const Camera defaults;
        Json json = {{"eye", vec3_json(camera.eye)}, {"target", vec3_json(camera.target)}};
        if (camera.up != defaults.up) json["up"] = vec3_json(camera.up);
        if (camera.fov != defaults.fov) json["fov"] = short_number(camera.fov);
        if (camera.orthographic) json["orthographic"] = true;
        return json;
    }

    Json& object_;
    const std::string& folder_;
};

Json parse_json(const std::string& text, const std::string& where) {
    if (text.size() > kMostSessionBytes) refuse(where, "expected a session of at most 16 MiB");
    if (nesting(text) > kMaxNesting) refuse(where, "expected JSON nested at most 32 levels deep");
    try {
        return Json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        std::string what = error.what();  // "[json.exception.parse_error.101] parse error at line 1, ..."
        if (const size_t end = what.find("] "); end != std::string::npos) what.erase(0, end + 2);
        refuse(where, "expected a session as JSON: " + to_utf8(what));
    }
}

}  // namespace

bool is_session_text(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string::npos && text[first] == '{' && text.find("\"asset\"") == std::string::npos;
}

Session parse_session(const std::string& text, const std::string& folder, const std::string& where) {
    Json json = parse_json(text, where);
    if (!json.is_object()) refuse(where, "expected a session, a JSON object; got " + kind_of(json));
    if (!json.contains("version")) refuse(where, "expected \"version\": 1, which is missing");
    if (json["version"] != 1) {
        refuse(where, "\"version\": expected 1, got " + kind_of(json["version"]));
    }
    json.erase("version");
    Session session;
    Reader reader(json, folder, where);
    describe_session(reader, session, Session{});
    for (const auto& [key, value] : json.items()) {
        session.notes.push_back("unknown key \"" + key + "\" is kept, but has no effect");
    }
    session.unknown = json.dump();
    return session;
}

std::string print_session(const Session& session, const std::string& folder) {
    Json json = {{"version", 1}};
    Session copy = session;
    Writer writer(json, folder);
    describe_session(writer, copy, Session{});
    const Json unknown = Json::parse(session.unknown);
    for (const auto& [key, value] : unknown.items()) json[key] = value;
    return json.dump(4, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace boxwood
