#include "core/measure/leaf_count_variability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/measure/search_boxes.h"

namespace boxwood {
namespace {

constexpr size_t kLineBatch = 256;  ///< lines that share one sequence of random numbers

struct Line {
    DVec3 origin, direction;
};

/// A point of the box's surface, and a direction by cosine from there into the box.
class LineMaker {
public:
    explicit LineMaker(const Box& box) : lower_(box.lower), extent_(box.extent()) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const glm::length_t u = static_cast<glm::length_t>((axis + 1) % 3);
            const glm::length_t v = static_cast<glm::length_t>((axis + 2) % 3);
            area_[axis] = extent_[u] * extent_[v];
        }
    }

    Line next(Rng& rng) const {
        double place = next_double(rng) * (area_[0] + area_[1] + area_[2]);
        int axis = 0;
        while (axis < 2 && place >= area_[static_cast<size_t>(axis)])
            place -= area_[static_cast<size_t>(axis++)];
        const bool is_upper = rng.next() < 0.5f;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        Line line;
        line.origin[axis] = lower_[axis] + (is_upper ? extent_[axis] : 0.0);
        line.origin[u] = lower_[u] + next_double(rng) * extent_[u];
        line.origin[v] = lower_[v] + next_double(rng) * extent_[v];
        double x = 0.0, y = 0.0;
        do {
            x = 2.0 * next_double(rng) - 1.0;
            y = 2.0 * next_double(rng) - 1.0;
        } while (x * x + y * y >= 1.0);
        line.direction[u] = x;
        line.direction[v] = y;
        line.direction[axis] = std::sqrt(1.0 - x * x - y * y) * (is_upper ? -1.0 : 1.0);
        return line;
    }

private:
    static double next_double(Rng& rng) { return static_cast<double>(rng.next_bits() >> 11) * 0x1p-53; }

    DVec3 lower_, extent_;
    std::array<double, 3> area_{};
};

/// Closed slabs; a line without extent along an axis has to lie between its planes.
bool meets(const Line& line, const DVec3& inverse, const Box& box) {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = static_cast<double>(box.lower[axis]) - line.origin[axis];
        const double upper = static_cast<double>(box.upper[axis]) - line.origin[axis];
        if (line.direction[axis] == 0.0) {
            if (lower > 0.0 || upper < 0.0) return false;
            continue;
        }
        const double a = lower * inverse[axis], b = upper * inverse[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

struct Sums {
    double count = 0.0, squares = 0.0;
};

}  // namespace

LeafCounts count_leaves_on_lines(const NodeList& list, Task& task, size_t line_count, uint64_t seed) {
    LeafCounts result;
    if (list.nodes.empty() || line_count == 0 || !has_nested_boxes(list)) return result;
    if (!(list.nodes[0].bounds.half_area() > 0.0)) return result;
    const std::vector<SearchBox> boxes = search_boxes(list);
    const LineMaker maker(list.nodes[0].bounds);
    const auto count_leaves = [&](const Line& line) {
        const DVec3 inverse = 1.0 / line.direction;
        uint64_t leaves = 0;
        for (size_t i = 0; i < boxes.size();) {
            const SearchBox& box = boxes[i];
            const bool is_met = meets(line, inverse, box.bounds);
            if (is_met && box.node != kNoIndex && list.nodes[box.node].kind == NodeKind::Leaf) ++leaves;
            i = is_met ? i + 1 : box.end;
        }
        return static_cast<double>(leaves);
    };
    task.done = 0;
    task.total = line_count;
    std::vector<Sums> batches((line_count + kLineBatch - 1) / kLineBatch);
    parallel_for(line_count, kLineBatch, [&](size_t begin, size_t end) {
        Rng rng(mix_bits(seed) ^ begin);
        Sums& sums = batches[begin / kLineBatch];
        for (size_t i = begin; i < end && !task.stopped(); ++i) {
            const double leaves = count_leaves(maker.next(rng));
            sums.count += leaves;
            sums.squares += leaves * leaves;
        }
        task.done += end - begin;
    });
    Sums all;
    for (const Sums& batch : batches) {
        all.count += batch.count;
        all.squares += batch.squares;
    }
    const double n = static_cast<double>(line_count);
    result.mean = all.count / n;
    result.deviation = std::sqrt(std::max(all.squares / n - result.mean * result.mean, 0.0));
    return result;
}

}  // namespace boxwood
