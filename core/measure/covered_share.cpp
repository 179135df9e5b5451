#include "core/measure/covered_share.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace boxwood {
namespace {

/// A part in the box's own coordinates: the box is [0, 1] in each axis that counts.
struct Part {
    DVec3 lower, upper;
};

/// Length of the union of the parts' intervals.
double covered_length(std::vector<Part>& parts, int axis) {
    std::ranges::sort(parts, {}, [axis](const Part& part) { return part.lower[axis]; });
    double length = 0.0, end = 0.0;
    for (const Part& part : parts) {
        length += std::max(part.upper[axis] - std::max(part.lower[axis], end), 0.0);
        end = std::max(end, part.upper[axis]);
    }
    return length;
}

/// Of the unit square or cube in the first `axis_count` axes: slab by slab between the parts' planes.
double covered(std::vector<Part> parts, const DVec3& counts, int axis) {
    while (axis > 0 && counts[axis] == 0.0) --axis;  // a flat axis: the parts all lie in it
    if (axis == 0 && counts[0] == 0.0) return parts.empty() ? 0.0 : 1.0;
    const bool is_last = axis == 0 || (counts[0] == 0.0 && (axis == 1 || counts[1] == 0.0));
    if (is_last) return covered_length(parts, axis);
    std::vector<double> planes;
    for (const Part& part : parts) {
        planes.push_back(part.lower[axis]);
        planes.push_back(part.upper[axis]);
    }
    std::ranges::sort(planes);
    double share = 0.0;
    for (size_t i = 1; i < planes.size(); ++i) {
        const double thickness = planes[i] - planes[i - 1];
        if (!(thickness > 0.0)) continue;
        std::vector<Part> inside;
        for (const Part& part : parts)
            if (part.lower[axis] <= planes[i - 1] && part.upper[axis] >= planes[i]) inside.push_back(part);
        if (!inside.empty()) share += thickness * covered(std::move(inside), counts, axis - 1);
    }
    return share;
}

double volume_of(const Part& part, const DVec3& counts) {
    double volume = 1.0;
    for (int axis = 0; axis < 3; ++axis)
        if (counts[axis] != 0.0) volume *= std::max(part.upper[axis] - part.lower[axis], 0.0);
    return volume;
}

}  // namespace

double covered_share(const Box& box, std::span<const Box> parts) {
    if (box.is_empty()) return 0.0;
    const DVec3 extent = box.extent();
    DVec3 counts(0.0);  // 1 for the axes in which the box has an extent
    for (int axis = 0; axis < 3; ++axis) counts[axis] = extent[axis] > 0.0 ? 1.0 : 0.0;
    std::vector<Part> inside;
    for (const Box& part : parts) {
        const Box common = {glm::max(part.lower, box.lower), glm::min(part.upper, box.upper)};
        if (common.is_empty()) continue;
        Part scaled{DVec3(0.0), DVec3(0.0)};
        for (int axis = 0; axis < 3; ++axis) {
            if (counts[axis] == 0.0) continue;
            const double origin = static_cast<double>(box.lower[axis]);
            scaled.lower[axis] = (static_cast<double>(common.lower[axis]) - origin) / extent[axis];
            scaled.upper[axis] = (static_cast<double>(common.upper[axis]) - origin) / extent[axis];
        }
        inside.push_back(scaled);
    }
    if (inside.size() == 2) {
        const Part common{glm::max(inside[0].lower, inside[1].lower),
                          glm::min(inside[0].upper, inside[1].upper)};
        return volume_of(inside[0], counts) + volume_of(inside[1], counts) - volume_of(common, counts);
    }
    return inside.empty() ? 0.0 : covered(std::move(inside), counts, 2);
}

}  // namespace boxwood
