#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace boxwood {
namespace {

namespace fs = std::filesystem;

/// One line `#include "..."` or `#include <...>`.
struct Include {
    std::string file;  ///< relative to the source folder, as in "core/bvh/bvh2.h"
    std::string target;
    bool quoted = false;
};

std::string folder_of_path(const std::string& path) { return fs::path(path).parent_path().string(); }

std::vector<Include> includes_of(const std::string& file, const std::string& path) {
    std::vector<Include> includes;
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with("#include ") || line.size() < 12) continue;
        const size_t end = line.find_first_of(">\"", 10);
        includes.push_back({file, line.substr(10, end - 10), line[9] == '"'});
    }
    return includes;
}

std::vector<Include> all_includes() {
    std::vector<Include> includes;
    for (const char* top : {"app", "bench", "core", "oracle", "tests"}) {
        const fs::path root = fs::path(BOXWOOD_SOURCE_DIR) / top;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp") continue;
            const std::string file = fs::relative(entry.path(), BOXWOOD_SOURCE_DIR).generic_string();
            for (const Include& include : includes_of(file, entry.path().string()))
                includes.push_back(include);
        }
    }
    return includes;
}

const std::vector<std::string> kFamilies = {"core/brute_force", "core/bsp",    "core/bvh",
                                            "core/grid",        "core/kdtree", "core/octree",
                                            "core/volume_bvh",  "core/rbvh",   "core/wide_bvh"};

/// The folders that a folder of core may include, itself besides.
std::vector<std::string> allowed_in_core(const std::string& folder) {
    if (folder == "core/base") return {};
    if (folder == "core/scene") return {"core/base"};
    if (folder == "core/refs") return {"core/base", "core/scene"};
    std::vector<std::string> allowed = {"core/base", "core/scene", "core/refs"};
    if (folder == "core/structure") return allowed;
    allowed.push_back("core/structure");
    // Made out of a binary BVH: by transforms, or as a hybrid of one.
    if (folder == "core/volume_bvh" || folder == "core/rbvh" || folder == "core/wide_bvh")
        allowed.push_back("core/bvh");
    if (folder == "core/catalog") allowed.insert(allowed.end(), kFamilies.begin(), kFamilies.end());
    return allowed;
}

/// Empty if the edge is allowed, otherwise why not.
std::string complaint(const Include& include) {
    const std::string from = folder_of_path(include.file);
    const std::string to = folder_of_path(include.target);
    if (to.empty() || from == to || from.starts_with("tests")) return {};
    const bool to_core = to.starts_with("core/");
    if (from.starts_with("core/")) {
        const std::vector<std::string> allowed = allowed_in_core(from);
        if (std::ranges::find(allowed, to) == allowed.end()) return from + " does not stand on " + to;
        return {};
    }
    if (from == "oracle") return to_core ? "" : "oracle stands on core alone";
    if (from == "bench") return to_core || to == "oracle" ? "" : "bench stands on core and oracle";
    if (to.starts_with("tests")) return "only tests depend on tests";
    if (from == "app/cli") return to_core ? "" : "app/cli stands on core alone";
    if (from == "app/gl" && to == "app/viewer") {
        const std::string name = fs::path(include.target).filename().string();
        return name == "draw_list.h" || name == "box_values.h" ? ""
                                                               : "app/gl knows of the viewer what to draw";
    }
    if (from == "app/viewer" && to == "bench") return {};  // what "Verify" compares with
    if (from == "app/gl" || from == "app/viewer")
        return to_core || to == "app/gl" ? "" : from + " does not stand on " + to;
    return {};
}

bool is_one_of(const std::string& target, std::initializer_list<const char*> prefixes) {
    return std::ranges::any_of(prefixes, [&](const char* prefix) { return target.starts_with(prefix); });
}

std::string library_complaint(const Include& include) {
    const std::string folder = folder_of_path(include.file);
    if (folder.starts_with("tests")) return {};
    const auto in = [&](const char* prefix) { return folder.starts_with(prefix); };
    if (is_one_of(include.target, {"GL/", "glad/"}) && !in("app/gl")) return "only app/gl calls OpenGL";
    if (is_one_of(include.target, {"GLFW/", "backends/imgui_impl_glfw"}) && !in("app/gl") &&
        !in("app/viewer"))
        return "only the window knows GLFW";
    if (is_one_of(include.target, {"imgui"}) && !in("app/gl") && !in("app/viewer"))
        return "only the window knows Dear ImGui";
    if (is_one_of(include.target, {"CLI/"}) && !in("app/cli")) return "only app/cli knows CLI11";
    if (is_one_of(include.target, {"gmp"}) && !in("oracle")) return "only oracle knows GMP";
    if (is_one_of(include.target, {"tbb/"}) && include.file != "core/base/parallel.cpp" &&
        include.file != "core/base/array.cpp")
        return "only parallel.cpp and array.cpp know TBB";
    if (is_one_of(include.target, {"nlohmann/", "CLI/", "tiny_gltf", "iostream"}) &&
        include.file.ends_with(".h"))
        return "no header carries so heavy a one";
    return {};
}

TEST(FolderRules, NoFolderIncludesWhatItDoesNotStandOn) {
    const std::vector<Include> includes = all_includes();
    EXPECT_GT(includes.size(), 500u);
    for (const Include& include : includes) {
        if (!include.quoted) continue;
        EXPECT_EQ(complaint(include), "") << include.file << " includes " << include.target;
    }
}

TEST(FolderRules, LibrariesStayWhereTheyBelong) {
    for (const Include& include : all_includes())
        EXPECT_EQ(library_complaint(include), "") << include.file << " includes " << include.target;
}

TEST(FolderRules, TheRulesRefuseWhatTheyShould) {
    const auto refuses = [](const char* file, const char* target) {
        return !complaint({file, target, true}).empty();
    };
    EXPECT_TRUE(refuses("core/base/box.h", "core/scene/mesh.h"));
    EXPECT_TRUE(refuses("core/bvh/bvh2.h", "core/brute_force/brute_force.h"));
    EXPECT_TRUE(refuses("core/measure/report.h", "core/catalog/pipeline.h"));
    EXPECT_TRUE(refuses("core/render/png.h", "app/viewer/state.h"));
    EXPECT_TRUE(refuses("app/gl/program.h", "app/viewer/state.h"));
    EXPECT_TRUE(refuses("app/viewer/panels.h", "app/command/commands.h"));
    EXPECT_FALSE(refuses("core/wide_bvh/wide.h", "core/bvh/bvh2.h"));
    EXPECT_FALSE(refuses("core/catalog/catalog.cpp", "core/bvh/bvh2.h"));
    EXPECT_FALSE(library_complaint({"core/base/box.h", "GL/gl.h", false}).empty());
    EXPECT_FALSE(library_complaint({"app/viewer/panels.cpp", "glad/gl.h", false}).empty());
    EXPECT_FALSE(library_complaint({"core/base/box.h", "gmpxx.h", false}).empty());
}

}  // namespace
}  // namespace boxwood
