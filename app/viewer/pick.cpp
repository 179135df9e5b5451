#include "app/viewer/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "app/viewer/draw_list.h"

namespace boxwood {
namespace {

constexpr double kReach = 6.0;     // pixels at interface scale 1 from which a line is picked
constexpr double kSameLine = 2.0;  // pixels within which lines are equally near
constexpr double kLineBias = 8.0;  // pixels by which a line may lie behind the surface: see boxes.vert
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Where lines and boxes lie on screen.
class Projector {
public:
    explicit Projector(const PickPoint& point)
        : frame_(camera_frame(
              point.camera, static_cast<double>(point.view.width) / static_cast<double>(point.view.height))),
          size_(point.view.width, point.view.height),
          pointer_(glm::dvec2(point.pointer) - glm::dvec2(point.view.x, point.view.y)) {}

    /// Length in world units of a pixel at this distance along the view.
    double pixel_size(double depth) const {
        return 2.0 * frame_.half_height / size_.y * (frame_.orthographic ? 1.0 : depth);
    }
    double depth_of(const DVec3& point) const { return glm::dot(point - frame_.eye, frame_.forward); }
    double distance_of(const DVec3& point) const {
        return frame_.orthographic ? depth_of(point) : glm::length(point - frame_.eye);
    }

    /// Pixels from the pointer to the segment, of which what is farther along the view than `farthest` and
    /// its bias, or behind the eye, does not count.
    double distance_to(const Vec3& from, const Vec3& to, double farthest) const {
        DVec3 a(from), b(to);
        const double nearest = 1e-9 * (std::abs(depth_of(a)) + std::abs(depth_of(b)));
        if (!frame_.orthographic && !clip(a, b, nearest, /*keep_far=*/true)) return kInfinity;
        if (farthest < kInfinity && !clip(a, b, farthest + kLineBias * pixel_size(farthest), false))
            return kInfinity;
        const glm::dvec2 p = pixel_of(a), q = pixel_of(b), along = q - p;
        const double length2 = glm::dot(along, along);
        const double s = length2 > 0.0 ? std::clamp(glm::dot(pointer_ - p, along) / length2, 0.0, 1.0) : 0.0;
        return glm::length(p + s * along - pointer_);
    }

private:
    bool clip(DVec3& a, DVec3& b, double depth, bool keep_far) const {
        const double sign = keep_far ? 1.0 : -1.0;
        const double da = sign * (depth_of(a) - depth), db = sign * (depth_of(b) - depth);
        if (da < 0.0 && db < 0.0) return false;
        if (da < 0.0) a = glm::mix(a, b, da / (da - db));
        if (db < 0.0) b = glm::mix(b, a, db / (db - da));
        return true;
    }
    glm::dvec2 pixel_of(const DVec3& point) const {
        const DVec3 offset = point - frame_.eye;
        const double scale = frame_.orthographic ? 1.0 : 1.0 / glm::dot(offset, frame_.forward);
        const double x = glm::dot(offset, frame_.right) * scale / frame_.half_width;
        const double y = glm::dot(offset, frame_.up) * scale / frame_.half_height;
        return {0.5 * (x + 1.0) * size_.x, 0.5 * (1.0 - y) * size_.y};
    }

    CameraFrame frame_;
    glm::dvec2 size_, pointer_;
};

/// Where the ray enters the box grown by `margin`; nothing where it misses it.
std::optional<double> entry_of(const Ray& ray, const Box& box, double margin) {
    double t0 = 0.0, t1 = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const auto o = static_cast<double>(ray.origin[axis]), d = static_cast<double>(ray.direction[axis]);
        const double lower = static_cast<double>(box.lower[axis]) - margin - o;
        const double upper = static_cast<double>(box.upper[axis]) + margin - o;
        if (d == 0.0) {
            if (lower > 0.0 || upper < 0.0) return std::nullopt;
            continue;
        }
        t0 = std::max(t0, (d > 0.0 ? lower : upper) / d);
        t1 = std::min(t1, (d > 0.0 ? upper : lower) / d);
    }
    return t0 <= t1 ? std::optional(t0) : std::nullopt;
}

std::array<OutlineSegment, 12> edges_of(const Box& box) {
    std::array<OutlineSegment, 12> edges;
    for (size_t edge = 0; edge < 12; ++edge) {
        const int axis = static_cast<int>(edge >> 2), next = (axis + 1) % 3, last = (axis + 2) % 3;
        Vec3 from = box.lower;
        if ((edge & 1) != 0) from[next] = box.upper[next];
        if ((edge & 2) != 0) from[last] = box.upper[last];
        Vec3 to = from;
        to[axis] = box.upper[axis];
        edges[edge] = {0, from, to};
    }
    return edges;
}

/// Sorts candidates: near a line, holding the surface's point, passed by the ray.
struct Candidate {
    int kind;
    double line;  ///< steps of kSameLine
    double half_area;
    uint32_t node;
    auto key() const { return std::tuple(kind, line, half_area, node); }
};

class Picker {
public:
    Picker(const ViewerState& state, const LevelTable& levels, const PickPoint& point)
        : levels_(levels),
          projector_(point),
          ray_(pointer_ray(point.camera, point.pointer, point.view)),
          reach_(kReach * static_cast<double>(state.interface_scale)),
          surface_t_(static_cast<double>(point.surface_t)) {
        hides_ = !state.see_through && surface_t_ < kInfinity;
        if (surface_t_ < kInfinity) surface_ = DVec3(ray_.origin) + surface_t_ * DVec3(ray_.direction);
    }

    std::optional<Candidate> consider(uint32_t node) const {
        const Box& box = levels_.list.nodes[node].bounds;
        if (box.is_empty()) return std::nullopt;
        const double size = glm::length(box.extent());
        const double margin =
            reach_ * projector_.pixel_size(std::abs(projector_.distance_of(box.center())) + size);
        if (!entry_of(ray_, box, margin)) return std::nullopt;
        Candidate candidate{0, 0.0, box.half_area(), node};
        const double line = line_distance(node, box);
        if (line <= reach_) {
            candidate.line = std::floor(line / kSameLine);
            return candidate;
        }
        const std::optional<double> entry = entry_of(ray_, box, 0.0);
        if (!entry) return std::nullopt;
        candidate.kind = surface_t_ < kInfinity && holds_surface(box) ? 1 : 2;
        if (candidate.kind == 2 && hides_ && *entry > surface_t_) return std::nullopt;
        return candidate;
    }

private:
    double line_distance(uint32_t node, const Box& box) const {
        const double farthest = hides_ ? projector_.depth_of(surface_) : kInfinity;
        const std::span<const OutlineSegment> outline = levels_.outline(node);
        const std::array<OutlineSegment, 12> edges = edges_of(box);
        double least = kInfinity;
        for (const OutlineSegment& s : outline.empty() ? std::span<const OutlineSegment>(edges) : outline)
            least = std::min(least, projector_.distance_to(s.from, s.to, farthest));
        return least;
    }
    bool holds_surface(const Box& box) const {
        const double slack = 1e-6 * (glm::length(surface_) + glm::length(DVec3(ray_.origin)));
        for (int axis = 0; axis < 3; ++axis) {
            if (!(surface_[axis] >= static_cast<double>(box.lower[axis]) - slack &&
                  surface_[axis] <= static_cast<double>(box.upper[axis]) + slack)) {
                return false;
            }
        }
        return true;
    }

    const LevelTable& levels_;
    Projector projector_;
    Ray ray_;
    double reach_, surface_t_;
    bool hides_ = false;
    DVec3 surface_{0.0};
};

}  // namespace

std::vector<uint32_t> pick_nodes(const ViewerState& state, const LevelTable& levels,
                                 const Visibility& visibility, const Visits* visits, const PickPoint& point) {
    std::vector<Candidate> found;
    if (levels.level_count() == 0 || point.view.width < 1.0f || point.view.height < 1.0f) return {};
    const Picker picker(state, levels, point);
    const bool only_visited =
        state.box_color == BoxColor::Visits && !state.show_unvisited && visits != nullptr;
    const BoxSelection range = select_boxes(levels, state.levels, state.leaves_above);
    for (uint32_t i = 0; i < range.end; ++i) {
        const uint32_t node = levels.order[i];
        const NodeView& view = levels.list.nodes[node];
        const bool is_leaf = view.kind == NodeKind::Leaf;
        if (view.level < range.first_level && !(state.leaves_above && is_leaf)) continue;
        if (is_leaf && view.ref_count == 0 && !state.show_empty) continue;
        if (!visibility.shows(node) || (only_visited && visits->by_node[node] == 0)) continue;
        if (const std::optional<Candidate> candidate = picker.consider(node)) found.push_back(*candidate);
    }
    const size_t count = std::min(found.size(), kMostPicked);
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(count);
    std::ranges::partial_sort(found, middle, {}, &Candidate::key);
    std::vector<uint32_t> nodes;
    for (const Candidate& candidate : std::span(found).first(count)) nodes.push_back(candidate.node);
    return nodes;
}

uint32_t next_candidate(const std::vector<uint32_t>& candidates, uint32_t selected) {
    if (candidates.empty()) return kNoIndex;
    const auto at = std::ranges::find(candidates, selected);
    if (at == candidates.end() || at + 1 == candidates.end()) return candidates.front();
    return *(at + 1);
}

void find_nodes_again(SideState& state, const NodeList& from, const NodeList& to) {
    const auto again = [&](uint32_t node) {
        uint32_t found = kNoIndex;
        if (node >= from.nodes.size()) return found;
        for (uint32_t i = 0; i < to.nodes.size(); ++i) {
            if (!to.nodes[i].bounds.contains(from.nodes[node].bounds)) continue;
            if (found == kNoIndex || to.half_area(i) <= to.half_area(found)) found = i;
        }
        return found;
    };
    state.node = again(state.node);
    state.isolated = again(state.isolated);
    for (uint32_t& node : state.hidden_nodes) node = again(node);
    std::erase(state.hidden_nodes, kNoIndex);
}

}  // namespace boxwood
