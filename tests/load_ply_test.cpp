#include <gtest/gtest.h>

#include <bit>

#include "tests/support/load_text.h"

namespace boxwood {
namespace {

const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\nend_header\n";
const std::string kPlySquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

/// `value` as bytes, the most significant first.
template <class T>
std::string big_endian(T value) {
    std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    return {raw.rbegin(), raw.rend()};
}

TEST(LoadPly, AsciiPolygonsAndUnknownElements) {
    const Scene scene = load_bytes(
        "a.ply", "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar float k\nproperty int n\n" +
                     kVertices + "element face 2\nproperty uchar red\n" + kFaces + "3 1.5 nan 2 7\n" +
                     kPlySquare + "255 4 0 1 2 3\n0 3 2 3\n0");
    const Array<UVec3> expected = {{0, 1, 2}, {0, 2, 3}, {2, 3, 0}};
    EXPECT_EQ(scene.mesh.triangles, expected);
    EXPECT_EQ(scene.mesh.positions[2], Vec3(1, 1, 0));
}

TEST(LoadPly, BigEndianOfMixedTypesFacesFirst) {
    std::string bytes =
        "ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list short ushort vertex_index\nelement "
        "vertex 3\n"
        "property char x\nproperty double y\nproperty int z\nend_header\n";
    bytes +=
        big_endian<int16_t>(3) + big_endian<uint16_t>(2) + big_endian<uint16_t>(0) + big_endian<uint16_t>(1);
    for (int i = 0; i < 3; ++i)
        bytes += big_endian<int8_t>(-1) + big_endian(0.5 * i * i) + big_endian<int32_t>(-70000 * i);
    const Scene scene = load_bytes("a.ply", bytes);
    EXPECT_EQ(scene.mesh.triangles, (Array<UVec3>{{2, 0, 1}}));
    EXPECT_EQ(scene.mesh.positions[2], Vec3(-1.0f, 2.0f, -140000.0f));
}

TEST(LoadPly, StripsEndAtMinusOneAndKeepTheirFacing) {
    const Scene scene =
        load_bytes("a.ply", "ply\nformat ascii 1.0\n" + kVertices +
                                "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                                kPlySquare + "9 0 1 3 2 -1 1 2 3 -1\n");
    const Array<UVec3> expected = {{0, 1, 3}, {1, 2, 3}, {1, 2, 3}};
    EXPECT_EQ(scene.mesh.triangles, expected);  // all counter-clockwise
}

TEST(LoadPly, VerticesWithoutFacesArePoints) {
    const Scene scene =
        load_bytes("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\n"
                   "property float nz\nproperty float x\nproperty float y\nproperty float z\n"
                   "end_header\n0 0 1 5 6 7\n0 1 0 inf 0 0\n1 0 0 8 9 10\n");
    EXPECT_EQ(scene.mesh.points.positions, (Array<Vec3>{{5, 6, 7}, {8, 9, 10}}));
    EXPECT_EQ(scene.mesh.points.normals, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 0}}));
    EXPECT_EQ(scene.mesh.triangle_count(), 0u);
    EXPECT_EQ(scene.skipped.at("non-finite point"), 1u);
}

TEST(LoadPly, ErrorsNameThePlace) {
    const std::string head = "ply\nformat ascii 1.0\n" + kVertices + "element face 1\n" + kFaces;
    EXPECT_EQ(refusal_of("a.ply", head + "0 0 0\n1 x 0\n"), "line 11: found \"x\", expected a number.");
    EXPECT_EQ(refusal_of("a.ply", head + kPlySquare + "3 0 1 4\n"),
              "line 14: vertex index 4 in row 0 of element face, expected 0 to 4 - 1.");
    EXPECT_EQ(refusal_of("a.ply", head + kPlySquare + "3 0 1 0.5\n"),
              "line 14: vertex index 0.5 in row 0 of element face, expected 0 to 4 - 1.");
    EXPECT_EQ(refusal_of("a.ply", head + kPlySquare + "1e300 0 1 0.5\n"),
              "line 14: a list of 1e+300 values goes past the end of the file.");
    EXPECT_EQ(refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"),
              "line 4: unknown type \"half\".");
    EXPECT_EQ(refusal_of("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n"),
              "line 3: element count \"-1\", expected a whole number from 0.");
}

}  // namespace
}  // namespace boxwood
