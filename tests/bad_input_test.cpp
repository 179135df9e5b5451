#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/scene/load_file.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(BOXWOOD_SHARED_DIR) / "bad-input";

struct Row {
    std::string file, expect, triangles;
};

std::vector<Row> read_rows() {
    std::vector<Row> rows;
    std::ifstream table(kFolder / "expected.tsv");
    std::string line;
    std::getline(table, line);  // titles
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        Row row;
        std::getline(fields, row.file, '\t');
        std::getline(fields, row.expect, '\t');
        std::getline(fields, row.triangles, '\t');
        rows.push_back(row);
    }
    return rows;
}

void check_loaded(const Row& row, const Scene& scene, const Task& task) {
    const Mesh& mesh = scene.mesh;
    EXPECT_NE(row.expect, "error") << row.file << " was loaded";
    uint64_t skipped = 0;
    if (const auto found = scene.skipped.find("zero area"); found != scene.skipped.end())
        skipped = found->second;
    if (row.expect == "load") {
        EXPECT_EQ(skipped, 0u) << row.file;
    }
    if (row.triangles != "-") {
        EXPECT_EQ(mesh.triangle_count() + skipped, std::stoull(row.triangles)) << row.file;
    }
    EXPECT_TRUE(skipped == 0 || !scene.warnings.empty()) << row.file;
    EXPECT_EQ(task.skipped.counts(), scene.skipped);
    ASSERT_EQ(mesh.object.size(), mesh.triangle_count());
    ASSERT_EQ(mesh.source_prim.size(), mesh.triangle_count());
    for (const uint32_t object : mesh.object) ASSERT_LT(object, mesh.objects.size());
    for (const UVec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
    for (const Vec3& p : mesh.positions) ASSERT_FALSE(glm::any(glm::isnan(p)) || glm::any(glm::isinf(p)));
    for (const MeshObject& object : mesh.objects) EXPECT_EQ(to_utf8(object.name), object.name);
    for (const std::string& warning : scene.warnings) EXPECT_EQ(to_utf8(warning), warning);
}

TEST(BadInput, EveryFileEndsAsTheTableSaysWithinTwoSeconds) {
    const std::vector<Row> rows = read_rows();
    if (rows.empty()) GTEST_SKIP() << "no folder " << kFolder;
    EXPECT_GE(rows.size(), 60u);
    for (const Row& row : rows) {
        const std::string path = (kFolder / row.file).string();
        const Timer timer;
        Task task;
        try {
            check_loaded(row, load_file(path, task), task);
        } catch (const Error& error) {
            const std::string sentence = error.what();
            EXPECT_NE(row.expect, "load") << sentence;
            EXPECT_EQ(error.exit_code(), ExitCode::BadInput) << sentence;
            EXPECT_TRUE(sentence.starts_with(path + ": ")) << sentence;
            EXPECT_EQ(to_utf8(sentence), sentence);
        }
        EXPECT_LT(timer.milliseconds(), 2000.0) << row.file;
    }
}

/// The sentence of the error that loading ends with; empty for none.
std::string refusal(const std::string& file) {
    try {
        Task task;
        load_file((kFolder / file).string(), task);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(BadInput, ErrorsNameTheCause) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no folder " << kFolder;
    const std::map<std::string, std::string> causes = {
        {"accessor_without_buffer_view.gltf", "zero area"},
        {"ascii_missing_rows.ply", "line 15: the file ends too early"},
        {"bad_base64.gltf", "buffers[0].uri: character \"@\""},
        {"buffer_view_offset_wraps.glb", "bufferViews[1]: bytes 4294967200 to 4294967272"},
        {"count_lies.stl", "4000000000 triangles, the file has room for 12"},
        {"dangling_accessor.gltf", "meshes[0].primitives[0].indices: names accessors[9], there are 2"},
        {"dangling_mesh.gltf", "nodes[0].mesh: found \"-1\""},
        {"deep_json.gltf", "nested deeper"},
        {"directory.obj", "folder"},
        {"draco_required.glb", "KHR_draco_mesh_compression"},
        {"empty.glb", "empty"},
        {"face_index_zero.obj", "vertex index 0"},
        {"float_indices.gltf", "accessors[1]"},
        {"huge_accessor_count.glb", "accessors[0]"},
        {"huge_counts.ply", "4294967295"},
        {"index_out_of_range.glb", "is 65000, there are 8 vertices"},
        {"integer_out_of_bounds.gltf", "bufferViews[0].byteLength: found \"1e+300\""},
        {"length_field_4g.glb", "byte 8: the header says 4294967295 bytes, the file has 664"},
        {"lines_only.glb", "no triangles"},
        {"missing_buffer.gltf", "no_such_file.bin"},
        {"negative_index_out_of_range.obj", "vertex index -9"},
        {"negative_list_length.ply", "length -3"},
        {"negative_offset.glb", "bufferViews[0].byteOffset: found \"-4\""},
        {"no_end_header.ply", "line 9"},
        {"no_such_file.obj", "no such file"},
        {"node_cycle.gltf", "cycle"},
        {"position_vec2.gltf", "VEC2, expected VEC3"},
        {"uri_outside_folder.gltf", "leads out of the file's folder"},
        {"words_for_numbers.obj", "line 8: found \"one\", expected the y coordinate"},
        {"zero_triangles.ply", "no triangles"},
    };
    for (const auto& [file, cause] : causes) {
        EXPECT_NE(refusal(file).find(cause), std::string::npos)
            << refusal(file) << " (expected: " << cause << ")";
    }
}

}  // namespace
}  // namespace boxwood
