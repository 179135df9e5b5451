#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/scene/load_file.h"

namespace boxwood {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(BOXWOOD_SHARED_DIR) / "scenes";

struct Row {
    std::string file;
    uint64_t triangles = 0, zero = 0;
    DVec3 lower{0.0}, upper{0.0};
};

uint64_t plain_number(std::string text) {
    std::erase(text, ',');
    return std::stoull(text);
}

/// The rows of the table of real scenes whose first cell names one file and whose fourth is a count.
std::vector<Row> read_rows() {
    std::vector<Row> rows;
    std::ifstream text(kFolder / "README.md");
    std::string line;
    while (std::getline(text, line)) {
        std::istringstream cells(line);
        std::vector<std::string> fields;
        std::string cell;
        while (std::getline(cells, cell, '|')) {
            const size_t begin = cell.find_first_not_of(' ');
            fields.push_back(
                begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
        }
        if (fields.size() < 8 || fields[1].find(',') != std::string::npos || fields[4].empty() ||
            fields[4].find_first_not_of("0123456789,") != std::string::npos)
            continue;
        Row row{fields[1], plain_number(fields[3]), plain_number(fields[4]), {}, {}};
        if (std::sscanf(fields[5].c_str(), "(%lf, %lf, %lf) (%lf, %lf, %lf)", &row.lower.x, &row.lower.y,
                        &row.lower.z, &row.upper.x, &row.upper.y, &row.upper.z) == 6)
            rows.push_back(row);
    }
    return rows;
}

uint64_t sum_of(const std::map<std::string, uint64_t>& counts) {
    uint64_t sum = 0;
    for (const auto& [reason, count] : counts) sum += count;
    return sum;
}

void check_counts(const Row& row) {
    Task task;
    const Scene scene = load_file((kFolder / row.file).string(), task);
    EXPECT_EQ(scene.mesh.triangle_count() + sum_of(scene.skipped), row.triangles) << row.file;
    EXPECT_EQ(task.skipped.counts()["zero area"], row.zero) << row.file;
    EXPECT_EQ(scene.title, row.file);
    const Box bounds = scene.mesh.bounds();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(static_cast<double>(bounds.lower[axis]), row.lower[axis], 0.00051) << row.file;
        EXPECT_NEAR(static_cast<double>(bounds.upper[axis]), row.upper[axis], 0.00051) << row.file;
    }
}

TEST(SceneFiles, HaveTheTrianglesAndBoxesOfTheirTable) {
    const std::vector<Row> rows = read_rows();
    if (rows.empty()) GTEST_SKIP() << "no folder " << kFolder;
    EXPECT_GE(rows.size(), 12u);
    for (const Row& row : rows) check_counts(row);
}

TEST(SceneFiles, OnePartAtTwoLevelsOfDetail) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no folder " << kFolder;
    const DVec3 lower(-123.045, -52.519, 103.171), upper(-10.545, 87.119, 223.171);
    check_counts({"cad_housing_coarse.glb", 11620, 0, lower, upper});
    check_counts({"cad_housing_fine.glb", 364824, 0, lower, upper});
}

TEST(SceneFiles, PointCloudHasItsPointsWithUnitNormals) {
    if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no folder " << kFolder;
    Task task;
    const Scene scene = load_file((kFolder / "bunny_scans_points.ply").string(), task);
    EXPECT_EQ(scene.mesh.triangle_count(), 0u);
    EXPECT_EQ(scene.mesh.points.positions.size(), 360573u);
    ASSERT_EQ(scene.mesh.points.normals.size(), 360573u);
    for (const Vec3& normal : scene.mesh.points.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-3f);
}

}  // namespace
}  // namespace boxwood
