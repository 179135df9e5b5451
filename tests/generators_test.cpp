#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stop_token>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/mesh_check.h"
#include "core/scene/mesh_hash.h"
#include "core/scene/mesh_transform.h"
#include "core/scene/scene.h"
#include "support/load_text.h"

namespace boxwood {
namespace {

Scene make(const std::string& name, const SceneOptions& options = {}) {
    Scene scene;
    Task task;
    for (const BuiltInScene& built_in : built_in_scenes())
        if (name == built_in.name) built_in.make(options, scene, task);
    return scene;
}

Scene make_terrain_of(const std::string& tris) { return make("terrain", {.values = {{"tris", tris}}}); }

Mesh kitchen_at(int frame) { return make("kitchen", {.values = {{"frame", std::to_string(frame)}}}).mesh; }

/// Longest edge divided by the height over it: 1.15 is equilateral.
double edge_to_height(const Triangle& t) {
    const DVec3 a(t.a), b(t.b), c(t.c);
    const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return edge * edge / glm::length(glm::cross(b - a, c - a));
}

class EveryBuiltInScene : public testing::TestWithParam<const char*> {};

TEST_P(EveryBuiltInScene, HasOnlyTrianglesThatCanBeHit) {
    Scene scene = make(GetParam());
    const size_t made = scene.mesh.triangles.size();
    Task task;
    check_mesh(scene.mesh, task);
    EXPECT_EQ(scene.mesh.triangles.size(), made);
    EXPECT_TRUE(task.skipped.counts().empty());
    EXPECT_GT(made, 0u);
}

TEST_P(EveryBuiltInScene, HasNamedColouredObjectsThatAreUsed) {
    const Mesh mesh = make(GetParam()).mesh;
    ASSERT_EQ(mesh.object.size(), mesh.triangles.size());
    std::vector<size_t> count(mesh.objects.size());
    for (const uint32_t object : mesh.object) {
        ASSERT_LT(object, mesh.objects.size());
        ++count[object];
    }
    for (size_t i = 0; i < count.size(); ++i) {
        const MeshObject& object = mesh.objects[i];
        EXPECT_FALSE(object.name.empty());
        EXPECT_GT(count[i], 0u) << object.name;
        EXPECT_TRUE(object.base_color != Vec3(0.0f)) << object.name;
        for (int k = 0; k < 3; ++k) EXPECT_TRUE(object.base_color[k] >= 0.0f && object.base_color[k] <= 1.0f);
    }
}

TEST_P(EveryBuiltInScene, ComesWithACameraThatLooksAtIt) {
    const Scene scene = make(GetParam());
    ASSERT_TRUE(scene.camera.has_value());
    EXPECT_TRUE(scene.mesh.bounds().contains(Box{scene.camera->target, scene.camera->target}) ||
                GetParam() == std::string("two-triangles"));
}

INSTANTIATE_TEST_SUITE_P(Generators, EveryBuiltInScene,
                         testing::Values("atrium", "spaceship", "kitchen", "mirror-low", "cornell",
                                         "two-triangles", "terrain"));

/// The hashes are the same for g++ and clang++, any number of threads, and every run. A change of a generator
/// changes its hash here and its pictures in screenshots/.
TEST(Generators, GiveTheSameBitsEverywhere) {
    const auto hash = [](const std::string& name) { return content_hash(make(name).mesh); };
    EXPECT_EQ(hash("atrium"), 12361005846590520974ull);
    EXPECT_EQ(hash("spaceship"), 10775120960556069127ull);
    EXPECT_EQ(hash("kitchen"), 2860062209948682101ull);
    EXPECT_EQ(content_hash(kitchen_at(50)), 12731308886786660154ull);
    EXPECT_EQ(hash("mirror-low"), 16913423495154103625ull);
    EXPECT_EQ(hash("mirror-high"), 874849490886368322ull);
    EXPECT_EQ(hash("power-plant"), 12738575145653288824ull);
    EXPECT_EQ(hash("cornell"), 15223261984855378444ull);
    EXPECT_EQ(hash("two-triangles"), 12860931664810968192ull);
    const uint64_t terrain = content_hash(make_terrain_of("20k").mesh);
    EXPECT_EQ(terrain, 13330707679621626291ull);
    const ThreadLimit one_thread(1);
    EXPECT_EQ(content_hash(make_terrain_of("20k").mesh), terrain);
}

TEST(ContentHash, SeesEveryArray) {
    const Mesh mesh = [] {
        Mesh m = make("two-triangles").mesh;
        m.source_prim = {0, 1};
        return m;
    }();
    std::vector<Mesh> changed(8, mesh);
    changed[0].positions[3].y += 1.0f;
    changed[1].triangles[1] = UVec3(4, 3, 5);
    changed[2].source_prim[1] = 2;
    changed[3].object[1] = 0;
    changed[4].objects[0].name += "x";
    changed[5].objects[1].base_color.x += 0.5f;
    changed[6].points.positions.push_back(Vec3(0.0f));
    changed[7].points.normals.push_back(Vec3(0.0f));
    for (size_t i = 0; i < changed.size(); ++i) EXPECT_NE(content_hash(changed[i]), content_hash(mesh)) << i;
}

TEST(Atrium, HasAboutAsManyTrianglesAsTheSponzaAtriumOfThePapersAndACameraInside) {
    const Scene scene = make("atrium");
    EXPECT_NEAR(static_cast<double>(scene.mesh.triangle_count()), 66454.0, 700.0);
    EXPECT_TRUE(scene.mesh.bounds().contains(Box{scene.camera->eye, scene.camera->eye}));
}

TEST(Spaceship, IsMadeOfReallyLongThinTriangles) {
    const Mesh mesh = make("spaceship").mesh;
    EXPECT_GE(mesh.triangle_count(), 60000u);
    EXPECT_LE(mesh.triangle_count(), 120000u);
    size_t above_50 = 0;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
        if (edge_to_height(mesh.triangle(prim)) > 50.0) ++above_50;
    EXPECT_GT(static_cast<double>(above_50), 0.5 * static_cast<double>(mesh.triangle_count()));
}

/// The volumes of all triangles' boxes together, in volumes of the scene's box.
double filled_by_boxes(const Mesh& mesh) {
    double sum = 0.0;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
        sum += mesh.triangle(prim).bounds().volume();
    return sum / mesh.bounds().volume();
}

TEST(Spaceship, IsTurnedSoThatItsLongPlatesFillTheirBoxes) {
    Mesh mesh = make("spaceship").mesh;
    const double turned = filled_by_boxes(mesh);
    transform(mesh, rotation(-45.0, {1.0, 1.0, 1.0}, DVec3(0.0)));
    const double straight = filled_by_boxes(mesh);
    EXPECT_GT(turned, 10.0);
    EXPECT_GT(turned, 20.0 * straight);
}

bool is_moving(const Mesh& mesh, uint32_t prim) {
    return mesh.objects[mesh.object[prim]].name.starts_with("moving ");
}

TEST(Kitchen, HasAFewHugeTrianglesAmongManySmallOnesAndACameraInside) {
    const Scene scene = make("kitchen");
    EXPECT_GE(scene.mesh.triangle_count(), 80000u);
    EXPECT_LE(scene.mesh.triangle_count(), 120000u);
    EXPECT_TRUE(scene.mesh.bounds().contains(Box{scene.camera->eye, scene.camera->eye}));
    const double room = scene.mesh.bounds().half_area();
    size_t huge = 0, small = 0;
    for (uint32_t prim = 0; prim < scene.mesh.triangle_count(); ++prim) {
        const double share = scene.mesh.triangle(prim).bounds().half_area() / room;
        huge += share > 0.05;
        small += share < 1e-4;
    }
    EXPECT_GE(huge, 8u);
    EXPECT_LE(huge, 40u);
    EXPECT_GT(small, 115000u);
}

TEST(Kitchen, EveryFrameHasTheSameTrianglesAndMovesOnlyWhatMoves) {
    const Mesh first = kitchen_at(0);
    std::vector<uint8_t> has_moved(first.objects.size(), 0);
    for (const int frame : {1, 7, 30, 59, 60, 61, 90, 119}) {
        Mesh mesh = kitchen_at(frame);
        ASSERT_EQ(mesh.triangles, first.triangles) << frame;
        ASSERT_EQ(mesh.object, first.object) << frame;
        EXPECT_EQ(mesh.bounds(), first.bounds()) << frame;  // nothing leaves the room
        for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
            const Triangle a = first.triangle(prim), b = mesh.triangle(prim);
            const bool same = a.a == b.a && a.b == b.b && a.c == b.c;
            if (!same) has_moved[mesh.object[prim]] = 1;
            if (!is_moving(mesh, prim)) {
                ASSERT_TRUE(same) << frame << " " << mesh.objects[mesh.object[prim]].name;
            }
        }
        Task task;
        check_mesh(mesh, task);
        EXPECT_EQ(mesh.triangle_count(), first.triangle_count()) << frame;
    }
    for (size_t i = 0; i < first.objects.size(); ++i)
        EXPECT_EQ(has_moved[i] != 0, first.objects[i].name.starts_with("moving ")) << first.objects[i].name;
}

TEST(Kitchen, PartsThatMoveStayRigid) {
    const Mesh first = kitchen_at(0), later = kitchen_at(37);
    for (uint32_t prim = 0; prim < first.triangle_count(); ++prim) {
        const Triangle a = first.triangle(prim), b = later.triangle(prim);
        // Corners are rounded to float once on each frame: 2^-24 of at most 8 m along each axis.
        ASSERT_NEAR(glm::length(DVec3(a.b) - DVec3(a.a)), glm::length(DVec3(b.b) - DVec3(b.a)), 4e-6);
        ASSERT_NEAR(glm::length(DVec3(a.c) - DVec3(a.b)), glm::length(DVec3(b.c) - DVec3(b.b)), 4e-6);
    }
}

/// The largest step of a vertex from one frame to the next.
double largest_step(int from, int to) {
    const Mesh a = kitchen_at(from), b = kitchen_at(to);
    double largest = 0.0;
    for (size_t i = 0; i < a.positions.size(); ++i)
        largest = std::max(largest, glm::length(DVec3(b.positions[i]) - DVec3(a.positions[i])));
    return largest;
}

TEST(Kitchen, IsALoopWithoutAJump) {
    const double usual = largest_step(20, 21);
    EXPECT_GT(usual, 0.01);
    EXPECT_LT(largest_step(119, 0), 1.5 * usual);
    EXPECT_LT(largest_step(59, 60), 1.5 * usual);
}

TEST(Kitchen, RefusesWhatIsNoFrame) {
    for (const char* frame : {"", "-1", "120", "1.5", "two", "1e1", "99999999999"}) {
        try {
            make("kitchen", {.values = {{"frame", frame}}});
            ADD_FAILURE() << frame;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage) << frame;
            EXPECT_NE(std::string(error.what()).find("0 to 119"), std::string::npos) << error.what();
        }
    }
}

TEST(Mirror, IsOneSurfaceAtTheTwoTessellationsOfThePaper) {
    const Mesh low = make("mirror-low").mesh;
    Mesh high = make("mirror-high").mesh;
    EXPECT_NEAR(static_cast<double>(low.triangle_count()), 85651.0, 860.0);
    EXPECT_NEAR(static_cast<double>(high.triangle_count()), 334080.0, 3400.0);
    EXPECT_NEAR(area_of(low) / area_of(high), 1.0, 1e-3);
    const Box a = low.bounds(), b = high.bounds();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(a.lower[axis], b.lower[axis], 1e-4f);
        EXPECT_NEAR(a.upper[axis], b.upper[axis], 1e-4f);
    }
    ASSERT_EQ(low.objects.size(), high.objects.size());
    Task task;
    check_mesh(high, task);
    EXPECT_TRUE(task.skipped.counts().empty());
}

TEST(PowerPlant, HasAsManyTrianglesAsThePapersAndMostAreOfPipes) {
    Scene scene = make("power-plant");
    Mesh& mesh = scene.mesh;
    EXPECT_GE(mesh.triangle_count(), 1667578u);
    EXPECT_LE(mesh.triangle_count(), 1672000u);
    Task task;
    check_mesh(mesh, task);
    EXPECT_TRUE(task.skipped.counts().empty());
    const Box hall{Vec3(-0.5f), Vec3(72.5f, 27.5f, 36.5f)};
    EXPECT_TRUE(hall.contains(mesh.bounds()));
    EXPECT_TRUE(mesh.bounds().contains(Box{scene.camera->target, scene.camera->target}));
    size_t of_pipes = 0;
    for (const uint32_t object : mesh.object)
        for (const char* service : {"steam", "water", "gas", "oil", "fire water", "air"})
            of_pipes += mesh.objects[object].name == service;
    EXPECT_GT(static_cast<double>(of_pipes), 0.8 * static_cast<double>(mesh.triangle_count()));
}

TEST(PowerPlant, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    Scene scene;
    for (const BuiltInScene& built_in : built_in_scenes())
        if (std::string(built_in.name) == "power-plant") built_in.make({}, scene, task);
    EXPECT_LT(scene.mesh.triangle_count(), 200000u);
}

TEST(Terrain, RoundsTheNumberOfTrianglesToTheNearestGrid) {
    EXPECT_EQ(make("terrain").mesh.triangle_count(), 2u * 224 * 224);
    EXPECT_EQ(make_terrain_of("2").mesh.triangle_count(), 2u);
    EXPECT_EQ(make_terrain_of("1").mesh.triangle_count(), 2u);
    EXPECT_EQ(make_terrain_of("200").mesh.triangle_count(), 200u);
    EXPECT_EQ(make_terrain_of("20k").mesh.triangle_count(), 20000u);
    EXPECT_EQ(make_terrain_of("0.125M").mesh.triangle_count(), 125000u);
}

TEST(Terrain, RefusesWhatIsNoNumberOfTriangles) {
    for (const char* tris : {"", "0", "-5", "many", "10G", "1e", "50.1M", "nan", "inf", "1e999"}) {
        try {
            make_terrain_of(tris);
            ADD_FAILURE() << tris;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), ExitCode::WrongUsage) << tris;
        }
    }
}

TEST(Terrain, IsAHeightFieldThatLooksUp) {
    const Mesh mesh = make_terrain_of("20k").mesh;
    for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim) {
        const Triangle t = mesh.triangle(prim);
        EXPECT_GT(glm::cross(DVec3(t.b) - DVec3(t.a), DVec3(t.c) - DVec3(t.a)).y, 0.0);
    }
}

TEST(Terrain, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    Scene scene;
    built_in_scenes().back().make({.values = {{"tris", "2M"}}}, scene, task);
    EXPECT_EQ(task.done.load(), 0u);
}

}  // namespace
}  // namespace boxwood
