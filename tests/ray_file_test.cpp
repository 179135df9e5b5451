#include "core/measure/ray_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "core/base/error.h"

namespace boxwood {
namespace {

std::string refusal_of_rays(const std::string& text) {
    try {
        parse_rays(text, "rays.txt");
    } catch (const Error& error) {
        EXPECT_EQ(error.exit_code(), ExitCode::BadInput);
        return error.what();
    }
    return "accepted";
}

TEST(RayFile, ReadsDecimalAndHexFloatsCommentsAndBlankLines) {
    const RayFile file = parse_rays(
        "# id ox oy oz dx dy dz tmin tmax\n"
        "\n"
        "first 1 -2.5 1e-3 0x1.8p+1 -0x0p+0 0x1p-149 0 inf\r\n"
        "\t2  0 0 0  0 0 1  0.5 nan",
        "rays.txt");
    ASSERT_EQ(file.ids, (std::vector<std::string>{"first", "2"}));
    const Ray& ray = file.rays[0];
    EXPECT_EQ(ray.origin, Vec3(1.0f, -2.5f, 1e-3f));
    EXPECT_EQ(ray.direction.x, 3.0f);
    EXPECT_TRUE(std::signbit(ray.direction.y));
    EXPECT_EQ(ray.direction.z, std::numeric_limits<float>::denorm_min());
    EXPECT_EQ(ray.t_max, std::numeric_limits<float>::infinity());
    EXPECT_EQ(file.rays[1].t_min, 0.5f);
    EXPECT_TRUE(std::isnan(file.rays[1].t_max));
}

TEST(RayFile, NamesTheBadLineAndWhatWasExpected) {
    EXPECT_EQ(refusal_of_rays("a 0 0 0 0 0 1 0 1\nb 0 0 0 0 0 1 0\n"),
              "rays.txt, line 2: tmax is missing, expected: id ox oy oz dx dy dz tmin tmax");
    EXPECT_EQ(refusal_of_rays("#\n\nb 0 zero 0 0 0 1 0 1\n"),
              "rays.txt, line 3: oy is \"zero\", expected a number");
    EXPECT_EQ(refusal_of_rays("b 0 0 0 0 0 1 0 1 7"),
              "rays.txt, line 1: \"7\" is one word too many, expected: id ox oy oz dx dy dz tmin tmax");
    EXPECT_EQ(refusal_of_rays("b 1e400 0 0 0 0 1 0 1"),
              "rays.txt, line 1: ox is 1e400, which no float holds");
}

TEST(RayFile, ATMinBelowZeroOrNotANumberIsRefused) {
    const char* expected = "expected 0 or more: a ray begins at its origin or behind it";
    EXPECT_EQ(refusal_of_rays("b 0 0 0 0 0 1 -1 1"),
              std::string("rays.txt, line 1: tmin is -1, ") + expected);
    EXPECT_EQ(refusal_of_rays("b 0 0 0 0 0 1 nan 1"),
              std::string("rays.txt, line 1: tmin is nan, ") + expected);
}

TEST(RayFile, ARayLineReadsBackBitForBit) {
    const Ray ray{
        {0.1f, -1e-42f, 3e38f}, 0.25f, {-0.0f, 1.0f / 3.0f, -7.0f}, std::numeric_limits<float>::infinity()};
    const RayFile file = parse_rays(ray_line("id", ray), "x");
    ASSERT_EQ(file.rays.size(), 1u);
    EXPECT_EQ(std::memcmp(&file.rays[0], &ray, sizeof(Ray)), 0);
}

TEST(RayFile, BinaryRaysAreEightLittleEndianFloats) {
    std::string bytes;
    for (const float number : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.0f}) {
        const uint32_t bits = std::bit_cast<uint32_t>(number);
        for (int byte = 0; byte < 4; ++byte) bytes.push_back(static_cast<char>(bits >> (8 * byte)));
    }
    const RayFile file = parse_binary_rays(bytes + bytes, "rays.bin");
    EXPECT_EQ(file.ids, (std::vector<std::string>{"0", "1"}));
    EXPECT_EQ(file.rays[1].origin, Vec3(1.0f, 2.0f, 3.0f));
    EXPECT_EQ(file.rays[1].direction, Vec3(4.0f, 5.0f, 6.0f));
    EXPECT_EQ(file.rays[1].t_min, 7.0f);
    EXPECT_EQ(file.rays[1].t_max, 8.0f);
    EXPECT_THROW(parse_binary_rays(bytes + "x", "rays.bin"), Error);
}

TEST(RayFile, HitsNameThePrimitiveAsCountedInTheFile) {
    Mesh mesh;
    mesh.source_prim = {4, 9};
    RayFile file;
    file.ids = {"a", "b"};
    EXPECT_EQ(hit_lines(file, std::vector<Hit>{{0.1f, 1}, {}}, mesh), "a 9 0.1\nb -1 inf\n");
}

}  // namespace
}  // namespace boxwood
