#include "core/scene/scene_spec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/base/error.h"
#include "core/scene/mesh_transform.h"
#include "core/scene/subdivide.h"
#include "support/temporary_folder.h"

namespace boxwood {
namespace {

std::shared_ptr<const Scene> open(const std::string& spec) {
    Task task;
    return open_scene(spec, task);
}

/// The sentence with which `spec` is refused, with the exit code before it; empty if it is not.
std::string refusal(const std::string& spec) {
    try {
        open(spec);
    } catch (const Error& error) {
        return std::to_string(static_cast<int>(error.exit_code())) + " " + error.what();
    }
    return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class SceneSpecFiles : public testing::Test {
protected:
    std::string write(const std::string& name) {
        return folder_.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
    TemporaryFolder folder_;
};

TEST(SceneSpec, TakesNameAndSuffixesApartInTheirOrder) {
    const SceneSpec spec = parse_scene_spec("terrain@tris=10M@rot=45,1,1,1@scale=2");
    ASSERT_NE(spec.built_in, nullptr);
    EXPECT_EQ(spec.base, "terrain");
    const std::vector<SceneSuffix> expected = {{"tris", "10M"}, {"rot", "45,1,1,1"}, {"scale", "2"}};
    EXPECT_EQ(spec.suffixes, expected);
}

TEST_F(SceneSpecFiles, TheLongestExistingPathIsTheFileBecauseItsNameMayHoldAnAt) {
    const std::string plain = write("a.obj"), odd = write("a.obj@scale=2");
    EXPECT_EQ(parse_scene_spec(plain + "@move=1,0,0").base, plain);
    EXPECT_EQ(parse_scene_spec(odd).base, odd);
    EXPECT_TRUE(parse_scene_spec(odd).suffixes.empty());
    EXPECT_EQ(parse_scene_spec(odd + "@move=1,0,0").base, odd);
    EXPECT_THROW(parse_scene_spec(plain + "@nothing"), Error);
}

TEST_F(SceneSpecFiles, FilesAreReadAndTransformed) {
    const std::string path = write("one.obj");
    const std::shared_ptr<const Scene> scene = open(path + "@scale=2@move=10,0,0");
    EXPECT_EQ(scene->title, "one.obj@scale=2@move=10,0,0");
    EXPECT_EQ(scene->spec, path + "@scale=2@move=10,0,0");
    EXPECT_EQ(scene->mesh.bounds(), (Box{{10.0f, 0.0f, 0.0f}, {12.0f, 2.0f, 0.0f}}));
    EXPECT_FALSE(scene->camera.has_value());
}

TEST_F(SceneSpecFiles, ABuiltInNameWinsOverAFileOfThatName) {
    const std::string path = write("cornell");
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    const std::shared_ptr<const Scene> built_in = open("cornell"), file = open("./cornell");
    std::filesystem::current_path(before);
    EXPECT_EQ(built_in->mesh.triangle_count(), 32u);
    EXPECT_EQ(file->mesh.triangle_count(), 1u);
}

TEST(OpenScene, WhatIsNotUnderstoodIsRefusedWithTheNearestWord) {
    EXPECT_TRUE(has(refusal("cornell@rott=1,0,0,1"), "2 "));
    EXPECT_TRUE(has(refusal("cornell@rott=1,0,0,1"), "'@rot'"));
    EXPECT_TRUE(has(refusal("terrain@tri=5"), "'@tris'"));
    EXPECT_TRUE(has(refusal("cornell@tris=5"), "2 "));
    EXPECT_TRUE(has(refusal("cornell@scale"), "2 "));
    EXPECT_TRUE(has(refusal("cornell@"), "2 "));
    EXPECT_TRUE(has(refusal("terrain@tris=1k@tris=2k"), "twice"));
    EXPECT_TRUE(has(refusal("atrum"), "3 "));
    EXPECT_TRUE(has(refusal("atrum"), "'atrium'"));
    EXPECT_TRUE(has(refusal(""), "3 "));
}

TEST(OpenScene, ValuesOutOfTheirRangeAreRefused) {
    for (const char* suffix : {"@rot=45", "@rot=45,0,0,0", "@rot=45,1,1,x", "@rot=nan,1,0,0", "@scale=0",
                               "@scale=1,0,1", "@scale=1,2", "@scale=", "@move=1,2", "@move=1,2,inf",
                               "@subdivide=-1", "@subdivide=1.5", "@subdivide=x", "@subdivide=15"}) {
        EXPECT_TRUE(has(refusal(std::string("cornell") + suffix), "2 ")) << suffix;
    }
}

TEST(OpenScene, SuffixesAreAppliedInTheOrderGiven) {
    const Box first = open("two-triangles@scale=2@move=1,0,0")->mesh.bounds();
    EXPECT_EQ(first, (Box{{1.0f, 0.0f, 0.0f}, {17.0f, 12.0f, 0.8f}}));
    const Box second = open("two-triangles@move=1,0,0@scale=2")->mesh.bounds();
    EXPECT_EQ(second, (Box{{2.0f, 0.0f, 0.0f}, {18.0f, 12.0f, 0.8f}}));
}

TEST(OpenScene, TurnsAboutTheCentreOfTheBoxAndExactlyByRightAngles) {
    // The box (0, 0, 0) (8, 6, 0.4) turned about z: x and y change places about (4, 3).
    const Box box = open("two-triangles@rot=90,0,0,1")->mesh.bounds();
    EXPECT_EQ(box, (Box{{1.0f, -1.0f, 0.0f}, {7.0f, 7.0f, 0.4f}}));
    const Box whole_turn = open("two-triangles@rot=-720,1,2,3")->mesh.bounds();
    EXPECT_EQ(whole_turn, open("two-triangles")->mesh.bounds());
}

TEST(OpenScene, TheBuiltInCameraGoesWithItsScene) {
    const std::shared_ptr<const Scene> plain = open("cornell"), moved = open("cornell@scale=3@move=0,7,0");
    EXPECT_NEAR(moved->camera->eye.y, 3.0f * plain->camera->eye.y + 7.0f, 1e-5f);
    EXPECT_NEAR(moved->camera->target.x, 3.0f * plain->camera->target.x, 1e-5f);
}

TEST(OpenScene, WhatATransformMakesTooLargeOrFlatIsDroppedAndCounted) {
    const std::shared_ptr<const Scene> huge = open("cornell@scale=1e39");
    EXPECT_LT(huge->mesh.triangle_count(), 32u);
    EXPECT_EQ(huge->mesh.triangle_count() + huge->skipped.at("non-finite vertex"), 32u);
    const std::shared_ptr<const Scene> tiny = open("cornell@scale=1e-60");
    EXPECT_EQ(tiny->mesh.triangle_count(), 0u);
    EXPECT_EQ(tiny->skipped.at("zero area"), 32u);
}

TEST(OpenScene, CountsWhatThisSceneSkippedAlsoWithAUsedTask) {
    Task task;
    open_scene("cornell@scale=1e-60", task);
    EXPECT_TRUE(open_scene("cornell", task)->skipped.empty());
}

TEST(OpenScene, HashesTheContentNotTheName) {
    EXPECT_EQ(open("cornell")->content_hash, open("cornell@scale=1")->content_hash);
    EXPECT_NE(open("cornell")->content_hash, open("cornell@scale=2")->content_hash);
    EXPECT_NE(open("cornell")->content_hash, 0u);
}

TEST(OpenScene, AStopEndsItEarly) {
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    open_scene("terrain@tris=10M@subdivide=1", task);
    EXPECT_LT(task.done.load(), 1000u);
}

TEST(Midpoint, IsSymmetricAndRoundedOnce) {
    EXPECT_EQ(midpoint(Vec3(1.0f, -3.0f, 0.5f), Vec3(2.0f, 5.0f, 0.5f)), Vec3(1.5f, 1.0f, 0.5f));
    EXPECT_EQ(midpoint(Vec3(3e38f), Vec3(3.2e38f)), Vec3(3.1e38f));
    EXPECT_EQ(midpoint(Vec3(0x1p-149f), Vec3(0x3p-149f)), Vec3(0x2p-149f));
    const Vec3 a(0.1f, 7e-40f, 3e38f), b(1e8f, 1.4e-45f, -2e38f);
    EXPECT_EQ(midpoint(a, b), midpoint(b, a));
}

/// An octahedron: closed, 6 vertices, 12 edges.
Mesh octahedron() {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    mesh.source_prim = {0, 1, 2, 3, 4, 5, 6, 9};
    mesh.object = {0, 0, 0, 0, 1, 1, 1, 1};
    mesh.objects = {{"upper", Vec3(0.5f)}, {"lower", Vec3(0.5f)}};
    return mesh;
}

TEST(Subdivide, KeepsAClosedMeshClosedAndItsVerticesShared) {
    Mesh mesh = octahedron();
    Task task;
    subdivide(mesh, 2, task);
    EXPECT_EQ(mesh.triangle_count(), 8u * 16);
    EXPECT_EQ(mesh.positions.size(), 66u);  // Euler: V = F / 2 + 2
    std::map<std::pair<uint32_t, uint32_t>, int> balance;
    for (const UVec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const uint32_t a = t[i], b = t[(i + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    EXPECT_EQ(balance.size(), 192u);
    for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0);
}

TEST(Subdivide, PartsFollowEachOtherAndCoverTheTriangle) {
    Mesh mesh = octahedron();
    const Mesh before = mesh;
    Task task;
    subdivide(mesh, 1, task);
    for (uint32_t p = 0; p < before.triangle_count(); ++p) {
        const auto normal = [](const Triangle& t) { return glm::cross(DVec3(t.b - t.a), DVec3(t.c - t.a)); };
        DVec3 sum(0.0);
        for (uint32_t k = 0; k < 4; ++k) {
            EXPECT_EQ(mesh.source_prim[4 * p + k], 4 * before.source_prim[p] + k);
            EXPECT_EQ(mesh.object[4 * p + k], before.object[p]);
            sum += normal(mesh.triangle(4 * p + k));
        }
        EXPECT_EQ(sum, normal(before.triangle(p)));  // four parts, same winding: the areas add up
    }
}

TEST(Subdivide, TrianglesThatShareNoIndicesGetTheSameMiddlesBitForBit) {
    Mesh mesh;
    const Vec3 a(0.1f, 0.7f, -3.3f), b(12345.6f, -1e-7f, 0.3f);
    mesh.positions = {a, b, {5, 5, 5}, b, a, {-5, 5, 5}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    mesh.source_prim = {0, 1};
    mesh.object = {0, 0};
    mesh.objects = {{"both", Vec3(0.5f)}};
    Task task;
    subdivide(mesh, 1, task);
    EXPECT_EQ(mesh.positions[mesh.triangles[3].x], mesh.positions[mesh.triangles[7].x]);
}

TEST(Subdivide, RefusesWhatWouldBeTooManyTriangles) {
    Mesh mesh = octahedron();
    Task task;
    EXPECT_THROW(subdivide(mesh, 12, task), Error);
    EXPECT_EQ(mesh.triangle_count(), 8u);
}

TEST(NearestWord, IsTheOneWithTheFewestEdits) {
    EXPECT_EQ(nearest_word("bvh-bined-sah", {"bvh-sweep-sah", "bvh-binned-sah", "none"}), "bvh-binned-sah");
    EXPECT_EQ(nearest_word("kitten", {"mitten", "kitchen"}), "mitten");
    EXPECT_EQ(nearest_word("x", {}), "");
}

}  // namespace
}  // namespace boxwood
