#include "bench/lecture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace boxwood::bench {
namespace {

constexpr double kCornerBytes = 36.0;  ///< three corners of three floats

/// Indices of words, both ends included; nothing where first > last.
struct WordRange {
    size_t first = 1, last = 0;
    const char* note = "";
};

/// One line of the lecture's table. A structure belongs to the line whose key its family's name contains.
struct LectureLine {
    const char* family;
    WordRange memory, build, uniform_traversal, clustered_traversal;
};

constexpr size_t kNone = 0, kLow = 1, kHigh = 2;
constexpr size_t kAbysmal = 0, kPoor = 1, kOk = 2, kGood = 3, kExcellent = 4;

constexpr WordRange kAnyTree{kGood, kExcellent};
constexpr LectureLine kLines[] = {
    {"list", {kNone, kNone}, {kNone, kNone}, {kAbysmal, kAbysmal}, {kAbysmal, kAbysmal}},
    {"grid", {kLow, kHigh, "resolution"}, {kLow, kLow}, {kOk, kOk, "uniform"}, {kPoor, kPoor, "otherwise"}},
    {"octree", {kLow, kHigh, "overlap, uniformity"}, {kLow, kLow}, {kGood, kGood}, {kGood, kGood}},
    {"quadtree", {kLow, kHigh, "overlap, uniformity"}, {kLow, kLow}, {kGood, kGood}, {kGood, kGood}},
    {"kd-tree", {kLow, kHigh, "overlap"}, {kLow, kHigh}, kAnyTree, kAnyTree},
    {"BVH", {kLow, kLow}, {kLow, kHigh}, kAnyTree, kAnyTree},
};

const LectureLine* line_of(const std::string& family) {
    for (const LectureLine& line : kLines)
        if (family.find(line.family) != std::string::npos) return &line;
    return nullptr;
}

/// The word of a value: words[i] up to limits[i], the last one beyond.
template <size_t kCount>
size_t word_of(double value, const std::array<double, kCount>& limits) {
    return static_cast<size_t>(std::ranges::lower_bound(limits, value) - limits.begin());
}

std::string range_text(const WordRange& range, std::span<const char* const> words) {
    std::string text = words[range.first];
    if (range.last > range.first) text += " - " + std::string(words[range.last]);
    return *range.note == '\0' ? text : text + " (" + range.note + ")";
}

/// `more_is_better`: whether a later word praises.
LectureWord compare(size_t measured, const WordRange* claimed, std::span<const char* const> words,
                    bool more_is_better) {
    LectureWord result{words[measured], "", ""};
    if (claimed == nullptr) return result;
    result.lecture = range_text(*claimed, words);
    const bool is_below = measured<claimed->first, is_above = measured> claimed->last;
    result.verdict = !is_below && !is_above ? "yes" : is_above == more_is_better ? "better" : "worse";
    return result;
}

double traversal_rate(const MeasuredStructure& s) {
    const double primary = s.primary.mrays_per_s(), diffuse = s.diffuse.mrays_per_s();
    return std::isfinite(diffuse) ? std::sqrt(primary * diffuse) : primary;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace

double clustering(const Mesh& mesh) {
    const size_t count = mesh.triangle_count();
    if (count == 0) return 0.0;
    const Box box = mesh.bounds();
    // Cubic cells: a box that is flat has one layer of them.
    const DVec3 extent = glm::max(
        box.extent(), DVec3(1e-3 * std::max({box.extent().x, box.extent().y, box.extent().z, 1e-300})));
    const double side = std::cbrt(extent.x * extent.y * extent.z / static_cast<double>(count));
    std::map<std::array<int64_t, 3>, uint64_t> cells;
    for (uint32_t prim = 0; prim < count; ++prim) {
        const Triangle t = mesh.triangle(prim);
        const DVec3 center = (DVec3(t.a) + DVec3(t.b) + DVec3(t.c)) / 3.0;
        std::array<int64_t, 3> cell{};
        for (int axis = 0; axis < 3; ++axis)
            cell[static_cast<size_t>(axis)] =
                static_cast<int64_t>((center[axis] - static_cast<double>(box.lower[axis])) / side);
        ++cells[cell];
    }
    double sum = 0.0;
    for (const auto& [cell, filled] : cells) sum += static_cast<double>(filled) * static_cast<double>(filled);
    const double n = static_cast<double>(count);
    return sum / n / std::cbrt(n);
}

std::string rule_text(const LectureRule& rule) {
    return "The lecture's words, by our rule (it gives no numbers):\n"
           "  memory     bytes of the structure over those of the triangles' corners (36 each): none up to " +
           number(rule.no_memory) + ", low up to " + number(rule.low_memory) +
           ", high beyond\n"
           "  build      time over that of the fastest structure that is no list: none up to " +
           number(rule.no_build) + ", low up to " + number(rule.low_build) +
           ", high beyond\n"
           "  traversal  rays per second (geometric mean of primary and diffuse) over the fastest: abysmal "
           "up to " +
           number(rule.poor) + ",\n             poor up to " + number(rule.ok) + ", ok up to " +
           number(rule.good) + ", good up to " + number(rule.excellent) +
           ", excellent beyond\n"
           "  uniform    clustering up to " +
           number(kUniformClustering) +
           ": triangles that share the cell of a triangle, on average, over the cube root\n"
           "             of their number, in as many cubic cells as there are triangles\n";
}

std::vector<LectureRow> judge_lecture(std::span<const MeasuredStructure> structures, size_t triangle_count,
                                      bool is_uniform, const LectureRule& rule) {
    double least_build = std::numeric_limits<double>::infinity(), best_rate = 0.0;
    for (const MeasuredStructure& s : structures) {
        if (!s.is_built) continue;
        if (!s.is_list) least_build = std::min(least_build, s.build_ms);
        best_rate = std::max(best_rate, traversal_rate(s));
    }
    const double corner_bytes = kCornerBytes * static_cast<double>(std::max<size_t>(triangle_count, 1));
    const std::array<double, 2> memory_limits{rule.no_memory, rule.low_memory},
        build_limits{rule.no_build, rule.low_build};
    const std::array<double, 4> traversal_limits{rule.poor, rule.ok, rule.good, rule.excellent};
    std::vector<LectureRow> rows;
    for (const MeasuredStructure& s : structures) {
        LectureRow& row = rows.emplace_back();
        if (!s.is_built) continue;
        const LectureLine* line = line_of(s.family);
        const WordRange* traversal = line == nullptr ? nullptr
                                     : is_uniform    ? &line->uniform_traversal
                                                     : &line->clustered_traversal;
        row.memory = compare(word_of(static_cast<double>(s.bytes) / corner_bytes, memory_limits),
                             line == nullptr ? nullptr : &line->memory, kCostWords, false);
        row.build = compare(word_of(s.build_ms / least_build, build_limits),
                            line == nullptr ? nullptr : &line->build, kCostWords, false);
        row.traversal = compare(word_of(traversal_rate(s) / best_rate, traversal_limits), traversal,
                                kTraversalWords, true);
    }
    return rows;
}

ReportRow numbers_row(const MeasuredStructure& s, const Scene& scene) {
    const auto triangles = static_cast<double>(std::max<size_t>(scene.mesh.triangle_count(), 1));
    ReportRow row;
    row.set("scene", scene.spec)
        .set("recipe", s.recipe)
        .set("triangles", uint64_t{scene.mesh.triangle_count()});
    if (s.is_built) {
        row.set("references", s.references)
            .set("bytes", s.bytes)
            .set("bytes_per_triangle", static_cast<double>(s.bytes) / triangles)
            .set("sah_cost", s.sah_cost);
    }
    return row.set("build_ms", s.build_ms)
        .set("threads", uint64_t{1})
        .set("primary_rays", s.primary.rays)
        .set("primary_mrays_per_s", s.primary.mrays_per_s())
        .set("diffuse_rays", s.diffuse.rays)
        .set("diffuse_mrays_per_s", s.diffuse.mrays_per_s());
}

ReportRow words_row(const MeasuredStructure& s, const LectureRow& words, const Scene& scene) {
    ReportRow row;
    row.set("scene", scene.spec).set("recipe", s.recipe);
    const auto set = [&](const std::string& key, const LectureWord& word) {
        row.set(key, word.measured).set(key + "_lecture", word.lecture).set(key + "_holds", word.verdict);
    };
    set("memory", words.memory);
    set("build", words.build);
    set("traversal", words.traversal);
    return row;
}

}  // namespace boxwood::bench
