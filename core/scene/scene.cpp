#include "core/scene/scene.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/base/array.h"
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/scene/load_file.h"
#include "core/scene/mesh_check.h"
#include "core/scene/mesh_hash.h"
#include "core/scene/mesh_transform.h"
#include "core/scene/scene_spec.h"
#include "core/scene/subdivide.h"
#include "core/scene/suffix_value.h"

namespace boxwood {
namespace {

[[noreturn]] void refuse(const SceneSuffix& suffix, const std::string& expected) {
    throw Error(ExitCode::WrongUsage, "scene suffix '@" + to_utf8(suffix.key) + "=" + to_utf8(suffix.value) +
                                          "': " + expected + " was expected");
}

/// As many finite numbers as one of the counts says.
std::vector<double> numbers(const SceneSuffix& suffix, std::initializer_list<size_t> counts,
                            const std::string& expected) {
    const std::optional<std::vector<double>> values = finite_numbers(suffix.value);
    if (values)
        for (const size_t count : counts)
            if (values->size() == count) return *values;
    refuse(suffix, expected);
}

/// Box of all that is to be seen.
Box bounds_of(const Mesh& mesh) {
    Box box = mesh.bounds();
    for (const Vec3& point : mesh.points.positions) box.extend(point);
    return box;
}

void transform_scene(Scene& scene, const AffineMap& map) {
    transform(scene.mesh, map);
    if (scene.camera) transform(*scene.camera, map);
}

void apply_rot(const SceneSuffix& suffix, Scene& scene, Task&) {
    const std::string expected = "rot=DEGREES,X,Y,Z with an axis that is not zero";
    const std::vector<double> v = numbers(suffix, {4}, expected);
    const DVec3 axis(v[1], v[2], v[3]);
    const double length = glm::length(axis);
    if (!(length > 0.0 && length <= 1e150)) refuse(suffix, expected);
    const Box box = bounds_of(scene.mesh);
    transform_scene(scene, rotation(v[0], axis, box.is_empty() ? DVec3(0.0) : box.center()));
}

void apply_scale(const SceneSuffix& suffix, Scene& scene, Task&) {
    const std::string expected = "scale=S or scale=X,Y,Z, none of them zero,";
    std::vector<double> v = numbers(suffix, {1, 3}, expected);
    if (v.size() == 1) v = {v[0], v[0], v[0]};
    if (v[0] == 0.0 || v[1] == 0.0 || v[2] == 0.0) refuse(suffix, expected);
    AffineMap map;
    for (int axis = 0; axis < 3; ++axis) map.linear[axis][axis] = v[static_cast<size_t>(axis)];
    transform_scene(scene, map);
}

void apply_move(const SceneSuffix& suffix, Scene& scene, Task&) {
    const std::vector<double> v = numbers(suffix, {3}, "move=X,Y,Z");
    AffineMap map;
    map.offset = {v[0], v[1], v[2]};
    transform_scene(scene, map);
}

void apply_subdivide(const SceneSuffix& suffix, Scene& scene, Task& task) {
    const std::optional<double> times = finite_number(suffix.value);
    const bool is_valid = times && *times >= 0.0 && *times <= 16.0 && *times == static_cast<int>(*times);
    if (!is_valid) refuse(suffix, "subdivide=N, a whole number from 0 to 16,");
    subdivide(scene.mesh, static_cast<int>(*times), task);
}

/// A suffix that goes with every scene.
struct SuffixKey {
    const char* key;
    void (*apply)(const SceneSuffix& suffix, Scene& scene, Task& task);
};
constexpr SuffixKey kSuffixKeys[] = {
    {"rot", apply_rot}, {"scale", apply_scale}, {"move", apply_move}, {"subdivide", apply_subdivide}};

const SuffixKey* find_key(const std::string& key) {
    for (const SuffixKey& candidate : kSuffixKeys)
        if (key == candidate.key) return &candidate;
    return nullptr;
}

/// Keys of the built-in's own options: "tris=N" -> "tris".
std::vector<std::string> option_keys(const BuiltInScene* built_in) {
    std::vector<std::string> keys;
    std::string text = built_in == nullptr ? "" : built_in->options;
    for (size_t equals = text.find('='); equals != std::string::npos; equals = text.find('=')) {
        keys.push_back(text.substr(0, equals));
        text.erase(0, std::min(text.find(' ', equals), text.size() - 1) + 1);
    }
    return keys;
}

/// The built-in's options; whatever is neither one of them nor a suffix of every scene is refused.
SceneOptions take_options(const SceneSpec& spec) {
    SceneOptions options;
    const std::vector<std::string> own_keys = option_keys(spec.built_in);
    for (const SceneSuffix& suffix : spec.suffixes) {
        if (find_key(suffix.key) != nullptr) continue;
        if (std::find(own_keys.begin(), own_keys.end(), suffix.key) == own_keys.end()) {
            std::vector<std::string> keys = own_keys;
            for (const SuffixKey& key : kSuffixKeys) keys.push_back(key.key);
            throw Error(ExitCode::WrongUsage, "scene '" + to_utf8(spec.base) + "' has no suffix '@" +
                                                  to_utf8(suffix.key) + "'; the nearest is '@" +
                                                  nearest_word(suffix.key, keys) + "'");
        }
        if (!options.values.emplace(suffix.key, suffix.value).second) {
            throw Error(ExitCode::WrongUsage,
                        "scene '" + to_utf8(spec.base) + "': '@" + suffix.key + "' is given twice");
        }
    }
    return options;
}

Scene load_scene_file(const std::string& path, Task& task) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return load_file(path, task);
    std::vector<std::string> names;
    for (const BuiltInScene& scene : built_in_scenes()) names.push_back(scene.name);
    throw Error(ExitCode::BadInput, "'" + to_utf8(path) + "': there is no such file, and no built-in scene" +
                                        " of that name; the nearest is '" + nearest_word(path, names) + "'");
}

/// What was skipped since `before`.
std::map<std::string, uint64_t> skipped_since(const std::map<std::string, uint64_t>& before,
                                              const Task& task) {
    std::map<std::string, uint64_t> skipped = task.skipped.counts();
    for (const auto& [reason, count] : before) skipped[reason] -= count;
    std::erase_if(skipped, [](const auto& entry) { return entry.second == 0; });
    return skipped;
}

}  // namespace

std::shared_ptr<const Scene> open_scene(const std::string& spec, Task& task) {
    const Timer timer;
    const std::map<std::string, uint64_t> skipped_before = task.skipped.counts();
    const SceneSpec parsed = parse_scene_spec(spec);
    const SceneOptions options = take_options(parsed);

    auto scene = std::make_shared<Scene>();
    if (parsed.built_in != nullptr) {
        parsed.built_in->make(options, *scene, task);
        scene->title = spec;
    } else {
        release_kept_memory();  // of the builds of another scene
        *scene = load_scene_file(parsed.base, task);
        const std::string name = std::filesystem::path(parsed.base).filename().string();
        scene->title = to_utf8(name + spec.substr(parsed.base.size()));
    }
    scene->spec = spec;
    if (parsed.built_in != nullptr && !task.stopped()) check_mesh(scene->mesh, task);
    for (const SceneSuffix& suffix : parsed.suffixes) {
        const SuffixKey* key = find_key(suffix.key);
        if (key == nullptr || task.stopped()) continue;
        key->apply(suffix, *scene, task);
        if (!task.stopped()) check_mesh(scene->mesh, task);  // what became too large for floats, or flat
    }
    if (!task.stopped()) scene->content_hash = content_hash(scene->mesh);
    scene->skipped = skipped_since(skipped_before, task);
    scene->load_ms = timer.milliseconds();
    return scene;
}

}  // namespace boxwood
