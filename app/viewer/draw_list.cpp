#include "app/viewer/draw_list.h"

#include <algorithm>
#include <limits>

#include "core/measure/report.h"
#include "core/render/image.h"

namespace boxwood {
namespace {

constexpr float kLineWidth = 1.4f, kLineCasing = 1.2f, kWireWidth = 1.1f;  // pixels at interface scale 1

constexpr float kDepthFade = 0.5f, kSizeFade = 0.75f;

/// The part of the colour map that stands out from the background.
struct MapPart {
    float from, to;
};
constexpr MapPart kDarkPart = {0.28f, 1.0f};
constexpr MapPart kLightPart = {0.0f, 0.76f};
constexpr double kShareSpan = 1e-5;  // shares below this part of the largest look alike

void set_theme(DrawList& list, Theme theme) {
    const bool is_dark = theme == Theme::Dark;
    list.background_top =
        linear_from_srgb(is_dark ? Vec3(0.175f, 0.195f, 0.225f) : Vec3(0.86f, 0.89f, 0.93f));
    list.background_bottom =
        linear_from_srgb(is_dark ? Vec3(0.085f, 0.09f, 0.10f) : Vec3(0.97f, 0.97f, 0.96f));
    list.wire_color = linear_from_srgb(is_dark ? Vec3(0.06f, 0.07f, 0.09f) : Vec3(0.15f, 0.17f, 0.20f));
    list.casing_color = linear_from_srgb(is_dark ? Vec3(0.02f, 0.03f, 0.05f) : Vec3(1.0f));
    list.red_color = linear_from_srgb(Vec3(0.93f, 0.16f, 0.12f));
    list.shared_color = linear_from_srgb(Vec3(0.16f, 0.47f, 0.95f));
    list.empty_color = linear_from_srgb(is_dark ? Vec3(0.80f, 0.80f, 0.84f) : Vec3(0.45f, 0.45f, 0.50f));
    list.unvisited_color = list.empty_color;
    list.ray_color = linear_from_srgb(is_dark ? Vec3(1.0f, 0.62f, 0.12f) : Vec3(0.85f, 0.38f, 0.0f));
    list.selection_color = linear_from_srgb(is_dark ? Vec3(1.0f, 0.55f, 0.95f) : Vec3(0.80f, 0.0f, 0.70f));
}

ColorScale make_colors(const ViewerState& state, const BoxRanges& ranges) {
    ColorScale colors;
    colors.meaning = state.box_color;
    const MapPart part = state.theme == Theme::Dark ? kDarkPart : kLightPart;
    for (size_t i = 0; i < kPaletteSize; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(kPaletteSize - 1);
        colors.palette[i] = map_linear(ColorMap::Viridis, part.from + x * (part.to - part.from));
    }
    const auto share_most = static_cast<double>(ranges.sah_share.upper);
    const auto share_least = std::max(static_cast<double>(ranges.sah_share.lower), kShareSpan * share_most);
    switch (state.box_color) {
        case BoxColor::Level:
            colors.scale = {0.0, std::max(1.0, double(std::clamp(state.levels.last, 0, ranges.deepest))),
                            false};
            break;
        case BoxColor::Primitives:
            colors.scale = {static_cast<double>(ranges.references.lower),
                            static_cast<double>(ranges.references.upper), true};
            break;
        case BoxColor::SahShare:
            colors.scale = {share_least, share_most, true};
            break;
        case BoxColor::Visits: {
            // One visit alone has the last colour, which stands out most.
            const double most = ranges.most_visits > 0 ? double(ranges.most_visits) : 1.0;
            colors.scale = {most > 1.0 ? 1.0 : 0.5, std::max(most, 1.0), true};
            break;
        }
    }
    return colors;
}

/// Parameter of the point where the ray leaves the box, or where it is nearest to its middle.
double exit_of(const Ray& ray, const Box& box) {
    double exit = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const auto d = static_cast<double>(ray.direction[axis]);
        if (d == 0.0) continue;
        const auto wall = static_cast<double>(d > 0.0 ? box.upper[axis] : box.lower[axis]);
        exit = std::min(exit, (wall - static_cast<double>(ray.origin[axis])) / d);
    }
    const DVec3 direction(ray.direction);
    const double nearest =
        glm::dot(box.center() - DVec3(ray.origin), direction) / glm::dot(direction, direction);
    return std::max({exit, nearest, 0.0});
}

/// The ray up to its hit, or through the scene, and a cross at the hit.
std::vector<OutlineSegment> ray_lines(const PickedRay& picked, const Hit& hit, const Box& scene) {
    constexpr double kCrossSize = 0.008;  // of the distance from the ray's origin
    const Ray ray = ray_of(picked);
    const double end = hit.is_hit() ? static_cast<double>(hit.t) : exit_of(ray, scene);
    const DVec3 step = end * DVec3(ray.direction), point = DVec3(ray.origin) + step;
    std::vector<OutlineSegment> lines{{0, ray.origin, Vec3(point)}};
    for (int axis = 0; axis < 3 && hit.is_hit(); ++axis) {
        DVec3 arm(0.0);
        arm[axis] = kCrossSize * glm::length(step);
        lines.push_back({0, Vec3(point - arm), Vec3(point + arm)});
    }
    return lines;
}

}  // namespace

Vec3 ColorScale::color(double value) const {
    const float position = scale.position(value) * static_cast<float>(kPaletteSize - 1);
    const size_t first = std::min(static_cast<size_t>(position), kPaletteSize - 2);
    return glm::mix(palette[first], palette[first + 1], position - static_cast<float>(first));
}

BoxSelection select_boxes(const LevelTable& levels, const LevelRange& range, bool leaves_above) {
    BoxSelection selection;
    if (levels.level_count() == 0) return selection;
    const size_t deepest = levels.level_count() - 1;
    const size_t first = std::min(static_cast<size_t>(std::max(range.first, 0)), deepest);
    const size_t last = std::min(static_cast<size_t>(std::max(range.last, 0)), deepest);
    selection.first_level = static_cast<uint32_t>(first);
    selection.end = levels.level_begin[std::max(first, last) + 1];
    selection.leaves_above = leaves_above;
    selection.count = selection.end - levels.level_begin[first];
    if (!leaves_above) return selection;
    for (size_t level = 0; level < first; ++level) selection.count += levels.leaf_count[level];
    return selection;
}

void BoxRanges::extend(const LevelTable& levels, const BoxValues& values, const Visits* visits) {
    const auto join = [](ValueRange& range, const ValueRange& other) {
        if (!(other.upper > 0.0f)) return;
        range.lower = range.upper > 0.0f ? std::min(range.lower, other.lower) : other.lower;
        range.upper = std::max(range.upper, other.upper);
    };
    deepest = std::max(deepest, static_cast<int>(levels.level_count()) - 1);
    join(references, values.references_range);
    join(sah_share, values.sah_share_range);
    if (visits != nullptr) most_visits = std::max(most_visits, visits->most);
}

BoxRanges BoxRanges::of(const LevelTable& levels, const BoxValues& values, const Visits* visits) {
    BoxRanges ranges;
    ranges.extend(levels, values, visits);
    return ranges;
}

DrawList make_draw_list(const ViewerState& state, const LevelTable& levels, const BoxValues& values,
                        const CastResults& cast) {
    return make_draw_list(state, state.active_side(), levels, cast,
                          BoxRanges::of(levels, values, cast.visits.get()));
}

DrawList make_draw_list(const ViewerState& state, Side side, const LevelTable& levels,
                        const CastResults& cast, const BoxRanges& ranges) {
    DrawList list;
    const bool is_traced = state.traced == TracedView::Over;
    list.mesh = !state.show_mesh ? MeshLook::Hidden : is_traced ? MeshLook::Depth : MeshLook::Shaded;
    list.wire = state.show_wire && list.mesh != MeshLook::Depth;
    list.red = state.show_red;
    list.shared = state.show_shared;
    list.reference_boxes = state.show_reference_boxes;
    list.see_through = state.see_through;
    list.interface_scale = state.interface_scale;
    list.line_width = kLineWidth * state.interface_scale;
    list.line_casing = kLineCasing * state.interface_scale;
    list.wire_width = kWireWidth * state.interface_scale;
    list.depth_fade = kDepthFade;
    list.size_fade = kSizeFade;
    set_theme(list, state.theme);
    list.colors = make_colors(state, ranges);
    if (state.show_boxes && levels.level_count() > 0) {
        list.boxes = select_boxes(levels, state.levels, state.leaves_above);
        list.boxes->empty_cells = state.show_empty;
        list.boxes->only_visited = state.box_color == BoxColor::Visits && !state.show_unvisited;
    }
    const uint32_t node = state.side(side).node;
    if (node < levels.list.nodes.size()) {
        list.selected = levels.list.nodes[node].bounds;
        const std::span<const OutlineSegment> outline = levels.outline(node);
        list.selected_outline.assign(outline.begin(), outline.end());
    }
    list.selected_prim = state.prim;
    if (state.ray && !levels.list.nodes.empty())
        list.ray = ray_lines(*state.ray, cast.ray_hit, levels.list.nodes[0].bounds);
    return list;
}

std::string describe(const BoxCounts& counts) {
    const std::string empty = counts.empty > 0 ? "; " + grouped(counts.empty) + " empty, not drawn" : "";
    if (counts.candidates == 0) return "no boxes" + empty;
    std::string text = grouped(counts.drawn);
    if (counts.drawn != counts.candidates) text += " of " + grouped(counts.candidates);
    text += counts.candidates == 1 ? " box" : " boxes";
    if (counts.over_budget > 0) text += ", the largest on screen";
    if (counts.outside > 0) text += "; " + grouped(counts.outside) + " outside the view";
    if (counts.under_pixel > 0) text += "; " + grouped(counts.under_pixel) + " under a pixel";
    return text + empty;
}

}  // namespace boxwood
