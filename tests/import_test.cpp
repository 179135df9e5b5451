#include "core/scene/import.h"

#include <gtest/gtest.h>

#include "core/base/timer.h"
#include "core/scene/import_stream.h"
#include "tests/support/load_text.h"

namespace boxwood {
namespace {

/// A triangle and a concave quad in Geomview's format, which only the import knows.
const std::string kOff = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST(Import, ReadsOtherFormatsInAChildProcess) {
    const Scene scene = load_bytes("a.off", kOff);
    EXPECT_EQ(scene.mesh.triangle_count(), 2u);
    EXPECT_DOUBLE_EQ(area_of(scene.mesh), 1.0);
    ASSERT_FALSE(scene.mesh.objects.empty());
}

TEST(Import, RefusalAndUnknownFormatAreSentences) {
    EXPECT_TRUE(refusal_of("a.off", "OFF\nnothing\n").starts_with("the import "))
        << refusal_of("a.off", "OFF\n");
    EXPECT_EQ(refusal_of("a.xyzzy", "nothing"),
              "the format is not known, expected glTF, OBJ, PLY, STL or what Assimp reads.");
}

TEST(Import, StopEndsTheChildSoon) {
    const TemporaryFolder folder;
    std::stop_source source;
    source.request_stop();
    Task task(source.get_token());
    const Timer timer;
    const InputFile file = read_input_file(folder.write("a.off", kOff));
    Scene scene;
    read_by_import(file, scene, task);
    EXPECT_LT(timer.milliseconds(), 1000.0);
}

TEST(Import, StreamComesBackAsItWent) {
    Mesh mesh;
    mesh.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 0}};
    mesh.object = {add_object(mesh, "a"), add_object(mesh, "b", Vec3(0.5f))};
    const std::string stream = write_import_stream(mesh);
    Scene scene;
    read_import_stream({"f", "bytes"}, stream, scene);
    EXPECT_EQ(scene.mesh.positions, mesh.positions);
    EXPECT_EQ(scene.mesh.triangles, mesh.triangles);
    EXPECT_EQ(scene.mesh.object, mesh.object);
    EXPECT_EQ(scene.mesh.objects[1].name, "b");
    EXPECT_EQ(scene.mesh.objects[1].base_color, Vec3(0.5f));
}

TEST(Import, StreamCutOrForgedIsAnError) {
    Mesh mesh;
    mesh.positions = {{1, 2, 3}};
    mesh.triangles = {{0, 0, 0}};
    mesh.object = {0};
    const InputFile file{"f", "bytes"};
    const std::string no_such_object = write_import_stream(mesh);
    Scene scene;
    EXPECT_THROW(read_import_stream(file, no_such_object, scene), Error);
    add_object(mesh, "a");
    const std::string stream = write_import_stream(mesh);
    for (size_t length = 0; length < stream.size(); ++length) {
        Scene cut;
        EXPECT_THROW(read_import_stream(file, stream.substr(0, length), cut), Error) << length;
    }
    std::string forged = stream;
    forged[8] = '\x7f';  // the top byte of the count of positions
    EXPECT_THROW(read_import_stream(file, forged, scene), Error);
}

}  // namespace
}  // namespace boxwood
