#include <gtest/gtest.h>

#include "tests/support/load_text.h"

namespace boxwood {
namespace {

const std::string kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(LoadObj, KeepsTheOrderOfFacesAcrossGroupsAndMaterials) {
    const Scene scene =
        load_bytes("a.obj", kObjSquare +
                                "g left\nf 1 2 3\ng right\nusemtl m\nf 2 3 4\ng left\nusemtl n\n"
                                "f -4 -2 -1\nf 3/1/1 4//2 1/3\n");
    const Array<UVec3> expected = {{0, 1, 2}, {1, 2, 3}, {0, 2, 3}, {2, 3, 0}};
    EXPECT_EQ(scene.mesh.triangles, expected);
    EXPECT_EQ(scene.mesh.source_prim, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(scene.mesh.object, (std::vector<uint32_t>{0, 1, 0, 0}));  // unknown materials are one
    EXPECT_EQ(scene.mesh.objects[0].name, "left");
    EXPECT_EQ(scene.title, "a.obj");
}

TEST(LoadObj, CoordinatesAreRoundedOnceToFloat) {
    // Halfway between two floats and a bit above: rounding to double first would lose the bit.
    const Scene scene =
        load_bytes("a.obj", "v 1.00000005960464477539062500001 +2 0\nv 1e-46 -1e-40 0\nv 0 0 1\nf 1 2 3");
    EXPECT_EQ(scene.mesh.positions[0], Vec3(1.00000012f, 2.0f, 0.0f));
    EXPECT_EQ(scene.mesh.positions[1], Vec3(0.0f, -1e-40f, 0.0f));
}

TEST(LoadObj, ConcavePolygonCoversItsOutline) {
    const Scene scene = load_bytes("a.obj", "v 0 0 2\nv 2 0 2\nv 1 0.5 2\nv 2 2 2\nv 0 2 2\nf 2 3 4 5 1\n");
    EXPECT_EQ(scene.mesh.triangle_count(), 3u);
    EXPECT_DOUBLE_EQ(area_of(scene.mesh), 3.0);  // the square of 4 less the dent: 2 * 1 / 2
}

TEST(LoadObj, AnyLineEndContinuationAndTrailingComment) {
    const Scene scene =
        load_bytes("a.obj", "v 0 0 0\rv 1 0 0\r\nv 0 1 0 # here\nf 1 \\\r\n 2 \\\n3 # face\r# end");
    EXPECT_EQ(scene.mesh.triangles, (Array<UVec3>{{0, 1, 2}}));
}

TEST(LoadObj, ErrorsNameTheLine) {
    EXPECT_EQ(refusal_of("a.obj", kObjSquare + "f 1 2 5\n"),
              "line 5: vertex index 5, expected 1 to 4 or -1 to -4.");
    EXPECT_EQ(refusal_of("a.obj", "v 0 0\r\r"), "line 1: found \"\", expected the z coordinate of a vertex.");
    EXPECT_EQ(refusal_of("a.obj", kObjSquare + "\\\n\nf 1 2 99999999999\n"),
              "line 7: a vertex index of more than nine digits.");
    EXPECT_EQ(refusal_of("a.obj", kObjSquare + "f 1 two 3\n"),
              "line 5: found \"f 1 two 3\", expected a face of vertex indices.");
}

TEST(LoadObj, OverflowingCoordinateIsDroppedAndCounted) {
    const Scene scene = load_bytes("a.obj", kObjSquare + "v 1e400 0 0\nf 1 2 3\nf 1 2 5\nl 1 2\n");
    EXPECT_EQ(scene.mesh.triangle_count(), 1u);
    const std::map<std::string, uint64_t> expected = {{"line or point", 1}, {"non-finite vertex", 1}};
    EXPECT_EQ(scene.skipped, expected);
}

TEST(LoadObj, MaterialFileGivesBaseColourAndStaysInItsFolder) {
    const TemporaryFolder folder;
    folder.write("secret.mtl", "newmtl red\nKd 0 0 1\n");
    folder.write("in/colors.mtl", "newmtl grey\nKd .5 .5 .5\nnewmtl red\nKd 1 0.25 0\n");
    Task task;
    const std::string faces = kObjSquare + "usemtl red\nf 1 2 3\n";
    const Scene good = load_file(folder.write("in/a.obj", "mtllib colors.mtl\n" + faces), task);
    EXPECT_EQ(good.mesh.base_color(0), Vec3(1.0f, 0.25f, 0.0f));
    EXPECT_TRUE(good.warnings.empty());
    const Scene outside = load_file(folder.write("in/b.obj", "mtllib ../secret.mtl\n" + faces), task);
    EXPECT_EQ(outside.mesh.base_color(0), Vec3(0.8f));
    EXPECT_EQ(outside.warnings.size(), 1u);
    folder.write("in/empty.mtl", " ");
    const Scene empty = load_file(folder.write("in/c.obj", "mtllib empty.mtl\n" + faces), task);
    EXPECT_EQ(empty.mesh.base_color(0), Vec3(0.8f));
}

TEST(LoadObj, KnownByItsContentWithoutExtension) {
    EXPECT_EQ(load_bytes("scene", "# no name\n" + kObjSquare + "f 1 2 3 4").mesh.triangle_count(), 2u);
}

}  // namespace
}  // namespace boxwood
