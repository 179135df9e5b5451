#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/structures.h"
#include "core/measure/report.h"
#include "core/scene/mesh.h"

namespace boxwood::bench {

// The comparison table of Kerbl's lecture "Acceleration Data Structures" (slides "Structure, Memory
// Consumption, Building Time, (Expected) Traversal Time") beside what was measured.

/// How unevenly triangles fill the scene's box, cut into as many cubic cells as there are triangles (about):
/// the triangles that share the cell of a triangle, on average over the triangles, over the cube root of
/// their number. A smooth surface spread through the box has about N^(2/3) of N cells, thus N^(1/3) triangles
/// in each, and a value of about 1, whatever N is. 0 for no triangle.
double clustering(const Mesh& mesh);

/// Up to here a scene is "uniform".
inline constexpr double kUniformClustering = 1.0;

/// The words from the least to the greatest, as the lecture uses them.
inline constexpr const char* kCostWords[] = {"none", "low", "high"};
inline constexpr const char* kTraversalWords[] = {"abysmal", "poor", "ok", "good", "excellent"};

/// What numbers the words stand for. The lecture gives none: these are ours, and printed with every table.
struct LectureRule {
    /// Bytes per triangle, relative to the triangle's own three corners, 36 bytes.
    double no_memory = 0.25, low_memory = 3.0;
    /// Build time, relative to the fastest structure that is no list.
    double no_build = 0.25, low_build = 4.0;
    /// Rays per second, primary and diffuse by their geometric mean, relative to the fastest structure.
    double poor = 0.02, ok = 0.15, good = 0.4, excellent = 0.8;
};

/// The rule as sentences.
std::string rule_text(const LectureRule& rule);

/// One property of one structure: the word that the number gets, the lecture's words, and whether they hold.
struct LectureWord {
    std::string measured;  ///< one word; empty where nothing was measured
    std::string lecture;   ///< "low - high (resolution)"; empty where the lecture says nothing
    std::string verdict;   ///< "yes", "better", "worse"; empty where one of both is missing
};

struct LectureRow {
    LectureWord memory, build, traversal;
};

/// Rows in the order of the structures, all of one scene.
std::vector<LectureRow> judge_lecture(std::span<const MeasuredStructure> structures, size_t triangle_count,
                                      bool is_uniform, const LectureRule& rule = {});

/// Numbers and words of one structure, under the keys of the design.
ReportRow numbers_row(const MeasuredStructure& structure, const Scene& scene);
ReportRow words_row(const MeasuredStructure& structure, const LectureRow& words, const Scene& scene);

}  // namespace boxwood::bench
