#include <gtest/gtest.h>

#include <bit>

#include "tests/support/load_text.h"

namespace boxwood {
namespace {

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) {
        const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
        bytes.append(raw.data(), raw.size());
    }
    return bytes;
}

/// A GLB of this JSON and this binary chunk.
std::string make_glb(std::string json, std::string bin) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    const uint32_t json_size = static_cast<uint32_t>(json.size()),
                   bin_size = static_cast<uint32_t>(bin.size());
    return "glTF" + bytes_of<uint32_t>({2, 28 + json_size + bin_size, json_size}) + "JSON" + json +
           bytes_of<uint32_t>({bin_size}) + std::string("BIN\0", 4) + bin;
}

/// The corners (0 0 0) (1 0 0) (0 1 0) (1 1 0), then the bytes 0 1 2 3, then 0.5 as a float.
const std::string kBin = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}) +
                         bytes_of<uint8_t>({0, 1, 2, 3}) + bytes_of<float>({0, 0, 5});

/// A document on kBin whose accessor 0 is the corners and 1 the four indices; `rest` has nodes and meshes.
std::string document(const std::string& rest) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":64}],"bufferViews":[
        {"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":4},
        {"buffer":0,"byteOffset":52,"byteLength":12}],"accessors":[
        {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"},
        {"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,
            "indices":{"bufferView":1,"byteOffset":3,"componentType":5121},"values":{"bufferView":2}}},
        {"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":4,
            "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}}],)" +
           rest + "}";
}

Scene load(const std::string& rest) { return load_bytes("a.glb", make_glb(document(rest), kBin)); }
std::string refusal(const std::string& rest) { return refusal_of("a.glb", make_glb(document(rest), kBin)); }

TEST(LoadGltf, StripsFansAndListsWithAndWithoutIndices) {
    const Scene scene = load(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[
        {"attributes":{"POSITION":0},"indices":1,"mode":5},{"attributes":{"POSITION":0},"mode":6},
        {"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"mode":1}]}])");
    // 3.7.2.1: strip i, i + 1 + i % 2, i + 2 - i % 2; fan i + 1, i + 2, 0; an incomplete list is cut off.
    const Array<UVec3> expected = {{0, 1, 2}, {1, 3, 2}, {1, 2, 0}, {2, 3, 0}, {0, 1, 2}};
    EXPECT_EQ(scene.mesh.triangles, expected);
    EXPECT_EQ(scene.mesh.positions.size(), 4u);  // one accessor in one instance is stored once
    EXPECT_EQ(scene.mesh.object, (std::vector<uint32_t>{0, 0, 1, 1, 2}));
    EXPECT_EQ(scene.skipped.at("primitive of points or lines"), 1u);
}

TEST(LoadGltf, InstancesDepthFirstWithMatrixAndTransforms) {
    const Scene scene = load(R"("scene":1,"scenes":[{"nodes":[4]},{"nodes":[3,0]}],"nodes":[
        {"name":"last","mesh":0},{"mesh":0,"scale":[2,3,4],"rotation":[0,0,0.7071067811865476,0.7071067811865476],
        "translation":[10,0,0]},{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1]},
        {"children":[1,2],"translation":[0,0,1]},{"mesh":0}],
        "meshes":[{"name":"m","primitives":[{"attributes":{"POSITION":0}}]}])");
    ASSERT_EQ(scene.mesh.triangle_count(), 3u);
    EXPECT_EQ(corner_of(scene.mesh, 0, 0), Vec3(10, 0, 1));
    EXPECT_NEAR(corner_of(scene.mesh, 0, 1).y, 2.0f, 1e-6f);  // scaled, then turned: x becomes y
    EXPECT_NEAR(corner_of(scene.mesh, 0, 2).x, 7.0f, 1e-5f);
    EXPECT_EQ(corner_of(scene.mesh, 1, 2), Vec3(-1, 0, 8));  // mirrored: the corners are turned round
    EXPECT_EQ(corner_of(scene.mesh, 1, 1), Vec3(0, 1, 8));
    EXPECT_EQ(corner_of(scene.mesh, 2, 1), Vec3(1, 0, 0));
    EXPECT_EQ(scene.mesh.objects[0].name, "m");
    EXPECT_EQ(scene.mesh.objects[2].name, "last");
}

TEST(LoadGltf, SparsePositionsWithAndWithoutABufferView) {
    const Scene scene = load(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[
        {"attributes":{"POSITION":2},"indices":1,"mode":5},{"attributes":{"POSITION":3},"indices":1,"mode":5}]}])");
    ASSERT_EQ(scene.mesh.triangle_count(), 4u);
    EXPECT_EQ(corner_of(scene.mesh, 1, 1), Vec3(0, 0, 5));  // vertex 3 replaced
    EXPECT_EQ(corner_of(scene.mesh, 3, 1), Vec3(1, 1, 0));  // all four from the sparse values
}

TEST(LoadGltf, BaseColourOfTheMaterial) {
    const Scene scene = load(R"("materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,2,0.25,1]}},{}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0},
        {"attributes":{"POSITION":0},"material":1},{"attributes":{"POSITION":0}}]}])");
    EXPECT_EQ(scene.mesh.base_color(0), Vec3(0.5f, 1.0f, 0.25f));
    EXPECT_EQ(scene.mesh.base_color(1), Vec3(1.0f));
    EXPECT_EQ(scene.mesh.base_color(2), Vec3(0.8f));
}

TEST(LoadGltf, QuantizedPositions) {
    const std::string bin = bytes_of<int16_t>({-32768, 32767, 0, 0, 16384, 0, 0, 0, 0, 0, 1, 0});
    const std::string head = R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],
        "buffers":[{"byteLength":24}],"bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3","normalized":)";
    const Scene normalized = load_bytes("a.glb", make_glb(head + "true}]}", bin));
    EXPECT_EQ(normalized.mesh.positions[0], Vec3(-1.0f, 1.0f, 0.0f));
    EXPECT_EQ(normalized.mesh.positions[1], Vec3(16384.0f / 32767.0f, 0.0f, 0.0f));
    const Scene plain = load_bytes("a.glb", make_glb(head + "false}]}", bin));
    EXPECT_EQ(plain.mesh.positions[0], Vec3(-32768.0f, 32767.0f, 0.0f));
}

TEST(LoadGltf, BufferInAFileBesideIt) {
    const TemporaryFolder folder;
    const std::string json =
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"a%20+%C3%A9.bin"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})";
    folder.write("a +\xc3\xa9.bin", kBin);  // may be longer than said
    Task task;
    EXPECT_EQ(load_file(folder.write("a.gltf", json), task).mesh.triangle_count(), 1u);
    folder.write("in/b.gltf", json);
    std::string outside = json;
    outside.replace(outside.find("a%20"), 4, "..%2Fa%20");
    EXPECT_THROW(load_file(folder.write("in/c.gltf", outside), task), Error);
}

TEST(LoadGltf, LinkOutOfTheFolderIsRefused) {
    const TemporaryFolder folder;
    const std::filesystem::path secret = folder.write("secret.bin", kBin);
    const std::string file = folder.write(
        "in/a.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"link.bin"}]})");
    std::filesystem::create_symlink(secret, secret.parent_path() / "in" / "link.bin");
    Task task;
    try {
        load_file(file, task);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("leads out of"), std::string::npos) << error.what();
    }
}

TEST(LoadGltf, ErrorsNameTheJsonPath) {
    const std::string mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)";
    EXPECT_EQ(refusal(mesh + R"("nodes":[{"mesh":1}])"), "nodes[0].mesh: names meshes[1], there are 1.");
    EXPECT_EQ(refusal(mesh + R"("nodes":[{"children":[2]},{"children":[2]},{}])"),
              "nodes[2]: has more than one parent.");
    EXPECT_EQ(refusal(mesh + R"("nodes":[{"children":[0]}])"), "nodes[0]: is part of a cycle of nodes.");
    EXPECT_EQ(refusal(mesh + R"("nodes":[{"matrix":[1,2]}])"), "nodes[0].matrix: expected 16 numbers.");
    EXPECT_EQ(refusal(mesh + R"("nodes":[{"children":[1]},{"mesh":0}],"scenes":[{"nodes":[0,1]}])"),
              "scenes[0].nodes: names node 1, which is no root.");
    EXPECT_EQ(refusal(R"("meshes":[{"primitives":[{"attributes":{"POSITION":1}}]}])"),
              "meshes[0].primitives[0].attributes.POSITION: the accessor is SCALAR, expected VEC3.");
    EXPECT_EQ(refusal(R"("meshes":[{"primitives":[{"attributes":{},"mode":7}]}])"),
              "meshes[0].primitives[0].mode: found \"7\", expected a whole number from 0 to 6.");
    EXPECT_EQ(refusal(mesh + R"("extensionsRequired":["EXT_meshopt_compression"])"),
              "extensionsRequired: the file needs the extension \"EXT_meshopt_compression\", which is not "
              "supported.");
    const size_t end = 20 + document(mesh + R"("nodes":[)").size() - 1;  // of the JSON in the GLB
    EXPECT_EQ(refusal(mesh + R"("nodes":[)"), "byte " + std::to_string(end) + ": this is not valid JSON.");
}

TEST(LoadGltf, NoMemoryForWhatAFileMerelyClaims) {
    EXPECT_EQ(refusal_of("a.gltf", R"({"asset":{"version":"2.0"},"accessors":[
        {"componentType":5126,"count":4294967294,"type":"VEC3"}]})"),
              "accessors[0].count: 4294967294 elements without a bufferView.");
    std::string many =
        R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":150000,"type":"VEC3"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0})";
    for (int i = 1; i < 10000; ++i) many += R"(,{"mesh":0})";
    many += "]}" + std::string(50000, ' ');
    EXPECT_NE(refusal_of("a.gltf", many).find("its instances have more than"), std::string::npos);
}

}  // namespace
}  // namespace boxwood
