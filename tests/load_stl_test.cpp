#include <gtest/gtest.h>

#include <bit>

#include "tests/support/load_text.h"

namespace boxwood {
namespace {

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\nendfacet\n";

std::string binary_stl(const std::string& header, uint32_t declared, const Array<Vec3>& corners) {
    std::string bytes = header;
    bytes.resize(80, ' ');
    const auto append = [&bytes](auto value) {
        const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
        bytes.append(raw.data(), raw.size());
    };
    append(declared);
    for (size_t i = 0; i < corners.size(); ++i) {
        if (i % 3 == 0) bytes.append(12, '\0');
        for (int axis = 0; axis < 3; ++axis) append(corners[i][axis]);
        if (i % 3 == 2) bytes.append(2, '\0');
    }
    return bytes;
}

TEST(LoadStl, BinaryEvenIfItBeginsWithSolid) {
    const Array<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1}, {1, 0, 1}, {0, -2, 1.5f}};
    const Scene scene = load_bytes("a.stl", binary_stl("solid text", 2, corners));
    EXPECT_EQ(scene.mesh.positions, corners);
    EXPECT_EQ(scene.mesh.triangles, (Array<UVec3>{{0, 1, 2}, {3, 4, 5}}));
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(load_bytes("a.stl", binary_stl("x", 1, corners)).warnings.size(), 1u);  // bytes left over
}

TEST(LoadStl, TextOfManySolidsInAnyCase) {
    std::string upper = kFacet;
    for (char& c : upper) c = static_cast<char>(std::toupper(c));
    const Scene scene =
        load_bytes("a.stl", "solid first part \n" + kFacet + "endsolid first part\r\nSOLID\n" + upper +
                                kFacet + "ENDSOLID\n");
    EXPECT_EQ(scene.mesh.triangle_count(), 3u);
    EXPECT_EQ(scene.mesh.object, (std::vector<uint32_t>{0, 1, 1}));
    EXPECT_EQ(scene.mesh.objects[0].name, "first part");
    EXPECT_EQ(corner_of(scene.mesh, 2, 1), Vec3(1, 0, 0));
}

TEST(LoadStl, ErrorsNameThePlace) {
    EXPECT_EQ(refusal_of("a.stl", "solid\n" + kFacet + "facet normal 0 0 1 outer loop\nvertex 0 zero 0"),
              "line 10: found \"zero\", expected a number.");
    EXPECT_EQ(refusal_of("a.stl", "solid\n" + kFacet),
              "line 9: found the end of the file, expected facet or endsolid.");
    EXPECT_EQ(refusal_of("a.stl", binary_stl("x", 3, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})),
              "byte 80: the STL declares 3 triangles, the file has room for 1.");
    EXPECT_EQ(refusal_of("a.stl", "short"), "an STL of 5 bytes, expected at least 84.");
}

}  // namespace
}  // namespace boxwood
