#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/task.h"
#include "core/scene/camera.h"
#include "core/scene/mesh.h"

namespace boxwood {

/// A scene as every stage sees it: shared and const once opened.
struct Scene {
    std::string spec;   ///< what opens it again: file or built-in name with its suffixes
    std::string title;  ///< for people: the file's name without folders, or the spec of a built-in
    Mesh mesh;
    uint64_t content_hash = 0;                ///< of the mesh's arrays
    std::map<std::string, uint64_t> skipped;  ///< triangles left out, by reason
    std::vector<std::string> warnings;        ///< sentences about what was odd but could be read
    std::optional<Camera> camera;             ///< the built-in's own view, if any; otherwise see fit_camera
    double load_ms = 0.0;
};

/// One built-in scene. `make` gets what followed the name: "terrain@tris=10M" -> option("tris") == "10M".
struct SceneOptions {
    std::map<std::string, std::string> values;
};
struct BuiltInScene {
    const char* name;
    const char* description;  ///< one sentence
    const char* options;      ///< "tris=N" or ""
    void (*make)(const SceneOptions& options, Scene& scene, Task& task);
    /// Animated: option "frame" chooses one of the frames 0 to frame_count - 1, after which frame 0 comes
    /// again; all have the same triangles in the same order. 0: not animated.
    int frame_count = 0;
};
/// All built-in scenes, in the order of the documentation.
const std::vector<BuiltInScene>& built_in_scenes();

/// Opens `SPEC = (file | built-in name) {"@" key "=" value}`. Keys of every scene, applied in the order
/// given: rot=DEG,X,Y,Z (degrees about an axis through the box's centre), scale=S or scale=X,Y,Z, move=X,Y,Z,
/// subdivide=N (each triangle into 4^N). A file is told apart by its content, not by its name. A built-in
/// name wins over a file of that name
/// ("./atrium" names the file). Throws Error: BadInput for a file that cannot be read, WrongUsage for an
/// unknown suffix or built-in option (naming the nearest valid one).
std::shared_ptr<const Scene> open_scene(const std::string& spec, Task& task);

/// Valid UTF-8: bytes that are not become U+FFFD.
std::string to_utf8(const std::string& text);

/// Of `candidates` the one with the least edit distance to `word`; empty if there are none. For error
/// messages.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace boxwood
